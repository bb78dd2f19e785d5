#!/bin/bash
# interrupted_campaign.sh PROGRAM FOLDER TIMES OPTIONS...
# A campaign of many runs that is killed at random moments and gone on with (--resume true) ends in the same files as one
# that is left alone, but for what tells how it came to be.
set -u
program=$1 folder=$2 times=$3
shift 3
run=$folder/run

fail() {
  echo "FAILED: $*" >&2
  cat "$folder/log" >&2
  exit 1
}
rm -rf "$folder" && mkdir -p "$folder" || exit 1
began=$(date +%s%3N)
"$program" "$@" --out "$folder/whole" >"$folder/log" 2>&1 || fail "the campaign that is left alone"
length=$(($(date +%s%3N) - began)) # ms

# A file of a campaign without its clock, its own folder, and which runs were kept from before.
told() {
  sed -E -e '/"(seconds|done|kept_from_before|resume)":|^resume = /d' -e 's/ failed, [0-9]+ s\. / failed. /' \
    -e "s|$1|FOLDER|g" "$1/$2"
}
compare() {
  for file in $(cd "$folder/whole" && find . -type f); do
    cmp -s <(told "$folder/whole" "$file") <(told "$run" "$file") || fail "$file is another"
  done
  diff <(cd "$folder/whole" && find . -type f | sort) <(cd "$run" && find . -type f | sort) || fail "other files"
}

RANDOM=7 # a seed: the moments are as good as random all the same
count=0 runs=0
while [ "$count" -lt "$times" ]; do
  rm -rf "$run"
  runs=$((runs + 1))
  while true; do
    resume=false
    [ -e "$run/input.toml" ] && resume=true || rm -rf "$run"
    "$program" "$@" --resume "$resume" --out "$run" >"$folder/log" 2>&1 &
    job=$!
    moment=$((length * (RANDOM % 100) / 100))
    sleep "$((moment / 1000)).$(printf '%03d' $((moment % 1000)))"
    kill -KILL "$job" 2>/dev/null
    wait "$job" 2>/dev/null
    status=$?
    [ "$status" -eq 0 ] && break
    [ "$status" -eq 137 ] || fail "it ended with $status"
    count=$((count + 1))
    [ "$count" -lt $((20 * times)) ] || fail "never came to its end"
  done
  compare
done
echo "killed $count times in $runs campaigns"
rm -rf "$folder/whole"
