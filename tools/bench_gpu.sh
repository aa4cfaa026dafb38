#!/bin/sh
# Builds, checks and times the GPU renderer in under ten minutes; the table names the device. Works in software too, with small
# pictures. What fails is said and the rest goes on; exit status 1 then.
set -eu
build="$1"; jobs="$2"
cd "$(dirname "$0")/.."
. tools/find_nvidia_vulkan.sh
tools/install_gpu_driver.sh
echo "== build"
tools/configure.sh "$build"
cmake --build "$build" -j "$jobs" --target gpu_test gpu_bench >"$build/bench_gpu.log" 2>&1 || { cat "$build/bench_gpu.log" >&2; exit 1; }
echo "== devices"
"$build"/bin/gpu_bench --list
status=0
# A GPU that Vulkan does not know: the loader says why.
if [ -e /dev/nvidiactl ] && ! "$build"/bin/gpu_bench --list | grep -qi nvidia; then
  echo "NVIDIA's device files are here, but no Vulkan driver answers:"
  VK_LOADER_DEBUG=error,warn "$build"/bin/gpu_bench --list 2>&1 | grep -i -E 'error|warn' | head -20
  echo "(containers: run with NVIDIA_DRIVER_CAPABILITIES=all, or set VK_DRIVER_FILES to the driver's nvidia_icd.json)"
  status=1
fi
echo "== check"
said=0
AIRSIM360_CACHE='' GALLIVM_PERF=nopt timeout 200 "$build"/bin/gpu_test --gtest_brief=1 || said=$?
if [ "$said" -eq 124 ]; then echo "CHECK: not done in 200 s"; status=1; elif [ "$said" -ne 0 ]; then echo "CHECK: FAILED, see above"; status=1; fi
echo "== time"
said=0
timeout 240 "$build"/bin/gpu_bench || said=$?
if [ "$said" -eq 124 ]; then echo "TIME: not done in 240 s"; status=1; elif [ "$said" -ne 0 ]; then status=1; fi
exit $status
