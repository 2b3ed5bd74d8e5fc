#!/usr/bin/env bash
# debian.sh DIRECTORY SUITE...: proves the two commands of the README on fresh Debian systems, for instance
#   tests/debian.sh /var/tmp/debian bookworm trixie
# For each suite a minimal system of its own is made in DIRECTORY/SUITE by debootstrap from the mirror
# of this machine's apt, the sources are copied into it, and in there scenes are run and all tests. What the
# scenes gave is compared with the first suite. Needs root, 6 GB and half an hour per suite; a second run
# goes on with what is there. Not a part of `./run test`.
#   tests/debian.sh --package DIRECTORY SUITE...
# builds the package of Debian in each system in place of that, and installs and tries it in another fresh one. A
# package that is there already in DIRECTORY/SUITE/packages is tried as it is.
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
package=no
[ "${1:-}" != --package ] || { package=yes; shift; }
[ $# -ge 2 ] || { sed -n '2,10s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 2; }
for tool in debootstrap numdiff unshare; do
  command -v $tool >/dev/null || { echo "debian.sh: $tool is missing" >&2; exit 2; }
done
mkdir -p "$1"
directory=$(cd "$1" && pwd)
shift
# Relative difference that the numbers of a scene may have from suite to suite. gmsh meshes the flange, and its
# versions do not give the same tetrahedra.
scenes=(thick_sphere flange)
declare -A tolerance=([thick_sphere]=1e-6 [flange]=1e-2)

mirror() {
  apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' 'Label: Debian' 'Component: main' |
    sort -u | head -n 1
}

# make SUITE [NAME]: a minimal system, in a directory of this name
make() {
  local root=$directory/${2:-$1}
  [ -e "$root/etc/apt/sources.list" ] && [ ! -e "$root/debootstrap" ] && return
  local uri=$(mirror)
  [ -n "$uri" ] || { apt-get update -qq && uri=$(mirror); }
  [ -n "$uri" ] || { echo "debian.sh: apt knows no mirror of Debian here" >&2; exit 1; }
  debootstrap --variant=minbase --include=ca-certificates "$1" "$root" "$uri"
  apt-config dump Acquire | grep -i '::proxy' >"$root/etc/apt/apt.conf.d/proxy" || true
}

# inside SUITE COMMAND: run it in the system, with processes and mounts of its own, which end with it
inside() {
  unshare --mount --pid --fork --kill-child bash -euc '
    mount --rbind "$1" "$1"
    cd "$1"
    mount -t proc proc proc
    mount --rbind /sys sys
    mount --rbind /dev dev
    mount -t tmpfs tmpfs dev/shm
    mount -t tmpfs tmpfs tmp
    pivot_root . mnt # and not chroot, where no namespaces of users can be made, in which a test fills a disk
    cd /mortise
    umount -l /mnt
    exec env -i HOME=/root PATH=/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 bash -euc "$2"
  ' - "$directory/$1" "$2"
}

# compare SUITE SCENE: errors and quantities with those of the first suite
compare() {
  local results=$directory/$1/results/$2
  sed -n '/"errors"\|"quantities"/,/^      }/p' "$results/summary.json" >"$results/numbers"
  [ -s "$results/numbers" ] || return 1
  [ "$1" = "$first" ] || numdiff -s ' \t\n,' -a 1e-9 -r "${tolerance[$2]}" "$directory/$first/results/$2/numbers" "$results/numbers"
}

# try_package SUITE: builds the package unless it is there; in a fresh system it has to install and run a scene on its own
try_package() {
  local root=$directory/$1
  if ! ls "$root/packages/"mortise_*.deb >/dev/null 2>&1; then
    make "$1"
    mkdir -p "$root/mortise" "$root/packages"
    (cd "$top" && git ls-files -z --cached --others --exclude-standard | tar -c --null -T -) | tar -x -C "$root/mortise"
    inside "$1" "apt-get update -qq
      DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends dpkg-dev file \$(sed -n '/^packages=(/,/)/p' run | tr -d '()' | sed 's/packages=//' | xargs)
      cmake -S . -B build-portable -G Ninja -DCMAKE_BUILD_TYPE=Release
      ninja -C build-portable
      cd build-portable
      cpack
      cp *.deb /packages"
  fi
  rm -rf "$directory/$1-fresh"
  make "$1" "$1-fresh"
  mkdir -p "$directory/$1-fresh/mortise"
  cp "$root/packages/"mortise_*.deb "$directory/$1-fresh"
  inside "$1-fresh" "apt-get update -qq
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends /mortise_*.deb libopenblas0-pthread openmpi-bin
    mortise --version
    mortise --example fichera
    mortise --validate fichera.prm
    mortise --example thick_sphere
    mortise thick_sphere.prm
    OMPI_MCA_mpi_yield_when_idle=1 mpirun --allow-run-as-root --oversubscribe -n 2 mortise thick_sphere.prm"
}

first=$1 failed=0
for suite in "$@"; do
  if [ $package = yes ]; then
    try_package "$suite" || failed=1
    continue
  fi
  root=$directory/$suite
  make "$suite"
  mkdir -p "$root/mortise"
  (cd "$top" && git ls-files -z --cached --others --exclude-standard | tar -c --null -T -) | tar -x -C "$root/mortise"
  for scene in "${scenes[@]}"; do
    inside "$suite" "./run prm/$scene.prm --output /results/$scene" || failed=1
    compare "$suite" "$scene" || failed=1
  done
  inside "$suite" "./run -n 2 prm/${scenes[0]}.prm --output /results/two_ranks" || failed=1
  inside "$suite" "./run test" || failed=1
done
exit $failed
