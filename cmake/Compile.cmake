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
# The key that ccache knows a precompiled header by.
target_compile_options(shbake_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
target_include_directories(shbake_options INTERFACE ${PROJECT_SOURCE_DIR}/core)
# No contraction to fused multiply-adds: the bytes of an output must not depend on which kernel a machine picks.
target_compile_options(shbake_options INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -Wno-psabi -ffp-contract=off)

# shbake_compile_lightly(SOURCES…): for files that put texts together or unfold large templates of other libraries, and
# have little to compute: half of their compilation was optimising that.
function(shbake_compile_lightly)
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS $<$<NOT:$<CONFIG:Debug>>:-Og>)
endfunction()

if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
  # GCC 12 forgets that what it inlines from a precompiled header is the standard library's, and warns falsely of its
  # strings. Without such headers (-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON) the warnings are on.
  target_compile_options(shbake_options INTERFACE
    -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread)
endif()
if(SHBAKE_WERROR)
  target_compile_options(shbake_options INTERFACE -Werror)
endif()
if(SHBAKE_SANITIZE)
  target_compile_options(shbake_options INTERFACE -fsanitize=${SHBAKE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(shbake_options INTERFACE -fsanitize=${SHBAKE_SANITIZE})
  if(SHBAKE_SANITIZE STREQUAL thread)
    # Programs would export the functions of std::string that they hold a copy of, and Embree would call these, which are
    # instrumented, for strings of its own. What orders its threads the sanitizer does not see.
    target_link_options(shbake_options INTERFACE LINKER:--version-script=${PROJECT_SOURCE_DIR}/cmake/own_strings.map)
    set_property(TARGET shbake_options APPEND PROPERTY INTERFACE_LINK_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/own_strings.map)
  endif()
  # Instrumented code hides from GCC's flow analysis that a value is set: it then warns of the standard library itself.
  target_compile_options(shbake_options INTERFACE -Wno-maybe-uninitialized)
endif()
