#!/bin/bash
# interrupted_drag.sh PROGRAM FOLDER killed|told|full|read_only|watched [TIMES]
# A drag that is interrupted and gone on with ends in the same files as one that is left alone. Interrupted: by
# SIGKILL at random moments, by SIGTERM, by a disk that is full, by a disk that can only be read, by a bound of the watch
# that is widened then. Returns 77 where no small disk can be had.
set -u
program=$1 folder=$2 how=$3 times=${4:-50}
options=(--threads 1 --rock.size_factor 3 --bed.length 0.8 --bed.width 0.4 --bed.depth 0.2 --bed.unbalanced 0.3
  --rig.bucket_start 0.1 --rig.drag_distance 0.12 --frame_interval 0.03 --picture_interval 0.06)
checkpoints=(--checkpoint_interval 0.03)
disk=$folder/disk run=$folder/disk/run

fail() {
  echo "FAILED: $*" >&2
  cat "$folder/log" >&2
  exit 1
}
clean() { mountpoint -q "$disk" && umount "$disk"; }
trap clean EXIT
clean
rm -rf "$folder" && mkdir -p "$disk" || exit 1

"$program" "${options[@]}" --out "$folder/whole" >"$folder/log" 2>&1 || fail "the run that is left alone"

# What goes on, or begins.
next_command() {
  if [ -e "$run/input.toml" ]; then
    command=("$program" --resume "$run" "${checkpoints[@]}")
  else
    rm -rf "$run"
    command=("$program" "${options[@]}" "${checkpoints[@]}" --out "$run")
  fi
}
go() {
  next_command
  "${command[@]}" >"$folder/log" 2>&1
}
# The same beside this script, as process $job.
go_beside() {
  next_command
  "${command[@]}" >"$folder/log" 2>&1 &
  job=$!
}

finished() { [ -e "$run/summary.json" ] && grep -q '"finished": true' "$run/summary.json"; }
hash() { grep state_hash "$1/summary.json"; }
# Lets the run come to its end and looks at what it leaves.
finish() {
  finished || go || fail "did not come to its end"
  for file in $(cd "$folder/whole" && find . -type f ! -name summary.json ! -name input.toml); do
    cmp "$folder/whole/$file" "$run/$file" || fail "$file is another"
  done
  there=$(cd "$run" && find . -type f | sort) expected=$(cd "$folder/whole" && find . -type f | sort)
  [ "$there" = "$expected" ] || fail "other files: $there"
  [ -n "$(hash "$run")" ] && [ "$(hash "$run")" = "$(hash "$folder/whole")" ] || fail "another state"
}

RANDOM=7 # a seed: the moments are as good as random all the same
case $how in
killed | told)
  signal=KILL
  [ "$how" = told ] && signal=TERM
  count=0 runs=1
  while [ "$count" -lt "$times" ]; do
    go_beside
    sleep "0.$((RANDOM % 40 + 12))"
    kill -"$signal" "$job" 2>/dev/null
    wait "$job" 2>/dev/null
    status=$?
    [ "$status" -gt 128 ] && count=$((count + 1))
    if [ "$how" = told ] && [ "$status" -ne 0 ]; then
      [ "$status" -eq 143 ] && grep -q -- "--resume $run" "$folder/log" || fail "told to stop, it ended with $status"
    fi
    if finished; then
      finish
      rm -rf "$run"
      runs=$((runs + 1))
    fi
  done
  echo "interrupted $count times in $runs runs"
  ;;
full)
  mount -t tmpfs -o size=300k none "$disk" 2>/dev/null || exit 77
  for size in 600k 1m 2m 3m; do
    go && fail "wrote everything to a disk of less than $size"
    mount -o "remount,size=$size" "$disk"
  done
  mount -o remount,size=500m "$disk"
  ;;
read_only)
  mount -t tmpfs -o size=500m none "$disk" 2>/dev/null || exit 77
  for k in 1 2 3; do
    go_beside
    sleep "0.$((RANDOM % 40 + 30))"
    mount -o remount,ro "$disk" 2>/dev/null || { # a file is open for writing: cut it off from its disk
      kill -KILL "$job" 2>/dev/null
      wait "$job" 2>/dev/null
      # What it had called may write for a moment yet.
      for wait_for_it in {1..100}; do
        mount -o remount,ro "$disk" 2>/dev/null && break
        [ "$wait_for_it" -lt 100 ] || fail "the disk is written to by what nobody knows"
        sleep 0.1
      done
    }
    wait "$job" 2>/dev/null
    go && fail "went on on a disk that can only be read"
    mount -o remount,rw "$disk"
  done
  ;;
watched)
  "$program" "${options[@]}" "${checkpoints[@]}" --watch.overlap 0.05 --out "$run" >"$folder/log" 2>&1
  [ $? -eq 2 ] && grep -q "above watch.overlap = 0.05" "$folder/log" || fail "the watch did not end it"
  [ -e "$run/checkpoint" ] || fail "nothing to go on from"
  go && fail "went on beyond the bound"
  rm "$run"/trouble.*
  "$program" --resume "$run" --watch.overlap 0.3 "${checkpoints[@]}" >"$folder/log" 2>&1 || fail "did not go on"
  grep -q "goes on at" "$folder/log" || fail "began anew"
  ;;
esac

finish
"$program" --resume "$run" >"$folder/log" 2>&1 && fail "began a finished run anew"
grep -q "has come to its end" "$folder/log" || fail "did not say that the run has come to its end"
finish # and is as it was
rm -rf "$folder/whole"
