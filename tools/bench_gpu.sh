#!/bin/sh
# Builds, checks and times the GPU renderer; the table names the device. Works in software too, with small pictures.
set -eu
build="$1"; jobs="$2"
cd "$(dirname "$0")/.."
tools/install_gpu_driver.sh
tools/configure.sh "$build"
cmake --build "$build" -j "$jobs" --target gpu_test gpu_bench
echo "== check"
AIRSIM360_CACHE='' GALLIVM_PERF=nopt timeout 240 "$build"/bin/gpu_test --gtest_brief=1
echo "== time"
timeout 240 "$build"/bin/gpu_bench
