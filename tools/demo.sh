#!/bin/sh
# Builds the program for this machine alone and collects eight labelled panoramas of downtown_west with people and traffic;
# prints where the contact sheet is, and builds the Python module. `make build` adds the other instruction sets.
set -eu
build="$1"; jobs="$2"
cd "$(dirname "$0")/.."
tools/configure.sh "$build" native
cmake --build "$build" -j "$jobs" --target airsim360
rm -rf demo/downtown_west
"$build/bin/airsim360" collect --world downtown_west --frames 8 --size 2048x1024 --tier fast --seed 0 --people 40 --traffic 12 --out demo/downtown_west
echo "Pictures: $PWD/demo/downtown_west/contact_sheet.png"
echo "Building the Python module (a minute) …"
cmake --build "$build" -j "$jobs" --target airsim360_native
echo "In Python: PYTHONPATH=$build/python /usr/bin/python3 -c 'import airsim360; print(airsim360.Dataset(\"demo/downtown_west\"))'"
