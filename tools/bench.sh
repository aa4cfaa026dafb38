#!/bin/sh
# Runs every benchmark of bench/ and prints its table. Ratios are from one run; absolute times belong to this machine.
set -eu
build="$1"
for command in "traversal_bench" "traversal_bench --isa avx2" "traversal_bench --trees 2000" "frame_bench" "color_bench" "color_bench --latitude --scene city" "filter_bench" "cube_bench" "scene_bench" "flight_bench" "drone_bench" "sim_bench" "planning_bench" "waypoint_bench"; do
  echo "== $command"
  # shellcheck disable=SC2086
  "$build"/bin/$command
done
echo "== gym_bench.py"
PYTHONPATH="$build/python" /usr/bin/python3 "$(dirname "$0")/../bench/gym_bench.py"
