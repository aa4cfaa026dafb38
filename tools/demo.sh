#!/bin/sh
# Builds what collects pictures, for this machine alone, and with it eight labelled panoramas of downtown_west with people and
# traffic; prints where the contact sheet is, and builds the rest of the program and the Python module. `make build` adds the
# other instruction sets.
set -eu
build="$1"; jobs="$2"
cd "$(dirname "$0")/.."
tools/configure.sh "$build" native
cmake --build "$build" -j "$jobs" --target airsim360_pictures
rm -rf demo/downtown_west
"$build/bin/airsim360_pictures" collect --world downtown_west --frames 8 --size 2048x1024 --tier fast --seed 0 --people 40 --traffic 12 --out demo/downtown_west
echo "Pictures: $PWD/demo/downtown_west/contact_sheet.png"
echo "Building the other commands and the Python module (a few minutes) …"
cmake --build "$build" -j "$jobs" --target airsim360 airsim360_native
echo "In Python: PYTHONPATH=$build/python /usr/bin/python3 -c 'import airsim360; print(airsim360.Dataset(\"demo/downtown_west\"))'"
