# Copyright 2026 The Carpus authors
# SPDX-License-Identifier: Apache-2.0

# carpus_module(<name> [DEPENDS <module>...] [USED_BY <module>...] [PACKAGES <target>...] [PRIVATE_PACKAGES <target>...]
#               [EMBED <file>...])
#
# Declares the module in the current directory: the library carpus::<name> from all *.cpp here and in
# its folders (but program/, which holds a main) except the tests, and the test program <name>_test
# from all *_test.cpp. Files are globbed, so that adding one touches no list. DEPENDS is the whole
# truth about which modules it may include; tools/check_layers compares it with every #include. A
# module with USED_BY is for the modules listed there alone; check_layers proves that too.
#
# EMBED makes each data/<file> available as `carpus::data::<stem>()`, declared by the module itself
# as `namespace carpus::data { std::string_view <stem>(); }`: pure modules read no files.
function(carpus_module name)
  cmake_parse_arguments(ARG "" "" "DEPENDS;USED_BY;PACKAGES;PRIVATE_PACKAGES;EMBED" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp
       ${CMAKE_CURRENT_SOURCE_DIR}/*/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/program/")
  set(tests ${sources})
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")

  foreach(file IN LISTS ARG_EMBED)
    get_filename_component(stem ${file} NAME_WE)
    set(generated ${CMAKE_CURRENT_BINARY_DIR}/${stem}_data.cpp)
    set(input ${PROJECT_SOURCE_DIR}/data/${file})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${input})
    file(READ ${input} content)
    file(CONFIGURE OUTPUT ${generated} @ONLY CONTENT [=[
// Generated from data/@file@ by cmake/carpus_module.cmake.
#include <string_view>
namespace carpus::data {
std::string_view @stem@();
std::string_view @stem@() { return R"carpus(@content@)carpus"; }
}  // namespace carpus::data
]=])
    list(APPEND sources ${generated})
  endforeach()

  list(TRANSFORM ARG_DEPENDS PREPEND carpus:: OUTPUT_VARIABLE modules)
  if(sources)
    add_library(carpus_${name} STATIC ${sources})
    target_link_libraries(carpus_${name} PUBLIC carpus_options ${modules} ${ARG_PACKAGES}
                          PRIVATE ${ARG_PRIVATE_PACKAGES})
  else()
    add_library(carpus_${name} INTERFACE)
    target_link_libraries(carpus_${name} INTERFACE carpus_options ${modules} ${ARG_PACKAGES})
  endif()
  add_library(carpus::${name} ALIAS carpus_${name})

  if(CARPUS_TESTS AND tests)
    add_executable(${name}_test ${tests})
    target_link_libraries(${name}_test PRIVATE carpus_${name} GTest::gtest GTest::gmock
                          GTest::gtest_main rapidcheck rapidcheck_gtest ${ARG_PRIVATE_PACKAGES})
    carpus_test(${name})
  endif()
endfunction()
