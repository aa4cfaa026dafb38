airsim360_kernels(trace)
