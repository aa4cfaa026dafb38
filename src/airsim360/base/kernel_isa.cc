#include "airsim360/base/kernel_isa.h"

#include <array>
#include <cstdlib>
#include <string>

#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

constexpr const char* kNames[] = {"sse42", "avx2", "avx512"};

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
  const KernelIsa best = BestIsa();
  const char* wanted = std::getenv("AIRSIM360_ISA");
  if (wanted == nullptr || *wanted == '\0') return best;
  for (int i = 0; i < 3; ++i) {
    if (std::string(wanted) != kNames[i]) continue;
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
