#!/bin/bash
# same_for_any_threads.sh PROGRAM FOLDER [OPTIONS...]
# A program that simulates ends in the same bits for 1, 2 and 4 threads and when it is run again: state and tables.
set -u
program=$1 folder=$2
shift 2

fail() {
  echo "FAILED: $*" >&2
  cat "$folder"/*.log >&2
  exit 1
}
rm -rf "$folder" && mkdir -p "$folder" || exit 1

go() { # THREADS[-again] OPTIONS
  local run=$1
  shift
  "$program" "$@" --threads "${run%-again}" --out "$folder/$run" >"$folder/$run.log" 2>&1
}
# Two that need a processor each, side by side; then those that need them all.
go 1 "$@" &
go 1-again "$@" || fail "threads: 1, again"
wait $! || fail "threads: 1"
for run in 2 4; do
  go "$run" "$@" || fail "threads: $run"
done
for run in 1 1-again 2 4; do
  hash=$(sed -n 's/.*"state_hash": "\([0-9a-f]*\)".*/\1/p' "$folder/$run/summary.json")
  [ -n "$hash" ] || fail "threads: $run: no state_hash in summary.json"
  [ "$hash" = "${first:=$hash}" ] || fail "threads: $run: state $hash where 1 thread gave $first"
  for table in "$folder/1"/*.csv; do
    cmp "$table" "$folder/$run/${table##*/}" || fail "threads: $run: ${table##*/} is another"
  done
done
echo "state $first"
