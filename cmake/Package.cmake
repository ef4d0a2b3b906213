# Debian packages: `cpack -G DEB` in the build folder makes one of the program and, where it is built, one of the MeshLab
# plugin. Included last, when all is known that is installed.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The shbake project")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENTS_ALL program)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME shbake)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "Bakes light transfer into the vertices of a mesh, and lights it.")

if(SHBAKE_MESHLAB)
  list(APPEND CPACK_COMPONENTS_ALL meshlab)
  set(CPACK_DEBIAN_MESHLAB_PACKAGE_NAME meshlab-plugin-shbake)
  set(CPACK_COMPONENT_MESHLAB_DESCRIPTION "Bakes light transfer into the vertices of a layer, and lights it live.")
  # MeshLab promises nothing about its binary interface: a plugin fits the release that it was built for and no other.
  set(CPACK_DEBIAN_MESHLAB_PACKAGE_DEPENDS "meshlab (>= 2020.09), meshlab (<< 2020.10)")
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${MESHLAB_LIBRARY_DIR})
endif()
include(CPack)
