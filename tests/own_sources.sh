#!/usr/bin/env bash
# own_sources.sh BUILD_DIRECTORY: proves that the list of sources is sorted and complete, and that each source
# includes what it names, which a build by rooms hides. Only read, not compiled: the compiler stops at an
# assertion after the last line, before templates and code, so that all take as long as two rooms.
set -u
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$(cd "$1" && pwd) || exit 1
cd "$top" || exit 1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

find source -name '*.cc' | LC_ALL=C sort >"$work/there"
sed -n 's#^  \(source/.*\.cc\)$#\1#p' CMakeLists.txt >"$work/listed"
grep -v -x -e source/main.cc -e source/problem/report_program.cc -e source/problem/start.cc -e source/install/launcher.cc "$work/there" | diff - "$work/listed" || { echo "FAILED  CMakeLists.txt has not all sources in order (<: is there, >: is listed)"; exit 1; }

# the command of one that is compiled alone: the precompiled header takes no other flags
compiler=$(ninja -C "$build" -t commands mortise | grep -m 1 ' -c .*/mumps_factorisation\.cc$' | sed 's#^.*ccache ##; s# -MD .*##')
[ -n "$compiler" ] || { echo "FAILED  no command to compile with in $build"; exit 1; }

# check SOURCE: prints what is wrong
check() {
  { echo "# 1 \"$1\""; cat "$1"; echo 'static_assert(false, "end of source");'; } |
    eval "$compiler -iquote $(dirname "$1") -fsyntax-only -Wfatal-errors -x c++ -" 2>&1 | grep -m 1 -A 2 'error: ' | grep -v '^compilation terminated' >"$2"
  grep -q 'end of source' "$2" || { echo "FAILED  $1 does not compile on its own"; cat "$2"; }
}
export -f check
export compiler
wrong=$(xargs -P "$(env -u OMP_NUM_THREADS nproc)" -I SOURCE bash -c 'check SOURCE "$(mktemp -p '"$work"')"' < <(grep -v -x source/install/launcher.cc "$work/there")) # which is compiled with the names of processors
[ -z "$wrong" ] || { echo "$wrong"; exit 1; }
echo "OK  $(wc -l <"$work/there") sources compile on their own"
