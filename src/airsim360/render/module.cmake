airsim360_kernels(render)
