#!/bin/sh
# Builds the program and collects eight labelled panoramas of downtown_west; prints where the contact sheet is.
set -eu
build="$1"; jobs="$2"
cd "$(dirname "$0")/.."
tools/configure.sh "$build"
cmake --build "$build" -j "$jobs" --target airsim360
rm -rf demo/downtown_west
"$build/bin/airsim360" collect --world downtown_west --frames 8 --size 2048x1024 --tier fast --seed 0 --out demo/downtown_west
echo "Pictures: $PWD/demo/downtown_west/contact_sheet.png"
