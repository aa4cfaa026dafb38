airsim360_kernels(mpde)
