airsim360_kernels(planning)
# Vectors stay inside the kernels, so how they would be passed to others does not matter.
foreach(isa sse42 avx2 avx512)
  target_compile_options(airsim360_planning_${isa} PRIVATE -Wno-psabi)
endforeach()
