# PYTHONPATH=build/python finds the packages of python/: links, so that nothing needs to be built again after an edit.
# build/python/airsim360 is a folder of its own, where the compiled module lies beside the linked sources.
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/python/airsim360)
file(GLOB python_parts CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR}/python ${CMAKE_SOURCE_DIR}/python/msgpackrpc
     ${CMAKE_SOURCE_DIR}/python/airsim360/*)
list(FILTER python_parts EXCLUDE REGEX "__pycache__")
foreach(part ${python_parts})
  file(CREATE_LINK ${CMAKE_SOURCE_DIR}/python/${part} ${CMAKE_BINARY_DIR}/python/${part} SYMBOLIC)
endforeach()

# airsim360._native. Debian's Python unless told otherwise (a wheel is built for the Python that builds it).
if(AIRSIM360_PYTHON)
  if(NOT DEFINED PYTHON_EXECUTABLE)
    set(PYTHON_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python that the module is for")
  endif()
  find_package(pybind11 REQUIRED)
  file(GLOB native_sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/python/src/*.cc)
  pybind11_add_module(airsim360_native MODULE NO_EXTRAS ${native_sources})
  airsim360_unity(airsim360_native last ${native_sources})
  # As other front doors (cmake/Module.cmake).
  target_compile_options(airsim360_native PRIVATE -O1)
  set_target_properties(airsim360_native PROPERTIES OUTPUT_NAME _native LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/python/airsim360)
  target_link_libraries(airsim360_native PRIVATE airsim360_tasks airsim360_mission airsim360_dataset airsim360_planning airsim360_eval airsim360_video)
  if(AIRSIM360_PCH)
    target_precompile_headers(airsim360_native PRIVATE <pybind11/pybind11.h> <pybind11/numpy.h> <pybind11/stl.h>)
  endif()
  # Our libraries are inside and invisible to others; that also lets their kernels be linked without -fPIC.
  # Libraries that no part of the module needs (OpenCV) stay out of the wheel.
  target_link_options(airsim360_native PRIVATE -Wl,--exclude-libs,ALL -Wl,--as-needed)
endif()
