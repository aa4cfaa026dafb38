#!/bin/sh
# Builds the documentation into site/, after its checks; installs Debian's mkdocs-material where it is missing.
set -eu
cd "$(dirname "$0")/.."
tools/check_docs.py
if ! dpkg-query -W -f='${Status}' mkdocs-material 2>/dev/null | grep -q 'install ok installed'; then
  sudo=""
  [ "$(id -u)" -eq 0 ] || sudo="sudo"
  echo "Installing Debian package: mkdocs-material"
  $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends mkdocs-material >/dev/null
fi
mkdocs build --strict --quiet
echo "Pages: $PWD/site/index.html"
