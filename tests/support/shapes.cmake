# Generated meshes: for tests and benchmarks, and for the program's own test of itself.
add_library(shbake_test_shapes STATIC
  ${CMAKE_CURRENT_LIST_DIR}/defects.cpp
  ${CMAKE_CURRENT_LIST_DIR}/scenes.cpp
  ${CMAKE_CURRENT_LIST_DIR}/surfaces.cpp
  ${CMAKE_CURRENT_LIST_DIR}/transforms.cpp)
target_link_libraries(shbake_test_shapes PUBLIC shbake_mesh)
target_include_directories(shbake_test_shapes PUBLIC ${CMAKE_CURRENT_LIST_DIR}/..)
target_precompile_headers(shbake_test_shapes REUSE_FROM shbake_base)
