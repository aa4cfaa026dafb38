# PYTHONPATH=build/python finds the packages of python/: links, so that nothing needs to be built again after an edit.
# build/python/airsim360 is a folder of its own, where compiled modules have a place beside the linked sources.
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/python/airsim360)
file(GLOB python_parts CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR}/python ${CMAKE_SOURCE_DIR}/python/msgpackrpc
     ${CMAKE_SOURCE_DIR}/python/airsim360/*)
foreach(part ${python_parts})
  file(CREATE_LINK ${CMAKE_SOURCE_DIR}/python/${part} ${CMAKE_BINARY_DIR}/python/${part} SYMBOLIC)
endforeach()
