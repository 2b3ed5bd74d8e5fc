#!/usr/bin/env bash
# compare.sh PROGRAM EXPECTED RANKS: run a test program and compare what it prints.
set -u
program=$1 expected=$2 ranks=$3
got=$(mktemp)
trap 'rm -f "$got"' EXIT
run=("$program")
[ "$ranks" -eq 1 ] || run=("$(dirname "${BASH_SOURCE[0]}")/mpi.sh" "$ranks" "$program")
"${run[@]}" >"$got"
code=$?
grep -a FAILED "$got" && exit 1
[ $code -eq 0 ] || { cat "$got"; echo "exit code $code"; exit 1; }
if command -v numdiff >/dev/null; then
  numdiff -a 1e-6 -r 1e-8 "$expected" "$got"
else
  diff "$expected" "$got"
fi
