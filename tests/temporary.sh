#!/usr/bin/env bash
# temporary.sh COMMAND [ARGUMENT]...: runs a test in a directory of its own, which goes however the test ends.
directory=$(mktemp -d) || exit 1
trap 'rm -rf "$directory"' EXIT
cd "$directory" || exit 1
export TMPDIR=$directory
"$@"
