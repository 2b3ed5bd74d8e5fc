#!/usr/bin/env bash
# launcher.sh LAUNCHER: it starts the best program for this processor, hands arguments, names and exit codes on,
# and says what is wrong where there is none.
set -u
wrong=0
mkdir -p bin libexec/mortise
cp "$1" bin/mortise
for level in baseline x86-64-v3 x86-64-v4; do
  printf '#!/bin/sh\necho %s "$@"\nexit 3\n' $level >libexec/mortise/mortise-$level
  chmod +x libexec/mortise/mortise-$level
done

# expect WHAT CODE TEXT: of the last run
expect() {
  [ "$code" = "$2" ] && [[ $text == *"$3"* ]] || { echo "FAILED  $1: exit code $code, expected $2: $text, expected $3"; wrong=1; }
}
run() {
  text=$("$@" 2>&1)
  code=$?
}

flags=" $(grep -m 1 '^flags' /proc/cpuinfo) "
best=baseline
[[ $flags == *" avx2 "* && $flags == *" fma "* && $flags == *" bmi2 "* ]] && best=x86-64-v3
[[ $flags == *" avx512f "* && $flags == *" avx512vl "* && $flags == *" avx512dq "* && $flags == *" avx512bw "* ]] && best=x86-64-v4
run bin/mortise --set 'a b' c
expect "the best program" 3 "$best --set a b c"
for level in baseline x86-64-v3; do
  run env MORTISE_PROCESSOR=$level bin/mortise
  expect "the program that was asked for" 3 $level
done
ln -s "$PWD/bin/mortise" link
run ./link
expect "through a link" 3 "$best"
run env MORTISE_PROCESSOR=x86-64-v9 bin/mortise
expect "a processor that is unknown" 2 'allowed are baseline'
rm libexec/mortise/*
run bin/mortise
expect "no program" 2 "mortise-$best: No such file"
exit $wrong
