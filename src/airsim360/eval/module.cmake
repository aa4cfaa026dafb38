# One of two sources knows HDF5; the other says that this build has none.
get_target_property(eval_sources airsim360_eval SOURCES)
if(HDF5_INCLUDE_DIR AND HDF5_LIBRARY)
  list(FILTER eval_sources EXCLUDE REGEX "/hdf5_none\\.cc$")
  set_source_files_properties(${CMAKE_CURRENT_SOURCE_DIR}/src/airsim360/eval/files/hdf5_library.cc PROPERTIES COMPILE_OPTIONS "-isystem;${HDF5_INCLUDE_DIR}")
else()
  list(FILTER eval_sources EXCLUDE REGEX "/hdf5_library\\.cc$")
endif()
set_target_properties(airsim360_eval PROPERTIES SOURCES "${eval_sources}")
