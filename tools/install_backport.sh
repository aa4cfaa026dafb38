#!/bin/sh
# Installs a package of Debian's bookworm-backports: tools/install_backport.sh PACKAGE [OLDEST_VERSION]. Where apt does not
# know that suite it is asked for this once, by lists of its own; the sources of the system stay as they are. Exit status 1
# where it cannot be had.
set -eu
package="$1"
suite=bookworm-backports
installed="$(dpkg-query -W -f='${Status} ${Version}' "$package" 2>/dev/null | sed -n 's/^install ok installed //p')"
[ -n "$installed" ] && dpkg --compare-versions "$installed" ge "${2:-0}" && exit 0
sudo=""
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "not root and no sudo: run as root: apt-get install -t $suite $package" >&2; exit 1; }
  sudo="sudo"
fi
echo "Installing $package from $suite"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
options=""
if ! apt-cache madison "$package" 2>/dev/null | grep -q "$suite"; then
  chmod 755 "$folder"
  mkdir -p "$folder/lists/partial"
  keys=/usr/share/keyrings/debian-archive-keyring.gpg
  printf 'deb [signed-by=%s] http://deb.debian.org/debian bookworm main\ndeb [signed-by=%s] http://deb.debian.org/debian %s main\n' \
    "$keys" "$keys" "$suite" >"$folder/sources.list"
  options="-o Dir::Etc::SourceList=$folder/sources.list -o Dir::Etc::SourceParts=/dev/null -o Dir::State::Lists=$folder/lists"
  # shellcheck disable=SC2086
  $sudo apt-get $options update -qq
fi
# shellcheck disable=SC2086
$sudo env DEBIAN_FRONTEND=noninteractive apt-get $options install -y -qq --no-install-recommends -t "$suite" "$package" >/dev/null
