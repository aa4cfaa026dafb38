#!/bin/sh
# Builds the documentation into site/, after its checks, and the gallery's panoramas with the program of the build folder; installs
# Debian's mkdocs-material where it is missing.
set -eu
build="$1"; jobs="$2"
cd "$(dirname "$0")/.."
tools/check_docs.py
if ! dpkg-query -W -f='${Status}' mkdocs-material 2>/dev/null | grep -q 'install ok installed'; then
  sudo=""
  [ "$(id -u)" -eq 0 ] || sudo="sudo"
  echo "Installing Debian package: mkdocs-material"
  $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends mkdocs-material >/dev/null
fi
mkdocs build --strict --quiet
tools/configure.sh "$build"
cmake --build "$build" -j "$jobs" --target airsim360
# made once: run again, it makes what is missing
"$build/bin/airsim360" dataset run docs/start/gallery.yaml --device cpu --out "$build/gallery"
"$build/bin/airsim360" view "$build/gallery" --export site/start/gallery/frames
echo "Pages: $PWD/site/index.html"
