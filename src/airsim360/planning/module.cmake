airsim360_kernels(planning)
# Vectors stay inside the kernels, so how they would be passed to others does not matter. Loops over states, axes and
# powers must unroll completely, for their arrays are registers.
foreach(isa ${airsim360_isas})
  target_compile_options(airsim360_planning_${isa} PRIVATE -Wno-psabi --param=max-completely-peeled-insns=4000 --param=max-completely-peel-times=32)
endforeach()
# One route is two chains of four lanes: longer vectors would only be written for narrower ones to wait for.
set_source_files_properties(${CMAKE_SOURCE_DIR}/src/airsim360/planning/spline_kernel.cc PROPERTIES COMPILE_OPTIONS -mprefer-vector-width=256)
