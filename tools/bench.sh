#!/bin/sh
# Runs every benchmark of bench/ and prints its table. Ratios are from one run; absolute times belong to this machine.
set -eu
build="$1"
for program in "$build"/bin/*_bench; do
  echo "== $(basename "$program")"
  "$program"
done
