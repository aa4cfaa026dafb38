#!/bin/sh
# Builds every *_fuzz.cc with clang, AddressSanitizer and UndefinedBehaviorSanitizer and runs each for SECONDS.
# Usage: tools/fuzz.sh BUILD_FOLDER JOBS SECONDS, with the ordinary build in BUILD_FOLDER, the fuzz targets in its
# folder fuzz. A crashing input is kept in BUILD_FOLDER/fuzz/artifacts.
set -eu
cd "$(dirname "$0")/.."
release=$(realpath "$1"); build="$release/fuzz"; jobs="$2"; seconds="$3"
if [ ! -f "$build/build.ninja" ]; then
  mkdir -p "$build"
  cmake --preset fuzz -B "$build" -DAIRSIM360_RELEASE="$release" >"$build/configure.log" 2>&1 || { cat "$build/configure.log" >&2; exit 1; }
fi
targets=$(find src -name '*_fuzz.cc' -exec basename {} .cc \; | sort)
# shellcheck disable=SC2086
cmake --build "$build" -j "$jobs" --target $targets
mkdir -p "$build/artifacts"
for target in $targets; do
  corpus="$build/corpus/$target"
  mkdir -p "$corpus"
  seeds=""
  [ -d "data/fuzz/$target" ] && seeds="data/fuzz/$target"
  echo "fuzzing $target for $seconds s"
  # shellcheck disable=SC2086
  "$build/bin/$target" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=3000 -max_len=65536 -verbosity=0 -print_final_stats=0 \
    -artifact_prefix="$build/artifacts/$target-" "$corpus" $seeds 2>"$build/$target.log" || { tail -40 "$build/$target.log"; exit 1; }
done
