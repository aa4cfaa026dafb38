# Sources of one library compiled together, up to 24 at a time in the order of their folders (tests: of one folder):
# headers and templates are parsed once for them. Names in their unnamed namespaces must differ. Off for those who edit
# one file often (-DAIRSIM360_UNITY=OFF) and under a compiler cache, which knows single files better.
option(AIRSIM360_UNITY "compile sources of a library together" ${AIRSIM360_PARSE_ONCE})

# airsim360_unity(TARGET KIND SOURCES...): the sources are absolute paths; those of two kinds are kept apart.
function(airsim360_unity target kind)
  if(NOT AIRSIM360_UNITY)
    return()
  endif()
  # What is compiled last is left to one core otherwise.
  set(size 24)
  if(kind STREQUAL "last")
    set(size 8)
  endif()
  foreach(source ${ARGN})
    set(group ${kind})
    # Tests of two folders call many things alike.
    if(kind STREQUAL "tests")
      get_filename_component(folder ${source} DIRECTORY)
      file(RELATIVE_PATH folder ${CMAKE_SOURCE_DIR} ${folder})
      string(MAKE_C_IDENTIFIER ${folder} folder)
      string(APPEND group _${folder})
    endif()
    if(NOT DEFINED count_${group})
      set(count_${group} 0)
    endif()
    math(EXPR part "${count_${group}} / ${size}")
    math(EXPR count_${group} "${count_${group}} + 1")
    set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${group}_${part})
  endforeach()
  # It takes every file that is included for a header.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
