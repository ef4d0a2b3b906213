# How everything of shbake is compiled. Target `shbake_options` carries the flags; every library and program links it.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # What is compiled with a precompiled header is cached only on these terms, and with -fpch-preprocess.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE})
endif()

add_library(shbake_options INTERFACE)
target_include_directories(shbake_options INTERFACE ${PROJECT_SOURCE_DIR}/core)
# No contraction to fused multiply-adds: the bytes of an output must not depend on which kernel a machine picks.
target_compile_options(shbake_options INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -Wno-psabi -ffp-contract=off)
if(SHBAKE_WERROR)
  target_compile_options(shbake_options INTERFACE -Werror)
endif()
if(SHBAKE_SANITIZE)
  target_compile_options(shbake_options INTERFACE -fsanitize=${SHBAKE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(shbake_options INTERFACE -fsanitize=${SHBAKE_SANITIZE})
  # Instrumented code hides from GCC's flow analysis that a value is set: it then warns of the standard library itself.
  target_compile_options(shbake_options INTERFACE -Wno-maybe-uninitialized)
endif()
