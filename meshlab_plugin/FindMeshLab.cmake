# Finds the MeshLab that Debian installed, and the headers of the very version, which Debian packages as source only.
#
# Input:  MESHLAB_SOURCE_DIR  unpacked sources of MeshLab with vcglib; fetched to the build folder where it is empty
# Output: MeshLab::common     what plugins compile and link with
#         MESHLAB_API         the release as yyyymm, 202009 for Debian 12's
#         MESHLAB_PLUGIN_DIR  where MeshLab looks for plugins, seen from the prefix that it is installed in
set(MESHLAB_SOURCE_DIR "" CACHE PATH "Unpacked MeshLab sources with vcglib; empty: Debian's, fetched when they are missing")
set(MESHLAB_LIBRARY_DIR "/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/meshlab" CACHE PATH "The folder of libmeshlab-common.so")

set(meshlab_source ${MESHLAB_SOURCE_DIR})
if(NOT meshlab_source)
  # One copy serves all builds of this checkout.
  set(meshlab_cache ${PROJECT_SOURCE_DIR}/build/meshlab-source)
  message(STATUS "Fetching Debian's source package of MeshLab for its headers, unless it is in ${meshlab_cache}")
  execute_process(COMMAND ${PROJECT_SOURCE_DIR}/scripts/fetch_meshlab_source.sh ${meshlab_cache}
    RESULT_VARIABLE meshlab_failed OUTPUT_VARIABLE meshlab_output ERROR_VARIABLE meshlab_output)
  if(meshlab_failed)
    message(FATAL_ERROR "MeshLab's headers are not there:\n${meshlab_output}\n"
      "Install the packages of meshlab_plugin/packages.txt, or give -DMESHLAB_SOURCE_DIR=FOLDER, or leave the plugin out "
      "with -DSHBAKE_MESHLAB=OFF.")
  endif()
  set(meshlab_source ${meshlab_cache}/source)
endif()

# Later releases have vcglib in src.
set(meshlab_vcglib vcglib)
if(EXISTS ${meshlab_source}/src/vcglib/vcg)
  set(meshlab_vcglib src/vcglib)
endif()
foreach(needed ML_VERSION src/common ${meshlab_vcglib}/vcg/complex/complex.h)
  if(NOT EXISTS ${meshlab_source}/${needed})
    message(FATAL_ERROR "${meshlab_source} lacks ${needed}: it does not hold the sources of MeshLab with vcglib")
  endif()
endforeach()
file(STRINGS ${meshlab_source}/ML_VERSION meshlab_version LIMIT_COUNT 1)
string(REGEX REPLACE "^([0-9][0-9][0-9][0-9])\\.([0-9][0-9]).*" "\\1\\2" MESHLAB_API "${meshlab_version}")
find_library(MESHLAB_COMMON_LIBRARY meshlab-common PATHS ${MESHLAB_LIBRARY_DIR} NO_DEFAULT_PATH REQUIRED)
set(MESHLAB_PLUGIN_DIR lib/${CMAKE_LIBRARY_ARCHITECTURE}/meshlab/plugins)
find_package(Qt5 5.15 REQUIRED COMPONENTS Core Gui Widgets OpenGL Xml)
find_path(GLEW_HEADER_DIR GL/glew.h REQUIRED)

# Imported libraries are system libraries: the warnings of their headers are not ours.
add_library(MeshLab::common SHARED IMPORTED)
set_target_properties(MeshLab::common PROPERTIES
  IMPORTED_LOCATION ${MESHLAB_COMMON_LIBRARY}
  INTERFACE_INCLUDE_DIRECTORIES "${meshlab_source}/src;${meshlab_source}/${meshlab_vcglib};${GLEW_HEADER_DIR}"
  INTERFACE_COMPILE_DEFINITIONS "MESHLAB_SCALAR=float;MESHLAB_VERSION=${meshlab_version};SHBAKE_MESHLAB_API=${MESHLAB_API}"
  INTERFACE_LINK_LIBRARIES "Qt5::Core;Qt5::Gui;Qt5::Widgets;Qt5::OpenGL;Qt5::Xml;Eigen3::Eigen")
