# What `cmake --install` and `cpack` add beside program, tables and pictures: man pages and completions made from the help,
# documents and examples. cpack -G DEB makes a package for Debian 12.
set(generated_share ${CMAKE_BINARY_DIR}/fraction)
add_custom_command(OUTPUT ${generated_share}/man/man1/rheocyte.1.gz
                   COMMAND ${RHEOCYTE_PYTHON_EXECUTABLE} ${CMAKE_SOURCE_DIR}/tools/man_pages $<TARGET_FILE:rheocyte>
                           ${generated_share}
                   DEPENDS rheocyte ${CMAKE_SOURCE_DIR}/tools/man_pages ${CMAKE_SOURCE_DIR}/tools/help_texts.py
                   VERBATIM)
add_custom_target(manual ALL DEPENDS ${generated_share}/man/man1/rheocyte.1.gz)
install(DIRECTORY ${generated_share}/man ${generated_share}/bash-completion DESTINATION share COMPONENT rheocyte)
install(FILES README.md CHANGELOG.md CITATION.cff DESTINATION share/doc/rheocyte COMPONENT rheocyte)
install(FILES LICENSE DESTINATION share/doc/rheocyte RENAME copyright COMPONENT rheocyte)
install(DIRECTORY examples DESTINATION share/doc/rheocyte COMPONENT rheocyte PATTERN "*.ipynb" EXCLUDE)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The rheocyte developers")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL rheocyte)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_RHEOCYTE_PACKAGE_NAME rheocyte)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3-matplotlib, python3-numpy")
include(CPack)
