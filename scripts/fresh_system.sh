#!/usr/bin/env bash
# fresh_system.sh [SUITE [COMMAND…]]: checks that the package lists are complete. In a Debian with only its base system
# (SUITE: bookworm, trixie) it installs the list `build` and configures as quickstart.sh does, then installs the list
# `test` and configures the builds of test.sh. Then it runs COMMAND there in a copy of this working tree, for example
# `scripts/fresh_system.sh trixie scripts/test.sh`.
#   --bare FOLDER SUITE COMMAND…   installs no package and runs COMMAND in a copy of FOLDER: checks that the files there
#   need nothing else
# Needs root, debootstrap, Debian's mirror, 5 GB in TMPDIR (/var/tmp) and some five minutes; exit code 77 if one of
# these is missing. Everything is removed at the end, except with FRESH_SYSTEM_FOLDER=FOLDER: then the base system and
# the compiler cache are kept there for the next call.
set -euo pipefail
cd "$(dirname "$0")/.."

if [ "${1:-}" = --bare ]; then
  FRESH_SYSTEM_BARE=$(realpath "$2")
  export FRESH_SYSTEM_BARE
  shift 2
fi
suite=${1:-bookworm}
shift || true
cannot() { echo "fresh_system: not run: $*" >&2; exit 77; }
[ "$(id -u)" = 0 ] || cannot "needs root"
command -v debootstrap >/dev/null || cannot "needs debootstrap: scripts/install_packages.sh slow"
# Mounts and processes are in separate namespaces and end with them, so only a folder has to be removed here.
if [ -z "${FRESH_SYSTEM_WORK:-}" ]; then
  unshare --mount --pid --fork true 2>/dev/null || cannot "may not mount"
  work=$(mktemp -d "${TMPDIR:-/var/tmp}/fresh_system.XXXXXX")
  trap '{ kill -KILL "$inside" && wait "$inside"; } 2>/dev/null || true; rm -rf --one-file-system "$work"' EXIT
  trap 'exit 130' INT TERM
  FRESH_SYSTEM_WORK=$work unshare --mount --propagation private --pid --fork --kill-child "scripts/$(basename "$0")" "$suite" "$@" &
  inside=$!
  wait "$inside"
  exit
fi

mirror=$(cat /etc/apt/sources.list /etc/apt/sources.list.d/* 2>/dev/null | grep -v '^#' | grep -oE 'https?://[^ ]+/debian/?( |$)' | head -n 1 | tr -d ' ' || true)
mirror=${mirror:-http://deb.debian.org/debian}
work=$FRESH_SYSTEM_WORK
kept=${FRESH_SYSTEM_FOLDER:-$work}
base=$kept/$suite.base cache=$kept/$suite.ccache root=$work/$suite
mkdir -p "$kept" "$cache"

if [ ! -d "$base" ]; then
  echo "== the base system of $suite from $mirror"
  rm -rf --one-file-system "$base.part"
  if ! debootstrap --variant=minbase "$suite" "$base.part" "$mirror" >"$work/debootstrap.log" 2>&1; then
    tail -n 5 "$work/debootstrap.log" >&2
    ! grep -q 'Failed getting release file' "$work/debootstrap.log" || cannot "can't reach the mirror"
    exit 1
  fi
  # Start no services of packages; let apt reach the mirror as it does outside.
  printf '#!/bin/sh\nexit 101\n' >"$base.part/usr/sbin/policy-rc.d" && chmod +x "$base.part/usr/sbin/policy-rc.d"
  apt-config dump | grep -E '^Acquire::(https?|ftp|Check-|Retries)' >"$base.part/etc/apt/apt.conf.d/99outside" || true
  mv "$base.part" "$base"
fi
cp -a "$base" "$root"
cp /etc/resolv.conf /etc/hosts "$root/etc/"
mkdir "$root/ccache" "$root/src"
mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"
mount --bind "$cache" "$root/ccache"
# pip trusts the same certificates as outside, since there may be a proxy.
certificates=${PIP_CERT:-${SSL_CERT_FILE:-}}
[ ! -f "$certificates" ] || cp "$certificates" "$root/etc/outside_certificates.pem"
inside() {
  local trusted=/etc/outside_certificates.pem
  chroot "$root" env -C /src HOME=/root LC_ALL=C.UTF-8 TMPDIR=/tmp CCACHE_DIR=/ccache \
    ${certificates:+PIP_CERT=$trusted NODE_EXTRA_CA_CERTS=$trusted SSL_CERT_FILE=$trusted REQUESTS_CA_BUNDLE=$trusted CURL_CA_BUNDLE=$trusted} "$@"
}
if [ -n "${FRESH_SYSTEM_BARE:-}" ]; then
  cp -r "$FRESH_SYSTEM_BARE/." "$root/src/"
  inside "$@"
  exit
fi
tar c --exclude=./build --exclude=./results/*.db* . | tar x --no-same-owner -C "$root/src"

configured() {
  echo "== configured: $*"
  inside cmake "$@" -DAVOIDBENCH_WERROR=ON >"$work/configure.log" 2>&1 || { tail -n 30 "$work/configure.log" >&2; exit 1; }
}
echo "== the packages of quickstart.sh"
inside scripts/install_packages.sh build
configured --preset release -DAVOIDBENCH_TESTS=OFF -DAVOIDBENCH_BENCH=OFF
echo "== the packages of test.sh"
inside scripts/install_packages.sh test
configured --preset release -DAVOIDBENCH_TESTS=ON -DAVOIDBENCH_BENCH=ON
configured --preset clang
for program in clang-format clang-tidy clang++ llvm-symbolizer ctest git python3 valgrind; do
  inside which "$program" >/dev/null || { echo "no list names $program" >&2; exit 1; }
done
inside scripts/install_packages.sh test 2>&1 | grep . && { echo "install_packages.sh: a second call should have nothing to do" >&2; exit 1; }
echo "nothing is missing on $suite"
[ $# -eq 0 ] || inside "$@"
