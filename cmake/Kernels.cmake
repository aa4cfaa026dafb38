# Kernels for this machine alone take a third of the time; a program built so refuses others. Tests compare instruction
# sets, and are there with all alone.
set(AIRSIM360_KERNELS all CACHE STRING "instruction sets that kernels are compiled for: all, or native")
set(airsim360_isas sse42 avx2 avx512)
set(AIRSIM360_TESTS ON)
if(AIRSIM360_KERNELS STREQUAL "native")
  set(AIRSIM360_TESTS OFF)
  # As BestIsa in base/kernel_isa.cc.
  file(STRINGS /proc/cpuinfo cpu REGEX "^flags" LIMIT_COUNT 1)
  if(cpu MATCHES " avx512f " AND cpu MATCHES " avx512dq " AND cpu MATCHES " avx512bw " AND cpu MATCHES " avx512vl " AND cpu MATCHES " bmi2 ")
    set(airsim360_isas avx512)
  elseif(cpu MATCHES " avx2 " AND cpu MATCHES " bmi2 ")
    set(airsim360_isas avx2)
  else()
    set(airsim360_isas sse42)
  endif()
  string(SUBSTRING ${airsim360_isas} 0 1 initial)
  string(SUBSTRING ${airsim360_isas} 1 -1 rest)
  string(TOUPPER ${initial} initial)
  set_source_files_properties(${CMAKE_SOURCE_DIR}/src/airsim360/base/kernel_isa.cc PROPERTIES COMPILE_DEFINITIONS AIRSIM360_ONLY_ISA=k${initial}${rest}
                              SKIP_UNITY_BUILD_INCLUSION ON)
  enable_language(ASM)
elseif(NOT AIRSIM360_KERNELS STREQUAL "all")
  message(FATAL_ERROR "AIRSIM360_KERNELS is \"${AIRSIM360_KERNELS}\"; it must be all or native")
endif()

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
  foreach(isa ${airsim360_isas})
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
  if(AIRSIM360_KERNELS STREQUAL "native")
    set(absent ${CMAKE_CURRENT_BINARY_DIR}/absent_${name}_kernels.s)
    add_custom_command(OUTPUT ${absent} DEPENDS ${objects} ${CMAKE_SOURCE_DIR}/cmake/absent_kernels.cmake
                       COMMAND ${CMAKE_COMMAND} "-DNM=${CMAKE_NM}" "-DOBJECTS=$<JOIN:${objects},|>" -DISA=${airsim360_isas} -DOUT=${absent}
                               -P ${CMAKE_SOURCE_DIR}/cmake/absent_kernels.cmake VERBATIM)
    target_sources(airsim360_${name} PRIVATE ${absent})
    return()
  endif()
  # A weak symbol shared by two copies would let the linker give AVX-512 code to a machine without it.
  add_test(NAME ${name}.KernelObjectsShareNoWeakSymbols
           COMMAND ${CMAKE_COMMAND} "-DNM=${CMAKE_NM}" "-DOBJECTS=$<JOIN:${objects},|>"
                   -P ${CMAKE_SOURCE_DIR}/cmake/check_kernel_symbols.cmake)
endfunction()
