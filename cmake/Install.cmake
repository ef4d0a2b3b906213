# Where `cmake --install` puts things: the program into bin/, the modules that it loads into lib/shbake/, words about it
# into share/doc/shbake/. Nothing installed refers to the prefix, so that it can be moved as a whole. The component is
# "program": cmake --install BUILD --component program
include(GNUInstallDirs)
set(SHBAKE_MODULE_DIR ${CMAKE_INSTALL_LIBDIR}/shbake)
# Seen from the program's folder: base/module.h looks there.
file(RELATIVE_PATH SHBAKE_MODULE_FOLDER /${CMAKE_INSTALL_BINDIR} /${SHBAKE_MODULE_DIR})

# shbake_install_module(TARGET): a module that the program loads.
function(shbake_install_module target)
  install(TARGETS ${target} LIBRARY DESTINATION ${SHBAKE_MODULE_DIR} COMPONENT program)
endfunction()

install(FILES README.md CHANGELOG.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
