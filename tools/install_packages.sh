#!/bin/bash
# Installs the Debian packages of one or more purposes (see tools/packages.txt), if they are missing.
#
# usage: tools/install_packages.sh PURPOSE...      PURPOSE: build run viewer test full globe wasm bench paper lint dist
#
# If all are installed, it does nothing: no network, no rights. Otherwise apt-get runs once, as root or through sudo
# without a password. If neither is possible, it prints the command to run and exits with 1.
# Without apt it lists the packages, and the build continues: CMake reports missing ones.
set -euo pipefail
list=$(dirname "$0")/packages.txt

if [ $# -eq 0 ]; then
  echo "usage: $0 PURPOSE... (build run viewer test full globe wasm bench paper lint dist)" >&2
  exit 1
fi

is_installed() {
  [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

needed=()
for purpose in "$@"; do
  known=no
  while read -r word package command; do
    [ "$word" = "$purpose" ] || continue
    known=yes
    case " ${needed[*]-} " in *" $package "*) continue ;; esac
    if [ -n "$command" ] && command -v "$command" >/dev/null; then continue; fi
    needed+=("$package")
  done <"$list"
  [ $known = yes ] || { echo "$0: unknown purpose $purpose (build run viewer test full globe wasm bench paper lint dist)" >&2; exit 1; }
done

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  echo "This is not a Debian machine. Needed, by Debian's names: ${needed[*]-}"
  exit 0
fi

missing=()
for package in ${needed[@]+"${needed[@]}"}; do
  is_installed "$package" || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

install="apt-get -o DPkg::Lock::Timeout=300 install -y --no-install-recommends ${missing[*]}"
if [ "$(id -u)" -eq 0 ]; then
  as_root=()
elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
  as_root=(sudo -n)
else
  echo "Missing packages: ${missing[*]}. Please run this line, then the same make command again:" >&2
  echo "  sudo apt-get update && sudo $install" >&2
  exit 1
fi
log=$(mktemp "${TMPDIR:-/tmp}/scarp-packages.XXXXXX")
echo "Installing ${#missing[@]} packages and what they need: ${missing[*]} (apt's output: $log)"
# apt COMMAND...: runs as root with output to the log.
apt() {
  "${as_root[@]+"${as_root[@]}"}" env DEBIAN_FRONTEND=noninteractive "$@" -q </dev/null >>"$log" 2>&1 || {
    tail -n 20 "$log" >&2
    exit 1
  }
}
apt apt-get -o DPkg::Lock::Timeout=300 update
# shellcheck disable=SC2086  # one word for each package
apt $install
