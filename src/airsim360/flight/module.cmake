airsim360_kernels(flight)
