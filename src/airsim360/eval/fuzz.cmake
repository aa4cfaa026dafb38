# As module.cmake: one of two sources knows HDF5.
include(${CMAKE_CURRENT_LIST_DIR}/module.cmake)
