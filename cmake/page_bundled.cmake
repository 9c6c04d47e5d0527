# The page's template as a source tarball brings it, bundled: web/report.html in the sources. Node.js, npm, a compiler for WebAssembly and
# a network are then not needed. To bundle it anew, remove that file.
set(GOUGH_PAGE_TEMPLATE ${PROJECT_SOURCE_DIR}/web/report.html)
add_custom_target(page_template DEPENDS ${GOUGH_PAGE_TEMPLATE})
