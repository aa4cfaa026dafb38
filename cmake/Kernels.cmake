# airsim360_kernels(NAME): call it in a module's module.cmake. Files of the module named *_kernel.cc are compiled once
# for each instruction set, with AIRSIM360_ISA naming the namespace of that copy, and chosen at run time
# (base/kernel_isa.h). They must agree bit for bit: no FMA contraction, no fast-math.
function(airsim360_kernels name)
  get_target_property(sources airsim360_${name} SOURCES)
  set(kernels ${sources})
  list(FILTER kernels INCLUDE REGEX "_kernel\\.cc$")
  list(FILTER sources EXCLUDE REGEX "_kernel\\.cc$")
  set_target_properties(airsim360_${name} PROPERTIES SOURCES "${sources}")
  if(NOT kernels)
    return()
  endif()

  set(flags_sse42 -msse4.2)
  set(flags_avx2 -mavx2 -mf16c -mbmi -mbmi2 -mlzcnt)
  set(flags_avx512 ${flags_avx2} -mavx512f -mavx512dq -mavx512bw -mavx512vl -mprefer-vector-width=512)
  set(objects "")
  foreach(isa sse42 avx2 avx512)
    set(target airsim360_${name}_${isa})
    add_library(${target} OBJECT ${kernels})
    target_compile_definitions(${target} PRIVATE AIRSIM360_ISA=isa_${isa})
    # -O3 in every configuration: inlining is what keeps shared weak symbols out of these objects.
    target_compile_options(${target} PRIVATE -O3 -fno-exceptions -ffp-contract=off -fno-math-errno -fno-trapping-math ${flags_${isa}})
    # GCC 12 warns of its own _mm512_undefined_ps (GCC bug 105593).
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
    target_include_directories(${target} PRIVATE ${CMAKE_SOURCE_DIR}/src)
    target_sources(airsim360_${name} PRIVATE $<TARGET_OBJECTS:${target}>)
    list(APPEND objects $<TARGET_OBJECTS:${target}>)
  endforeach()
  # A weak symbol shared by two copies would let the linker give AVX-512 code to a machine without it.
  add_test(NAME ${name}.KernelObjectsShareNoWeakSymbols
           COMMAND ${CMAKE_COMMAND} "-DNM=${CMAKE_NM}" "-DOBJECTS=$<JOIN:${objects},|>"
                   -P ${CMAKE_SOURCE_DIR}/cmake/check_kernel_symbols.cmake)
endfunction()
