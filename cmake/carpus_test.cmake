# Copyright 2026 The Carpus authors
# SPDX-License-Identifier: Apache-2.0

# Those that take longest, which begin first, so that no core idles while the last one runs.
set(carpus_longest_tests server simulation reconstruct phantom durability trainee procedures hull stock view_trainer)

# carpus_test(<name>)
#
# Makes the program <name>_test one test of ctest. Its tests share a process, and so what they set up
# once: a world, fields, a simulated CT. One of them alone: build/release/bin/<name>_test
# --gtest_filter=Suite.Test.
function(carpus_test name)
  add_test(NAME ${name} COMMAND ${name}_test --gtest_brief=1 WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  list(FIND carpus_longest_tests ${name} place)
  if(place EQUAL -1)
    set(place 1000)
  endif()
  math(EXPR cost "1000 - ${place}")
  set_tests_properties(${name} PROPERTIES TIMEOUT 1800 COST ${cost})
endfunction()
