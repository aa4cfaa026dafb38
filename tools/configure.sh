#!/bin/sh
# Configures a Release build in the given folder; silent unless it fails.
set -eu
build="$1"
[ -f "$build/build.ninja" ] && exit 0
mkdir -p "$build"
cmake -S "$(dirname "$0")/.." -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release >"$build/configure.log" 2>&1 || { cat "$build/configure.log" >&2; exit 1; }
