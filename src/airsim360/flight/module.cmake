airsim360_kernels(flight)
# Points-to analysis finds nothing in code that is all in registers, and takes half the compiler's time.
set_source_files_properties(${dir}/dynamics/batch_kernel.cc PROPERTIES COMPILE_OPTIONS $<$<CXX_COMPILER_ID:GNU>:-fno-tree-pta>)
