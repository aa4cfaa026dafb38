airsim360_kernels(render)
# GCC 12's points-to analysis before inlining takes 125 of the 155 seconds of this file for AVX-512. Without it the analysis
# after inlining finds as much; the compiler notes that it was left out.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND TARGET airsim360_render_avx512)
  set_source_files_properties(${CMAKE_CURRENT_SOURCE_DIR}/src/airsim360/render/shading/surface_kernel.cc TARGET_DIRECTORY airsim360_render_avx512
    PROPERTIES COMPILE_OPTIONS $<$<STREQUAL:$<TARGET_PROPERTY:NAME>,airsim360_render_avx512>:-fdisable-tree-ealias>)
endif()

# Shaders of vulkan/ are compiled to words of SPIR-V that gpu_shaders.cc includes.
set(shader_dir ${CMAKE_CURRENT_SOURCE_DIR}/src/airsim360/render/vulkan/shaders)
set(spirv_dir ${CMAKE_CURRENT_BINARY_DIR}/spirv)
file(MAKE_DIRECTORY ${spirv_dir})
file(GLOB shaders CONFIGURE_DEPENDS ${shader_dir}/*.rgen ${shader_dir}/*.rchit ${shader_dir}/*.rahit ${shader_dir}/*.rmiss
     ${shader_dir}/*.comp)
file(GLOB shader_parts CONFIGURE_DEPENDS ${shader_dir}/*.glsl ${shader_dir}/*.h
     ${CMAKE_CURRENT_SOURCE_DIR}/src/airsim360/render/shared/*.h)
set(spirv "")
foreach(shader ${shaders})
  get_filename_component(shader_name ${shader} NAME)
  add_custom_command(OUTPUT ${spirv_dir}/${shader_name}.inc
                     COMMAND ${GLSLANG_VALIDATOR} --quiet -V --target-env vulkan1.2 -I${CMAKE_CURRENT_SOURCE_DIR}/src
                             -x -o ${spirv_dir}/${shader_name}.inc ${shader}
                     DEPENDS ${shader} ${shader_parts} VERBATIM)
  list(APPEND spirv ${spirv_dir}/${shader_name}.inc)
endforeach()
target_sources(airsim360_render PRIVATE ${spirv})
target_include_directories(airsim360_render PRIVATE ${spirv_dir})

# Vulkan's structures are made of their type, the rest zero.
file(GLOB vulkan_sources ${CMAKE_CURRENT_SOURCE_DIR}/src/airsim360/render/vulkan/*.cc)
set_source_files_properties(${vulkan_sources} TARGET_DIRECTORY airsim360_render PROPERTIES COMPILE_OPTIONS -Wno-missing-field-initializers)
