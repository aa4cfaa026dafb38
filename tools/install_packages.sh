#!/bin/sh
# Installs the Debian packages listed in tools/packages.txt, and those named as arguments, that are missing; does nothing when all
# are present.
set -eu
list="$(dirname "$0")/packages.txt"
missing=""
for package in $(sed 's/#.*//' "$list") "$@"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing="$missing $package"
done
[ -n "$missing" ] || exit 0
echo "Installing Debian packages:$missing"
sudo=""
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "not root and no sudo: run as root: apt-get install$missing" >&2; exit 1; }
  sudo="sudo"
fi
$sudo apt-get update -qq || true
# shellcheck disable=SC2086
$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null
