#!/bin/sh
# Brief fuzzing of every parser, with one seed so that what it finds can be found again (`make fuzz` takes new
# ones), then all tests. FUZZ_SECONDS=0 skips the fuzzing.
set -eu
build="$1"; jobs="$2"
cd "$(dirname "$0")/.."
[ "${FUZZ_SECONDS:-2}" -eq 0 ] || tools/fuzz.sh "$build" "$jobs" "${FUZZ_SECONDS:-2}" 1
tools/install_gpu_driver.sh
tools/install_backport.sh python3-scikit-build-core || echo "the test of the wheel will be skipped" >&2
cd "$build"
# One more than there are cores: some tests wait for clocks.
exec ctest --output-on-failure -j "$((jobs + 1))" --timeout 600
