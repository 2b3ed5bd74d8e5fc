#!/usr/bin/env bash
# asks.sh RUN: ./run installs packages only as root, or after a question, or with MORTISE_INSTALL=yes; programs that
# stand in for apt, sudo and the build say what was called.
set -u
run=$1 wrong=0
mkdir bin
for tool in bash sh env sed grep cat mkdir dirname basename nproc cut script setsid; do
  ln -s "$(command -v $tool)" bin/$tool
done
# stand_in NAME LINE: a program of one line
stand_in() {
  printf '#!/bin/sh\n%s\n' "$2" >bin/$1
  chmod +x bin/$1
}
stand_in id 'echo ${USER_ID:-1000}'
stand_in dpkg-query 'exit 1'
stand_in apt-get 'echo called apt-get "$@" >>called'
stand_in sudo 'echo called sudo >>called; exec "$@"'
stand_in cmake 'echo >build/build.ninja'
stand_in ninja 'exit 0'

# expect WHAT CODE CALLED TEXT COMMAND...: the exit code, whether apt-get was called, and a part of what is printed
expect() {
  local what=$1 code=$2 called=$3 part=$4 text got=no
  shift 4
  rm -rf called build
  text=$("$@" 2>&1)
  local ended=$?
  [ ! -e called ] || got=yes
  [ $ended = "$code" ] && [ $got = "$called" ] && [[ $text == *"$part"* ]] ||
    { echo "FAILED  $what: exit code $ended, expected $code; apt called: $got, expected $called: $text"; wrong=1; }
}
# clean VARIABLE... COMMAND: without terminal
clean() {
  env -i PATH="$PWD/bin" MORTISE_BUILD="$PWD/build" "$@" </dev/null
}
answer() {
  printf '%s\n' "$1" | env -i PATH="$PWD/bin" MORTISE_BUILD="$PWD/build" script -qec "$run build" /dev/null
}
expect "a user without a terminal" 1 no 'MORTISE_INSTALL=yes' clean "$run" build
expect "a user who says so" 0 yes 'installing' clean MORTISE_INSTALL=yes "$run" build
grep -q 'called sudo' called || { echo "FAILED  a user who says so: without sudo"; wrong=1; }
expect "root" 0 yes 'installing' clean USER_ID=0 "$run" build
grep -q 'called sudo' called && { echo "FAILED  root: with sudo"; wrong=1; }
expect "a user who says yes" 0 yes 'installing' answer y
expect "a user who says nothing" 1 no 'nothing was installed' answer ''
rm bin/sudo
expect "a user without sudo" 1 no 'ask an administrator' clean MORTISE_INSTALL=yes "$run" build
rm bin/apt-get
expect "no apt" 0 no 'deal.II 9.4' clean "$run" build
exit $wrong
