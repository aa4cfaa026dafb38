# Sources of one folder compiled together, up to eight at a time: headers and templates are parsed once for them, which
# halves a cold build. Names in their unnamed namespaces must differ. Off for those who edit one file often
# (-DAIRSIM360_UNITY=OFF) and under a compiler cache, which knows single files better.
option(AIRSIM360_UNITY "compile the sources of a folder together" ${AIRSIM360_PARSE_ONCE})

# airsim360_unity(TARGET KIND SOURCES...): the sources are absolute paths; those of two kinds are kept apart.
function(airsim360_unity target kind)
  if(NOT AIRSIM360_UNITY)
    return()
  endif()
  foreach(source ${ARGN})
    get_filename_component(folder ${source} DIRECTORY)
    file(RELATIVE_PATH folder ${CMAKE_SOURCE_DIR} ${folder})
    string(MAKE_C_IDENTIFIER ${folder} folder)
    if(NOT DEFINED count_${folder})
      set(count_${folder} 0)
    endif()
    math(EXPR group "${count_${folder}} / 8")
    math(EXPR count_${folder} "${count_${folder}} + 1")
    set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${kind}_${folder}_${group})
  endforeach()
  # It takes every file that is included for a header.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
