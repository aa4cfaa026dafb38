#!/bin/sh
# Builds every *_fuzz.cc with clang, AddressSanitizer and UndefinedBehaviorSanitizer and runs each for SECONDS.
# Usage: tools/fuzz.sh BUILD_FOLDER JOBS SECONDS. 0 seconds: builds alone. A crashing input is kept in BUILD_FOLDER/artifacts.
set -eu
build="$1"; jobs="$2"; seconds="$3"
cd "$(dirname "$0")/.."
if [ ! -f "$build/build.ninja" ]; then
  mkdir -p "$build"
  cmake --preset fuzz -B "$build" >"$build/configure.log" 2>&1 || { cat "$build/configure.log" >&2; exit 1; }
fi
targets=$(find src -name '*_fuzz.cc' -exec basename {} .cc \; | sort)
# shellcheck disable=SC2086
cmake --build "$build" -j "$jobs" --target $targets
[ "$seconds" -gt 0 ] || exit 0  # to libFuzzer 0 would mean without end
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
