#!/bin/sh
# Configures a Release build in a folder that is not configured yet; silent unless it fails.
# Usage: tools/configure.sh BUILD_FOLDER [native|all]: instruction sets of its kernels; all also for a folder that was native.
set -eu
build="$1"; kernels="${2:-}"
if [ -f "$build/build.ninja" ] && { [ "$kernels" != all ] || ! grep -q '^AIRSIM360_KERNELS:STRING=native' "$build/CMakeCache.txt"; }; then exit 0; fi
mkdir -p "$build"
cmake -S "$(dirname "$0")/.." -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release "-DAIRSIM360_KERNELS=${kernels:-all}" >"$build/configure.log" 2>&1 ||
  { cat "$build/configure.log" >&2; exit 1; }
