#!/usr/bin/env bash
# mpi.sh RANKS PROGRAM [ARGUMENT]...: run a program on several ranks of this machine, by Open MPI 4 or 5.
# Prints what the program prints, and whether a signal ended a rank. Ends with the code of the rank
# that ended first with one other than 0; 128 + signal when interrupted.
set -euo pipefail
ranks=${1:?"mpi.sh needs a number of ranks"}
shift

options=(-n "$ranks" --map-by :OVERSUBSCRIBE --bind-to none)
[ "$(id -u)" = 0 ] && options+=(--allow-run-as-root)
# On one machine: looking for a network takes a fifth of a second, and Open MPI 5 complains of some. Where
# memory cannot be shared the loopback does.
export OMPI_MCA_pml=${OMPI_MCA_pml:-ob1} OMPI_MCA_btl_tcp_if_include=${OMPI_MCA_btl_tcp_if_include:-lo}

# That a rank ended with an exit code is no news: it says why itself. Open MPI 4 is told so, 5 cannot be.
export OMPI_MCA_orte_execute_quiet=1
without_verdicts() {
  trap '' INT TERM HUP # it ends when mpirun does
  exec sed -u -n 's/\x00//g
  /^-\{60,\}$/ {
    $!N
    /\n\(prterun \|MPI_ABORT was invoked\)/ {
      :inside
      N
      /\n-\{60,\}$/! b inside
      d
    }
  }
  p' >&2
}
exec {messages}> >(without_verdicts)
filter=$!
exec {output}> >(trap '' INT TERM HUP && exec cat {messages}>&-)
copy=$!

# A session of its own: what the keyboard sends comes here and is handed on, at first to the ranks, since mpirun
# of Open MPI 5 would end without what they say (and leaves them behind when it hears it twice).
mpirun="" interrupted=0 code=0
hand_on() {
  local processes=""
  [ "$interrupted" != 0 ] || processes=$(cat "/proc/$mpirun/task/"*/children 2>/dev/null) || true
  interrupted=$1
  kill -TERM ${processes:-$mpirun} 2>/dev/null || true
}
trap 'hand_on 130' INT
trap 'hand_on 143' TERM
trap 'hand_on 129' HUP
# Ranks write past mpirun: that of Open MPI 5 drops the last words of a rank that ends with an exit code.
past_mpirun='exec 1>>"$0/'$output'" 2>>"$0/'$messages'" && exec "$@"'
setsid mpirun "${options[@]}" bash -c "$past_mpirun" "/proc/$$/fd" "$@" <&0 >&"$output" 2>&"$messages" {output}>&- {messages}>&- &
mpirun=$!
wait "$mpirun" || code=$?
while kill -0 "$mpirun" 2>/dev/null; do
  wait "$mpirun" || true # the first one was interrupted
done
exec {output}>&- {messages}>&-
wait "$filter" "$copy" || true
[ "$interrupted" = 0 ] || exit "$interrupted"
# the program's own codes end at 4, and ranks that are interrupted say so themselves
why="a crash: please report it"
[ "$code" = 137 ] && why="not by the program itself; a machine that ran out of memory does so"
case $code in
  129 | 130 | 138 | 143 | 152) ;;
  *) [ "$code" -le 128 ] || echo "run: a rank was ended by signal $((code - 128)) (SIG$(kill -l "$code")), $why" >&2 ;;
esac
exit "$code"
