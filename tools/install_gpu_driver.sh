#!/bin/sh
# A Vulkan driver that traces rays in software (Mesa's lavapipe, 24.1 or later), for the tests of the GPU renderer, from
# bookworm-backports where apt knows it. Never fails: without a driver those tests skip, and this says so.
set -eu
package=mesa-vulkan-drivers
skip() {
  echo "GPU tests will run only on a hardware GPU and else skip: $1" >&2
  exit 0
}
[ "$(uname -m)" = x86_64 ] || skip "software ray tracing is tested on x86-64 alone"
installed="$(dpkg-query -W -f='${Version}' $package 2>/dev/null || true)"
if [ -n "$installed" ] && dpkg --compare-versions "$installed" ge 24.1; then exit 0; fi
apt-cache madison $package 2>/dev/null | grep -q bookworm-backports ||
  skip "apt knows no bookworm-backports (add 'deb http://deb.debian.org/debian bookworm-backports main' for $package >= 24.1)"
sudo=""
if [ "$(id -u)" -ne 0 ]; then
  sudo -n true 2>/dev/null || skip "not root: apt-get install -t bookworm-backports $package"
  sudo="sudo"
fi
echo "Installing $package from bookworm-backports"
$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends -t bookworm-backports $package >/dev/null 2>&1 ||
  skip "apt-get install -t bookworm-backports $package failed"
