#!/bin/bash
# trouble_is_shown.sh PROGRAM FOLDER [OPTIONS...]
# A run in which grains get faster than --watch.speed ends with one sentence that says so, and leaves what is needed to
# look for the cause.
set -u
program=$1 folder=$2
shift 2

fail() {
  echo "FAILED: $*" >&2
  cat "$folder.log" >&2
  exit 1
}
rm -rf "$folder" && mkdir -p "${folder%/*}" || exit 1
"$program" "$@" --watch.speed 0.01 --out "$folder" >"$folder.log" 2>&1
status=$?
[ "$status" -eq 2 ] || fail "exit status $status"
grep -q '^.*body [0-9]* has a speed of .* above watch.speed = 0.01 m/s, at t = .*Likely' "$folder.log" || fail "no sentence"
for file in trouble.vtp trouble.checkpoint; do
  [ -s "$folder/$file" ] || fail "no $file"
done
head -n 1 "$folder/trouble.checkpoint" | grep -q '^scree checkpoint' || fail "trouble.checkpoint is none"
grep -q '"error": "body ' "$folder/summary.json" || fail "no error in summary.json"
grep -q '"finished": false' "$folder/summary.json" || fail "summary.json says that it ended well"
