# Compiler flags of everything built here. Results must be the same bits on every x86-64 machine: no -march=native,
# no fast-math, no contraction to fused multiply-add.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_C_STANDARD 99)
set(CMAKE_C_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_C_VISIBILITY_PRESET hidden)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
# Files of strangers are read here, so that what is released is hardened; sanitizers have checks of their own.
set(hardened "-fstack-protector-strong -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2")
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -g1 -DNDEBUG ${hardened}")
set(CMAKE_C_FLAGS_RELEASE "-O2 -g1 -DNDEBUG ${hardened}")
add_link_options($<$<CONFIG:Release>:LINKER:-z,relro,-z,now,-z,noexecstack>)
# Sanitized builds: quick to build, names and lines in their reports.
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O1 -g1")
set(CMAKE_C_FLAGS_RELWITHDEBINFO "-O1 -g1")

find_program(AVOIDBENCH_CCACHE ccache)
if(AVOIDBENCH_CCACHE)
  # The sloppiness is what precompiled headers need: they carry times.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${AVOIDBENCH_CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${AVOIDBENCH_CCACHE})
endif()

add_library(avoidbench_flags INTERFACE)
target_compile_options(avoidbench_flags INTERFACE
  -ffp-contract=off -fno-fast-math -fno-math-errno
  -Wall -Wextra -Wpedantic
  $<$<COMPILE_LANGUAGE:CXX>:-Wconversion -Wsign-conversion -Wshadow -Wold-style-cast -Wdouble-promotion>)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 sees uninitialised members of std::variant and std::optional that are never read (GCC bug 105562); clang's
  # analyser looks instead.
  target_compile_options(avoidbench_flags INTERFACE -Wno-maybe-uninitialized)
  if(AVOIDBENCH_UNITY)
    # Of sources compiled together, all but the first look like headers.
    target_compile_options(avoidbench_flags INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wno-subobject-linkage>)
  endif()
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(avoidbench_flags INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-fpch-preprocess>)  # for ccache
else()
  target_compile_options(avoidbench_flags INTERFACE "$<$<COMPILE_LANGUAGE:CXX>:SHELL:-Xclang -fno-pch-timestamp>")
endif()
if(AVOIDBENCH_WERROR)
  target_compile_options(avoidbench_flags INTERFACE -Werror)
endif()
if(AVOIDBENCH_SANITIZE)
  add_compile_options(-fsanitize=${AVOIDBENCH_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${AVOIDBENCH_SANITIZE})
endif()
if(AVOIDBENCH_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
