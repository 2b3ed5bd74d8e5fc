#!/usr/bin/env bash
# Proves that a run of several steps or adaptive cycles, killed at random moments and continued each time on another number
# of ranks, ends with the results of a run that nothing disturbed, whatever the source of the meshes; and
# that checkpoints of other scenes, damaged ones and wrong options are refused.
set -u
mortise=$1 prm=$2 kills=${3:-6}
mpi=$(dirname "${BASH_SOURCE[0]}")/../mpi.sh
work=$(mktemp -d)
export TMPDIR=$work/sessions # of mpirun
mkdir "$TMPDIR"
trap 'rm -rf "$work"' EXIT
passed=0 failed=0 absolute=1e-9
RANDOM=27

verdict() { # WHAT CONDITION...: the conditions are commands
  local what=$1 condition
  shift
  for condition in "$@"; do
    if ! eval "$condition" >"$work/why" 2>&1; then
      echo "FAILED  $what: not $condition: $(tail -n 5 "$work/why" "$work/log")"
      failed=$((failed + 1))
      return
    fi
  done
  passed=$((passed + 1))
}

# on RANKS OPTION...: sets code; what it prints goes to $work/log
on() {
  local ranks=$1
  shift
  set -- "$mortise" "$@"
  if [ "$ranks" -gt 1 ]; then
    set -- "$mpi" "$ranks" "$@"
  fi
  timeout 300 "$@" >"$work/log" 2>&1
  code=$?
}

# killed SECONDS OPTION...: the same on one rank, ended by SIGKILL after that time
killed() {
  local seconds=$1
  shift
  "$mortise" "$@" >"$work/log" 2>&1 &
  local process=$!
  sleep "$seconds"
  kill -KILL $process 2>/dev/null
  wait $process 2>/dev/null
  code=$?
}

# What a summary says of the solution: no times, no iterations, nothing that is rounding.
solution() {
  sed -n '/"steps"/,/"timings_s"/p' "$1/summary.json" |
    grep -v -e iterations -e residual -e preconditioner -e method -e timings | tr -d ,
}

same() { # DIRECTORY DIRECTORY TOLERANCE
  solution "$1" >"$work/first"
  solution "$2" >"$work/second"
  numdiff -q -r "$3" -a "$absolute" "$work/first" "$work/second"
}

times() { # in a collection
  grep -o 'timestep="[^"]*"' "$1"
}

# disturbed NAME TOLERANCE SOME ALL OPTION...: options SOME for a run that ends early, ALL for one to the end
disturbed() {
  local name=$1 tolerance=$2 some=$3 all=$4 whole=$work/$1-whole parts=$work/$1-parts
  local options=("${@:5}" --set "Output/Checkpoint every=1" --set "Output/Fields=displacement" --set "Output/Points=")
  local start=$(date +%s%N) length kill=0
  on 1 --output "$whole" "${options[@]}"
  length=$((($(date +%s%N) - start) / 1000000)) # milliseconds
  verdict "$name: six steps or cycles" '[ $code -eq 0 ]' "[ \$(grep -c -e '\"time\"' -e '\"adaptivity\"' $whole/summary.json) -ge 6 ]"

  while [ "$kill" -lt "$kills" ]; do
    kill=$((kill + 1))
    local after=$((RANDOM * length / 32768))
    if [ -f "$parts/checkpoint.bin" ]; then
      killed "$(printf '%d.%03d' $((after / 1000)) $((after % 1000)))" --restart "$parts"
    else
      killed "$(printf '%d.%03d' $((after / 1000)) $((after % 1000)))" --output "$parts" "${options[@]}"
    fi
  done
  [ -f "$parts/checkpoint.bin" ] || on 1 --output "$parts" "${options[@]}" --set "$some"
  on 3 --restart "$parts" --set "$all"
  verdict "$name: killed $kills times, then to the end on 3 ranks" '[ $code -eq 0 ]' "same $whole $parts $tolerance" \
    "[ \"\$(cat $parts/*.pvd | times -)\" = \"\$(cat $whole/*.pvd | times -)\" ]"
}

steps=("Steps/End time=0.3" "Steps/End time=1")
disturbed generator 1e-6 "${steps[@]}" --set "Steps/Step=0.1" "$prm/thick_sphere.prm" --set "Body inner/Boundary inside/Pressure=sin(t)*(1+t*x)" \
  --set "Exact solution/Displacement="
disturbed gmsh 1e-6 "${steps[@]}" --set "Steps/Step=0.1" "$prm/thick_sphere_gmsh.prm" --set "Body inner/Boundary inner inside/Pressure=t^2"\
  --set "Exact solution/Displacement="

# what presses, and by how much bolts are tightened; what rounding leaves of forces of 1e4
absolute=1e-6
disturbed contact 1e-5 "Steps/End time=0.3" "Steps/End time=0.9" --set "Steps/Step=0.15" --set "Steps/End time=0.9" "$prm/flange_lift.prm"
absolute=1e-9

# solvers go no further than a thousandth of the target
targets=("Adaptivity/Target error=3e-2" "Adaptivity/Target error=1e-2")
corner=("$prm/fichera_adaptive.prm" --set "Adaptivity/Target error=1e-2")
disturbed cycles 1e-4 "${targets[@]}" "${corner[@]}"
disturbed meshes 1e-4 "Adaptivity/Target error=6e-2" "Adaptivity/Target error=3e-2" "$prm/fichera_adaptive.prm" \
  --set "Adaptivity/Target error=3e-2" --set "Body upper/Mesh/File=$prm/../meshes/l_shape_tet.geo" --set "Body upper/Mesh/Mesh size=0.7"

disturbed moving 1e-4 "Steps/Step=1, 1.5" "Steps/Step=1, 1.5, 2" "$prm/../tests/field/bump_moves_over_a_tie.prm" --set "Steps/Step=1, 1.5, 2"

# along a path beyond its largest load, whose times the program finds
balloon=$prm/../tests/field/balloon_past_its_maximum.prm
on 1 --output "$work/path-whole" "$balloon" --set "Steps/Number of steps=10"
on 2 --output "$work/path-parts" "$balloon" --set "Steps/Number of steps=8" --set "Output/Checkpoint every=8"
on 3 --restart "$work/path-parts" --set "Steps/Number of steps=10"
verdict "path: to the largest load on 2 ranks, then beyond it on 3" '[ $code -eq 0 ]' \
  "grep -q 'continued from t = 0.8164' $work/log" "same $work/path-whole $work/path-parts 1e-6"

scene=$work/generator-parts
refused() { # WHAT PATTERN OPTION...
  local what=$1 pattern=$2
  shift 2
  on 1 "$@"
  verdict "$what" '[ $code -eq 2 ]' "[ \$(grep -c '^error: ' $work/log) -eq 1 ]" "grep -q -e '$pattern' $work/log"
}
refused "no checkpoint" "Cannot read the checkpoint" --restart "$work"
refused "a file beside --restart" "allowed is one of them" --restart "$scene" "$prm/patch.prm"
refused "--restart without a directory" "needs the name of a directory" --restart=
refused "another degree" "body \"inner\" has degree 2, now degree 3" --restart "$scene" \
  --set "Steps/End time=2" --set "Body inner/Degree=3"
refused "another mesh" "cells, now" --restart "$scene" --set "Steps/End time=2" \
  --set "Body inner/Mesh/Subdivisions=3, 3"
cp -r "$scene" "$work/damaged"
printf 'x' | dd of="$work/damaged/checkpoint.bin" bs=1 seek=3000 conv=notrunc 2>/dev/null
refused "a damaged checkpoint" "damaged" --restart "$work/damaged" --set "Steps/End time=2"
on 1 --restart "$scene"
verdict "nothing left to do" '[ $code -eq 0 ]' "grep -q 'was reached before' $work/log"
on 1 --restart "$work/cycles-parts"
verdict "no cycle left to do" '[ $code -eq 0 ]' "grep -q 'was reached before' $work/log"
on 1 --restart "$work/cycles-parts" --set "Adaptivity/Target error=5e-3"
verdict "a smaller target goes on" '[ $code -eq 0 ]' "grep -q 'continued after cycle' $work/log"
refused "a target after a run without" "with the checkpoint of a run without one" --restart "$scene" \
  --set "Steps/Step=" --set "Steps/End time=" --set "Adaptivity/Target error=1e-2"

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
