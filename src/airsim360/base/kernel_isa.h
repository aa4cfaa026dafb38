// Code compiled once per instruction set (files *_kernel.cc, see cmake/Kernels.cmake) and chosen at run time.
//
// Rules for a *_kernel.cc file: everything it defines lives in namespace airsim360::internal::AIRSIM360_ISA
// or in an anonymous namespace; what it includes may bring only types and always_inline functions, because a
// weak symbol (inline function, template instance) would be merged by the linker across instruction sets. A
// test checks the objects.
#pragma once

namespace airsim360::internal {

enum class KernelIsa { kSse42, kAvx2, kAvx512 };

/// The best instruction set of this machine, or the one named by the environment variable AIRSIM360_ISA
/// (sse42, avx2, avx512; read once). InputError for another name or one this machine lacks.
KernelIsa CurrentKernelIsa();

/// The copy that this machine runs, of three functions or tables.
template <class T>
T SelectKernel(T sse42, T avx2, T avx512) {
  const KernelIsa isa = CurrentKernelIsa();
  return isa == KernelIsa::kAvx512 ? avx512 : isa == KernelIsa::kAvx2 ? avx2 : sse42;
}

}  // namespace airsim360::internal

/// Declares the same function or variable in the namespace of every instruction set.
#define AIRSIM360_DECLARE_KERNEL(...) \
  namespace airsim360::internal {     \
  namespace isa_sse42 {               \
  __VA_ARGS__;                        \
  }                                   \
  namespace isa_avx2 {                \
  __VA_ARGS__;                        \
  }                                   \
  namespace isa_avx512 {              \
  __VA_ARGS__;                        \
  }                                   \
  }

/// The copy of a kernel declared so that this machine runs.
#define AIRSIM360_SELECT_KERNEL(name)                                                                                  \
  ::airsim360::internal::SelectKernel(&::airsim360::internal::isa_sse42::name, &::airsim360::internal::isa_avx2::name, \
                                      &::airsim360::internal::isa_avx512::name)
