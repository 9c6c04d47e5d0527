# `make package`: one Debian package with command, libraries and headers.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME gough)
set(CPACK_PACKAGE_CONTACT "gough developers <gough@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS gnuplot-nox)
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "dynamics and control of Stewart-Gough platforms
 Which leg forces a hexapod's motion needs, what motion given forces produce,
 why open-loop forces cannot hold it and which feedback does: a command, a C
 library and their headers.")
include(CPack)
