#!/usr/bin/env bash
# Proves that results appear whole or not at all, and that a full disk, too little memory, a killed
# rank and an interruption end the run soon, with one message and their exit codes, on 1, 2 and 3
# ranks.
set -u
mortise=$1 prm=$2 top=$3
mpi=$top/tests/mpi.sh
work=$(mktemp -d)
out=$work/out
export TMPDIR=$work/sessions # of mpirun: in a namespace of users it is somebody else
mkdir "$TMPDIR"
trap 'rm -rf "$work"' EXIT
passed=0 failed=0
export FAULTS_TEST=$work

# on RANKS COMMAND...: sets code, message and milliseconds; what it prints goes to $work/log
# Who hangs is ended after 120 s, with exit code 124.
on() {
  local ranks=$1 start=$(date +%s%N)
  shift
  if [ "$ranks" -gt 1 ]; then
    set -- "$mpi" "$ranks" "$@"
  fi
  message=$(timeout 120 "$@" 2>&1 >"$work/log")
  code=$?
  milliseconds=$((($(date +%s%N) - start) / 1000000))
}

# verdict WHAT CONDITION...: the conditions are commands
verdict() {
  local what=$1 condition
  shift
  for condition in "$@"; do
    if ! eval "$condition" >"$work/why" 2>&1; then
      echo "FAILED  $what: not $condition; exit code $code after $milliseconds ms: $message; files: $(ls "$out" 2>&1 | tr '\n' ' ')"
      failed=$((failed + 1))
      return
    fi
  done
  passed=$((passed + 1))
}

# says N PATTERN: N lines of the message hold it
says() {
  [ "$(grep -c -e "$2" <<<"$message")" -eq "$1" ]
}

all_whole() {
  local file
  for file in "$out"/*; do
    case $file in
      *.vtu) [ -d "$file" ] || [ "$(tail -n 1 "$file")" = "</VTKFile>" ] || return 1 ;;
      */summary.json) [ "$(head -n 1 "$file")" = "{" ] && [ "$(tail -n 1 "$file")" = "}" ] &&
        [ "$(grep -c '^  "title"' "$file")" -eq 1 ] || return 1 ;;
      *) return 1 ;; # something unfinished
    esac
  done
}

complete() { [ -f "$out/summary.json" ] && all_whole; }
none() { [ -z "$(ls -A "$out" 2>/dev/null)" ]; }
fresh() { rm -rf "$out"; }

scene=$prm/patch.prm
run=("$mortise" --output "$out" "$scene")

for ranks in 1 3; do
  fresh
  on $ranks bash -c 'ulimit -f 8; exec "$@"' - "${run[@]}"
  verdict "files longer than a limit, $ranks ranks" '[ $code -eq 2 ]' 'says 1 "lower.vtu.*File too large.*ulimit -f"' \
    'says 1 "complete are: .*summary.json"' complete

  fresh
  on $ranks bash -c 'ulimit -f 1; exec "$@"' - "${run[@]}"
  verdict "all files longer than a limit, $ranks ranks" '[ $code -eq 2 ]' \
    'says 1 "lower.vtu.*upper.vtu.*glue.vtu.*summary.json.*File too large"' 'says 1 "nothing was written"' none

  fresh
  mkdir -p "$out/upper.vtu"
  on $ranks "${run[@]}"
  verdict "a name that a directory has, $ranks ranks" '[ $code -eq 2 ]' 'says 1 "upper.vtu.*a directory has this name"' \
    complete '[ -f "$out/lower.vtu" ]' '[ -d "$out/upper.vtu" ]'

  # where the user may mount what only it sees
  if unshare -rm mount -t tmpfs none "$work" 2>/dev/null; then
    fresh
    mkdir "$out" "$work/disk"
    launcher=()
    [ $ranks -eq 1 ] || launcher=("$mpi" $ranks)
    on 1 unshare -rm bash -c 'mount -t tmpfs -o size=32k none "$1"
      "${@:3}"
      code=$?
      cp "$1"/* "$2"
      exit $code' - "$work/disk" "$out" "${launcher[@]}" "$mortise" --output "$work/disk" "$scene"
    rmdir "$work/disk"
    verdict "a full disk, $ranks ranks" '[ $code -eq 2 ]' 'says 1 "upper.vtu.*No space left.*make room"' complete \
      '[ ! -e "$out/upper.vtu" ]'
  fi
done
# many steps: the first that cannot be written is the last, and goes on from its checkpoint
steps=("$mortise" --output "$out" "$scene" --set 'Steps/Step=1' --set 'Steps/End time=50' --set 'Output/Checkpoint every=20'
  --set 'Output/Fields=displacement')
for ranks in 1 2; do
  fresh
  mkdir -p "$out/upper_0003.vtu"
  on $ranks "${steps[@]}"
  verdict "a step that cannot be written, $ranks ranks" '[ $code -eq 2 ]' 'says 1 "cannot write"' \
    'says 1 "upper_0003.vtu.*a directory has this name"' 'says 1 "stopped at t = 3; complete are"' \
    '[ ${#message} -lt 1000 ]' '[ $(grep -c "^step" "$work/log") -eq 3 ]' '[ ! -e "$out/lower_0004.vtu" ]' \
    '[ $(grep -c "\"time\"" "$out/summary.json") -eq 3 ]' 'grep -q "\"status\": \"stopped\"" "$out/summary.json"'
  rmdir "$out/upper_0003.vtu"
  on $ranks "$mortise" --restart "$out" --set 'Steps/End time=5'
  verdict "on from there, $ranks ranks" '[ $code -eq 0 ]' '[ $(grep -c "^step" "$work/log") -eq 2 ]' \
    '[ $(grep -c "\"time\"" "$out/summary.json") -eq 5 ]'
done
fresh
on 1 bash -c '"$@" >/dev/full' - "${run[@]}"
verdict "a full disk for what is printed" '[ $code -eq 2 ]' 'says 1 "standard output"' complete

fresh
pids=()
for round in 1 2 3; do
  for title in one another; do
    "$mortise" --output "$out" --set "Title=$title" "$scene" >/dev/null 2>&1 &
    pids+=($!)
  done
done
code=0
for pid in "${pids[@]}"; do
  wait "$pid" || code=$?
done
verdict "runs into one directory at once" '[ $code -eq 0 ]' complete '[ $(ls "$out" | wc -l) -eq 4 ]'

# Where the limit lies depends on the libraries: too little for the loader (127), for the program (4),
# enough (0).
for ranks in 1 3; do
  seen=""
  for limit in 500000 600000 700000; do
    fresh
    on $ranks bash -c "ulimit -v $limit; exec \"\$@\"" - "${run[@]}"
    seen+=" $code"
    case $code in
      0 | 127) ;;
      *) verdict "$limit KiB of memory, $ranks ranks" '[ $code -eq 4 ]' 'says 1 "error: not enough memory"' \
        '[ $(wc -l <<<"$message") -eq 1 ]' ;;
    esac
  done
  verdict "too little memory is tried, $ranks ranks" "grep -q 4 <<<'$seen'"
done

# a scene that takes some seconds
long=("${run[@]}" --set 'Body lower/Mesh/Subdivisions=20,20,20' --set 'Body upper/Mesh/Subdivisions=20,20,20'
  --set 'Body lower/Degree=4' --set 'Body upper/Degree=4')
on 1 bash -c 'ulimit -v 1000000; exec "$@"' - "${long[@]}"
verdict "a scene too large" '[ $code -eq 4 ]' 'says 1 "not enough memory for this scene.*ulimit -v"'

# gmsh meshes with threads of its own, in which nobody catches what memory that runs out throws
for ranks in 1 2; do
  fresh
  on $ranks bash -c 'ulimit -v 1000000; exec "$@"' - "$mortise" --output "$out" "$prm/hertz_solid.prm" --set 'Body ball/Mesh/Mesh size=1e-7'
  verdict "a mesh too large for gmsh, $ranks ranks" '[ $code -eq 4 ]' 'says 1 "not enough memory for this scene"' '[ $(wc -l <<<"$message") -eq 1 ]' none
done

# mpirun gives ranks a second to end
unset OMPI_MCA_odls_base_sigkill_timeout

# the process of rank $1
rank() {
  local directory
  for directory in /proc/[0-9]*; do
    if [ "$(readlink "$directory/exe")" = "$(readlink -f "$mortise")" ] &&
      tr '\0' '\n' <"$directory/environ" | grep -q -x -e "FAULTS_TEST=$work" &&
      { [ "$1" = alone ] || tr '\0' '\n' <"$directory/environ" | grep -q -x -e "OMPI_COMM_WORLD_RANK=$1"; }; then
      echo "${directory#/proc/}"
    fi
  done 2>/dev/null
}

# stop SIGNAL WHOM COMMAND...: start it, and signal a rank or, when it is "launcher", what was started
stop() {
  local signal=$1 whom=$2 pid
  shift 2
  fresh
  : >"$work/log"
  env --default-signal=INT "$@" >"$work/log" 2>"$work/message" &
  pid=$!
  for _ in $(seq 600); do
    grep -q "${until:-  mesh}" "$work/log" && break
    sleep 0.05
  done
  local start=$(date +%s%N)
  case $whom in
    launcher) ;;
    mpirun) pid=$(ps -o ppid= -p "$(rank 0)") ;;
    *) pid=$(rank "$whom") ;;
  esac
  kill -s "$signal" "$pid"
  wait $!
  code=$?
  message=$(cat "$work/message")
  milliseconds=$((($(date +%s%N) - start) / 1000000))
}

for signal in INT TERM; do
  expected=$([ $signal = INT ] && echo 130 || echo 143)
  stop $signal launcher "${long[@]}"
  verdict "SIG$signal" "[ \$code -eq $expected ]" 'says 1 "interrupted by SIG'$signal': nothing was written"' \
    '[ $(wc -l <<<"$message") -eq 1 ]' none '[ $milliseconds -lt 20000 ]'
done
stop TERM 1 "$mpi" 2 "${long[@]}"
verdict "SIGTERM for rank 1 of 2" '[ $code -eq 143 ]' 'says 1 "interrupted by SIGTERM: nothing was written"' none \
  '[ $(wc -l <<<"$message") -eq 1 ]' '[ $milliseconds -lt 20000 ]'

# Between two steps a run stops in good order, and goes on from there.
steps=("$mortise" --output "$out" "$scene" --set 'Steps/Step=1' --set 'Steps/End time=3000' --set 'Steps/Output every=3000'
  --set 'Output/Fields=displacement')
stopped() {
  local n
  n=$(grep -c '^step' "$work/log")
  verdict "$1 between steps" "[ \$code -eq $2 ]" \
    "says 1 'interrupted by SIG$3 after step $n, t = $n: its results and a checkpoint are written; to go on: mortise --restart'" \
    '[ $(wc -l <<<"$message") -eq 1 ]' "[ -s \$out/checkpoint.bin ]" "[ -s \$out/lower_$(printf %04d "$n").vtu ]" \
    "[ \$(grep -c '\"time\"' \$out/summary.json) -eq $n ]" 'grep -q "\"status\": \"stopped\"" "$out/summary.json"' \
    '[ $milliseconds -lt 20000 ]'
  on 1 "$mortise" --restart "$out" --set "Steps/End time=$((n + 2))"
  verdict "on after $1" '[ $code -eq 0 ]' '[ $(grep -c "^step" "$work/log") -eq 2 ]' "[ \$(grep -c '\"time\"' \$out/summary.json) -eq $((n + 2)) ]"
}
until='^step 3,'
stop INT launcher "${steps[@]}"
stopped SIGINT 130 INT
stop TERM launcher "${steps[@]}"
stopped SIGTERM 143 TERM
stop TERM launcher "$mpi" 2 "${steps[@]}"
stopped "SIGTERM for two ranks" 143 TERM
stop TERM 1 "$mpi" 2 "${steps[@]}"
stopped "SIGTERM for rank 1 of 2" 143 TERM
stop USR1 mpirun "$mpi" 2 "${steps[@]}"
stopped "SIGUSR1 for mpirun" 138 USR1
until=

export MORTISE_BUILD=$(dirname "$mortise")
if [ -f "$MORTISE_BUILD/build.ninja" ]; then
  through_run=("$top/run" -n 3 "${long[@]:1}")
  stop INT launcher "${through_run[@]}"
  verdict "SIGINT for run" '[ $code -eq 130 ]' 'says 1 "interrupted by .*: nothing was written"' none \
    '[ $(wc -l <<<"$message") -eq 1 ]' '[ $milliseconds -lt 20000 ]' '[ -z "$(rank 0)$(rank 1)$(rank 2)" ]'
  for whom in 0 2; do
    stop KILL $whom "${through_run[@]}"
    verdict "SIGKILL for rank $whom under run" '[ $code -eq 137 ]' 'says 1 "run: a rank was ended by signal 9 (SIGKILL)"' none \
      '[ $milliseconds -lt 20000 ]' '[ -z "$(rank 0)$(rank 1)$(rank 2)" ]'
  done
fi

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
