# The third-party libraries, all from Debian packages (packages.txt lists them).
find_package(OpenMesh REQUIRED)
find_package(embree 3 REQUIRED)
find_package(TBB REQUIRED)
find_package(Eigen3 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CGAL REQUIRED)

# Options are parsed once a start: optimising CLI11's templates buys nothing and doubles the time to compile their users.
target_compile_options(CLI11::CLI11 INTERFACE $<$<NOT:$<CONFIG:Debug>>:-Og>)

# Debian 12's own CMake files of OpenImageIO ask for its viewer and for OpenCV's headers, neither of which the library needs.
find_path(OPENIMAGEIO_INCLUDE_DIR OpenImageIO/imageio.h REQUIRED)
find_library(OPENIMAGEIO_LIBRARY OpenImageIO REQUIRED)
find_library(OPENIMAGEIO_UTIL_LIBRARY OpenImageIO_Util REQUIRED)
add_library(OpenImageIO::OpenImageIO UNKNOWN IMPORTED)
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES
  IMPORTED_LOCATION ${OPENIMAGEIO_LIBRARY}
  INTERFACE_INCLUDE_DIRECTORIES ${OPENIMAGEIO_INCLUDE_DIR}
  INTERFACE_LINK_LIBRARIES ${OPENIMAGEIO_UTIL_LIBRARY})
