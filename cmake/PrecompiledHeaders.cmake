# airsim360_for_python(TARGET): the Python module is a shared object of our libraries; kernels (Kernels.cmake) need no such code.
# What takes the precompiled headers must be compiled as they are.
function(airsim360_for_python target)
  if(AIRSIM360_PYTHON)
    target_compile_options(${target} PRIVATE -fPIC -fno-semantic-interposition)
  endif()
endfunction()

# Standard headers and GoogleTest, parsed once: they are a third of a cold build. Off under a compiler cache, which
# gains nothing from them, and when fuzzing, where clang finds the includes that they hide.
option(AIRSIM360_PCH "precompile standard headers" ${AIRSIM360_PARSE_ONCE})

if(AIRSIM360_PCH)
  # Some libraries ask for it; the options of all must agree.
  add_compile_options(-pthread)
  set(standard_headers <algorithm> <array> <atomic> <cmath> <cstdint> <cstring> <filesystem> <fstream> <functional> <limits> <map>
      <memory> <mutex> <optional> <random> <span> <sstream> <string> <string_view> <thread> <unordered_map> <utility> <variant> <vector>)
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/empty.cc CONTENT "")  # as it is where it is there
  add_library(airsim360_standard_headers OBJECT ${CMAKE_BINARY_DIR}/empty.cc)
  target_precompile_headers(airsim360_standard_headers PRIVATE ${standard_headers})
  airsim360_for_python(airsim360_standard_headers)
  foreach(level O0 O1)
    add_library(airsim360_test_headers_${level} OBJECT ${CMAKE_BINARY_DIR}/empty.cc)
    target_link_libraries(airsim360_test_headers_${level} PRIVATE GTest::gtest)
    target_compile_options(airsim360_test_headers_${level} PRIVATE -${level})
    target_precompile_headers(airsim360_test_headers_${level} PRIVATE ${standard_headers} <gtest/gtest.h>)
  endforeach()
endif()

# Tests that run for a second or two: not optimised, they compile in half the time.
set(airsim360_short_tests app_test assets_test flight_test mission_test mpde_test opening_test planning_test rpc_test stage_test
    tasks_test view_test)

# airsim360_test_options(TARGET): how tests are compiled. The code under test is optimised; that of the tests need not be.
function(airsim360_test_options target)
  set(level O1)
  if(target IN_LIST airsim360_short_tests)
    set(level O0)
  endif()
  target_compile_options(${target} PRIVATE -${level})
  if(AIRSIM360_PCH)
    target_precompile_headers(${target} REUSE_FROM airsim360_test_headers_${level})
  endif()
endfunction()

# airsim360_parse_once(TARGET): the standard headers for a program of our own.
function(airsim360_parse_once target)
  if(NOT AIRSIM360_PCH)
    return()
  endif()
  airsim360_for_python(${target})
  target_precompile_headers(${target} REUSE_FROM airsim360_standard_headers)
endfunction()
