#!/bin/sh
# A Vulkan driver that traces rays in software (Mesa's lavapipe, 24.1 or later), for the tests of the GPU renderer, from
# bookworm-backports. Never fails: without a driver those tests skip, and this says so.
set -eu
[ "$(uname -m)" = x86_64 ] && "$(dirname "$0")/install_backport.sh" mesa-vulkan-drivers 24.1 && exit 0
echo "GPU tests will run only on a hardware GPU and else skip (software ray tracing: mesa-vulkan-drivers >= 24.1, x86-64)" >&2
