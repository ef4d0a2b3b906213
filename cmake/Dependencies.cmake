# The third-party libraries, all from Debian packages (packages.txt lists them).
find_package(OpenMesh REQUIRED)
find_package(embree 3 REQUIRED)
find_package(TBB REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(OpenImageIO REQUIRED)
# Debian 12's OpenImageIO target lists OpenCV's include directory, which exists only where libopencv-dev is installed.
get_target_property(_oiio_includes OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
list(FILTER _oiio_includes EXCLUDE REGEX "opencv")
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${_oiio_includes}")
