airsim360_kernels(planning)
# Vectors stay inside the kernels, so how they would be passed to others does not matter. Loops over states, axes and
# powers must unroll completely, for their arrays are registers.
foreach(isa sse42 avx2 avx512)
  target_compile_options(airsim360_planning_${isa} PRIVATE -Wno-psabi --param=max-completely-peeled-insns=4000 --param=max-completely-peel-times=32)
endforeach()
