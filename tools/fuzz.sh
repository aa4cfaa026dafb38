#!/bin/sh
# Builds every *_fuzz.cc with clang, AddressSanitizer and UndefinedBehaviorSanitizer and runs each for SECONDS.
# Usage: tools/fuzz.sh BUILD_FOLDER JOBS SECONDS [SEED], with the ordinary build in BUILD_FOLDER, the fuzz targets in
# its folder fuzz. 0 seconds: builds alone. The seed is libFuzzer's: another one each time unless given. A crashing
# input is kept in BUILD_FOLDER/fuzz/artifacts.
set -eu
cd "$(dirname "$0")/.."
release=$(realpath "$1"); build="$release/fuzz"; jobs="$2"; seconds="$3"; seed="${4:-0}"
if [ ! -f "$build/build.ninja" ]; then
  mkdir -p "$build"
  cmake --preset fuzz -B "$build" -DAIRSIM360_RELEASE="$release" >"$build/configure.log" 2>&1 || { cat "$build/configure.log" >&2; exit 1; }
fi
targets=$(find src -name '*_fuzz.cc' -exec basename {} .cc \; | sort)
# shellcheck disable=SC2086
cmake --build "$build" -j "$jobs" --target $targets
[ "$seconds" -gt 0 ] || exit 0  # to libFuzzer 0 would mean without end
mkdir -p "$build/artifacts"
# $0 is one target; as many at a time as there are jobs
fuzz='
  corpus="$build/corpus/$0"
  mkdir -p "$corpus"
  seeds=""
  [ -d "data/fuzz/$0" ] && seeds="data/fuzz/$0"
  echo "fuzzing $0 for $seconds s"
  "$build/bin/$0" -max_total_time="$seconds" -seed="$seed" -timeout=20 -rss_limit_mb=3000 -max_len=65536 -verbosity=0 -print_final_stats=0 \
    -artifact_prefix="$build/artifacts/$0-" "$corpus" $seeds 2>"$build/$0.log" || { tail -40 "$build/$0.log"; exit 255; }'
export build seconds seed
echo "$targets" | xargs -n 1 -P "$jobs" sh -c "$fuzz"
