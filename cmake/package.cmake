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
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "dynamics and control of Stewart-Gough platforms")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
    "Which leg forces a hexapod's motion needs, what motion given forces produce,
why open-loop forces cannot hold it and which feedback does: a command, a C
library and its headers.")
# new libraries reach the loader's cache
file(WRITE ${PROJECT_BINARY_DIR}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/triggers)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
include(CPack)
