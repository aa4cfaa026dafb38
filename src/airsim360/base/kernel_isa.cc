#include "airsim360/base/kernel_isa.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>

#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

constexpr const char* kNames[] = {"sse42", "avx2", "avx512"};

#ifdef AIRSIM360_ONLY_ISA  // set by cmake/Kernels.cmake where the others were not compiled
constexpr KernelIsa kOldest = KernelIsa::AIRSIM360_ONLY_ISA, kNewest = kOldest;
#else
constexpr KernelIsa kOldest = KernelIsa::kSse42, kNewest = KernelIsa::kAvx512;
#endif

KernelIsa BestIsa() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("bmi2")) {
    return KernelIsa::kAvx512;
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2")) return KernelIsa::kAvx2;
  return KernelIsa::kSse42;
}

KernelIsa PickIsa() {
  const KernelIsa best = std::min(BestIsa(), kNewest);
  if (best < kOldest) {
    throw InputError(std::string("this program was built for machines with ") + kNames[static_cast<int>(kOldest)] +
                     " alone, and this one has only " + kNames[static_cast<int>(best)] + "; `make build` builds it for all");
  }
  const char* wanted = std::getenv("AIRSIM360_ISA");
  if (wanted == nullptr || *wanted == '\0') return best;
  for (int i = 0; i < 3; ++i) {
    if (std::string(wanted) != kNames[i]) continue;
    if (i < static_cast<int>(kOldest) || i > static_cast<int>(kNewest)) {
      throw InputError(std::string("AIRSIM360_ISA=") + wanted + ": this program was built for " + kNames[static_cast<int>(kOldest)] +
                       " alone; `make build` builds it for all");
    }
    if (i > static_cast<int>(best)) {
      throw InputError(std::string("AIRSIM360_ISA=") + wanted + ": this machine has only " + kNames[static_cast<int>(best)]);
    }
    return static_cast<KernelIsa>(i);
  }
  const std::array<std::string, 3> choices = {kNames[0], kNames[1], kNames[2]};
  throw InputError(UnknownChoiceMessage("AIRSIM360_ISA", wanted, choices));
}

}  // namespace

KernelIsa CurrentKernelIsa() {
  static const KernelIsa isa = PickIsa();
  return isa;
}

}  // namespace airsim360::internal
