# Copyright 2026 The Carpus authors
# SPDX-License-Identifier: Apache-2.0
#
# One interface target that every module and test compiles with.

find_program(CARPUS_CCACHE ccache)
if(CARPUS_CCACHE)
  # Paths count from the root, so that every checkout on a machine finds what another one compiled.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}
      CCACHE_NOHASHDIR=1 ${CARPUS_CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${CMAKE_CXX_COMPILER_LAUNCHER})
endif()

add_library(carpus_options INTERFACE)
target_compile_options(carpus_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror
  # The same recording must give the same state hash at any optimisation level: no fused
  # multiply-add, no reassociation (docs/decisions/0003-determinism.md).
  -ffp-contract=off)
target_include_directories(carpus_options INTERFACE ${PROJECT_SOURCE_DIR}/src)

if(CARPUS_SANITIZE)
  target_compile_options(carpus_options INTERFACE
    -fsanitize=${CARPUS_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(carpus_options INTERFACE -fsanitize=${CARPUS_SANITIZE})
  # Between the calls that its thread sanitizer puts in, g++ loses sight of what was initialised. Asio's
  # fences are unknown to it, which it warns of; what they order is locked besides.
  if(CARPUS_SANITIZE MATCHES "thread" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(carpus_options INTERFACE -Wno-maybe-uninitialized -Wno-tsan)
  endif()
endif()
