# airsim360_suites(TARGET [ENVIRONMENT NAME=VALUE ...] [PROPERTIES NAME VALUE ...]): each suite of a GoogleTest program becomes one ctest test
# (flight_test's suite Wind is flight.Wind), so that the cases of a suite share what is dear to make (a city).
# The list is made when the program is linked. Run as a script (-P), this file makes that list.
if(CMAKE_SCRIPT_MODE_FILE)
  execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" lines "${listed}")
  get_filename_component(program ${PROGRAM} NAME)
  string(REGEX REPLACE "_test$" "" program ${program})
  set(tests "")
  foreach(line ${lines})
    if(line MATCHES "^([A-Za-z0-9_/]+)\\.")
      set(suite ${CMAKE_MATCH_1})
      string(APPEND tests "add_test([=[${program}.${suite}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${suite}.*]=])\n"
             "set_tests_properties([=[${program}.${suite}]=] PROPERTIES WORKING_DIRECTORY [=[${FOLDER}]=] TIMEOUT 900 FIXTURES_REQUIRED test_cache ENVIRONMENT [=[${ENVIRONMENT}]=] ${PROPERTIES})\n")
    endif()
  endforeach()
  file(WRITE ${LIST} "${tests}")
  return()
endif()

set(AIRSIM360_TEST_CACHE "AIRSIM360_CACHE=${CMAKE_BINARY_DIR}/test_cache;AIRSIM360_CACHE_PROGRAM=tests")

function(airsim360_suites target)
  cmake_parse_arguments(ARG "" "" "ENVIRONMENT;PROPERTIES" ${ARGN})
  # Suites of one program share skies and worlds, in a cache that is empty at first (tests/CMakeLists.txt); tests write nothing
  # into the home of the user.
  set(environment ${AIRSIM360_TEST_CACHE} ${ARG_ENVIRONMENT})
  string(REPLACE ";" " " properties "${ARG_PROPERTIES}")
  set(list ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
  add_custom_command(TARGET ${target} POST_BUILD BYPRODUCTS ${list}
                     COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:${target}> -DLIST=${list} -DFOLDER=${CMAKE_SOURCE_DIR}
                             "-DENVIRONMENT=${environment}" "-DPROPERTIES=${properties}" -P ${CMAKE_SOURCE_DIR}/cmake/Suites.cmake VERBATIM)
  set(include ${CMAKE_CURRENT_BINARY_DIR}/${target}_include.cmake)
  file(WRITE ${include} "if(EXISTS \"${list}\")\n  include(\"${list}\")\nelse()\n  add_test(${target}_NOT_BUILT ${target}_NOT_BUILT)\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${include})
endfunction()
