# Files named *_kernel.cc are compiled once for each instruction set, with AIRSIM360_ISA naming the namespace of that
# copy, and chosen at run time (kernel_isa.h). They must agree bit for bit: no FMA contraction, no fast-math.
set(kernels ${sources})
list(FILTER kernels INCLUDE REGEX "_kernel\\.cc$")
list(FILTER sources EXCLUDE REGEX "_kernel\\.cc$")
set_target_properties(airsim360_render PROPERTIES SOURCES "${sources}")

set(kernel_flags_sse42 -msse4.2)
set(kernel_flags_avx2 -mavx2 -mf16c -mbmi -mbmi2 -mlzcnt)
set(kernel_flags_avx512 -mavx2 -mf16c -mbmi -mbmi2 -mlzcnt -mavx512f -mavx512dq -mavx512bw -mavx512vl
                        -mprefer-vector-width=512)
set(kernel_objects "")
if(kernels)
  foreach(isa sse42 avx2 avx512)
    add_library(airsim360_render_${isa} OBJECT ${kernels})
    target_compile_definitions(airsim360_render_${isa} PRIVATE AIRSIM360_ISA=isa_${isa})
    # -O3 in every configuration: inlining is what keeps shared weak symbols out of these objects.
    target_compile_options(airsim360_render_${isa} PRIVATE -O3 -fno-exceptions -ffp-contract=off -fno-math-errno -fno-trapping-math
                                                           ${kernel_flags_${isa}})
    target_include_directories(airsim360_render_${isa} PRIVATE ${CMAKE_SOURCE_DIR}/src)
    target_sources(airsim360_render PRIVATE $<TARGET_OBJECTS:airsim360_render_${isa}>)
    list(APPEND kernel_objects $<TARGET_OBJECTS:airsim360_render_${isa}>)
  endforeach()
  # A weak symbol shared by two copies would let the linker give AVX-512 code to a machine without it.
  if(NOT AIRSIM360_FUZZ)
    add_test(NAME render.KernelObjectsShareNoWeakSymbols
             COMMAND ${CMAKE_COMMAND} "-DNM=${CMAKE_NM}" "-DOBJECTS=$<JOIN:${kernel_objects},|>"
                     -P ${dir}/check_kernel_symbols.cmake)
  endif()
endif()
