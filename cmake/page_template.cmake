# The page's template: web/ with its npm packages and the core, bundled by Vite into one file, web/report.html in the build folder
# (target page_template). Nothing is written into the source tree: web/ is copied, and the packages live beside the copy.
find_program(GOUGH_PAGE_NPM npm)
find_program(GOUGH_PAGE_NODE NAMES node nodejs)
if(NOT GOUGH_PAGE_NPM OR NOT GOUGH_PAGE_NODE)
    message(FATAL_ERROR "The page of `gough report` is bundled by Vite, which needs the Debian packages nodejs and npm "
        "(scripts/install-packages.sh bundler installs them). Without them, configure with -DGOUGH_PAGE=OFF.")
endif()

set(GOUGH_PAGE_SOURCE ${PROJECT_BINARY_DIR}/web/source)
set(GOUGH_PAGE_TEMPLATE ${PROJECT_BINARY_DIR}/web/report.html)
set(GOUGH_PAGE_PALETTE ${PROJECT_SOURCE_DIR}/src/figure/palette.def)
file(GLOB GOUGH_PAGE_FILES CONFIGURE_DEPENDS web/src/*.js web/src/*.css)
set(GOUGH_PAGE_PACKAGES package.json package-lock.json .npmrc)
list(TRANSFORM GOUGH_PAGE_PACKAGES PREPEND ${PROJECT_SOURCE_DIR}/web/)

# anew only when the list of packages changes; node_modules is what it leaves
add_custom_command(OUTPUT ${GOUGH_PAGE_SOURCE}/packages.stamp
    COMMAND ${CMAKE_COMMAND} -E make_directory ${GOUGH_PAGE_SOURCE}
    COMMAND ${CMAKE_COMMAND} -E copy_if_different ${GOUGH_PAGE_PACKAGES} ${GOUGH_PAGE_SOURCE}
    COMMAND ${CMAKE_COMMAND} -E chdir ${GOUGH_PAGE_SOURCE}
            ${GOUGH_PAGE_NPM} ci --ignore-scripts --prefer-offline --no-audit --no-fund --no-progress --loglevel=error
    COMMAND ${CMAKE_COMMAND} -E touch ${GOUGH_PAGE_SOURCE}/packages.stamp
    DEPENDS ${GOUGH_PAGE_PACKAGES}
    COMMENT "Installing the page's packages" VERBATIM)

add_custom_command(OUTPUT ${GOUGH_PAGE_TEMPLATE}
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${GOUGH_PAGE_SOURCE}/src
    COMMAND ${CMAKE_COMMAND} -E copy_directory ${PROJECT_SOURCE_DIR}/web/src ${GOUGH_PAGE_SOURCE}/src
    COMMAND ${CMAKE_COMMAND} -E copy ${PROJECT_SOURCE_DIR}/web/index.html ${PROJECT_SOURCE_DIR}/web/vite.config.js
            ${GOUGH_PAGE_SOURCE}
    COMMAND ${CMAKE_COMMAND} -E chdir ${GOUGH_PAGE_SOURCE} ${CMAKE_COMMAND} -E env
            GOUGH_CORE=${GOUGH_PAGE_CORE} GOUGH_PALETTE=${GOUGH_PAGE_PALETTE} GOUGH_PAGE_OUTPUT=${GOUGH_PAGE_SOURCE}/dist
            ${GOUGH_PAGE_NODE} node_modules/vite/bin/vite.js build --logLevel warn
    COMMAND ${CMAKE_COMMAND} -E copy ${GOUGH_PAGE_SOURCE}/dist/index.html ${GOUGH_PAGE_TEMPLATE}
    DEPENDS ${GOUGH_PAGE_SOURCE}/packages.stamp ${GOUGH_PAGE_FILES} ${GOUGH_PAGE_CORE} ${GOUGH_PAGE_PALETTE}
            ${PROJECT_SOURCE_DIR}/web/index.html ${PROJECT_SOURCE_DIR}/web/vite.config.js
    COMMENT "Bundling the page" VERBATIM)
add_custom_target(page_template DEPENDS ${GOUGH_PAGE_TEMPLATE})
