#!/bin/sh
# sh tests/fuzz/run.sh READER [SECONDS]: looks for bytes that break the reader of stl, csv, calibration or checkpoint
# (3600 s by default, on one core), then leaves in tests/fuzz/corpora/READER the fewest that take it wherever it came,
# beside those with names that tell something. What broke it is left in the folder from which this is called, as
# crash-*: mend, and put it into the corpus under a name.
set -u
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd) || exit 1
. "$root/cmake/setup.sh"

reader=${1-}
seconds=${2-3600}
corpus=$root/tests/fuzz/corpora/$reader
[ -n "$reader" ] && [ -d "$corpus" ] || die "usage: sh tests/fuzz/run.sh stl|csv|calibration|checkpoint [SECONDS]"

# The runtime of the fuzzer and the sanitizers is only recommended by the package clang.
install_missing clang++:clang :libclang-rt-14-dev
configure fuzz || exit 1
build fuzz "fuzz_$reader" || exit 1
program=$root/build/fuzz/tests/fuzz_readers/fuzz_$reader
work=$root/build/fuzz/corpora/$reader
mkdir -p "$work" || exit 1
# Inputs go through files: in memory where that can be had.
[ ! -d /dev/shm ] || export TMPDIR=/dev/shm
# A busy machine makes a reader wait for seconds; a minute is more than that.
"$program" -max_total_time="$seconds" -max_len=4096 -timeout=60 -rss_limit_mb=2048 -print_final_stats=1 \
  "$work" "$corpus" || exit 1
fewest=$work.fewest
rm -rf "$fewest"
mkdir "$fewest" || exit 1
"$program" -merge=1 -max_len=4096 "$fewest" "$corpus" "$work" >"$work.log" 2>&1 || {
  cat "$work.log" >&2
  exit 1
}
# The fuzzer names inputs by the SHA-1 sum of what is in them.
find "$corpus" -type f | grep -E '/[0-9a-f]{40}$' | xargs -r rm
for named in "$corpus"/*; do
  [ ! -f "$named" ] || rm -f "$fewest/$(sha1sum "$named" | cut -d ' ' -f 1)"
done
find "$fewest" -type f -exec cp {} "$corpus" \;
say "$(find "$corpus" -type f | wc -l) inputs in $corpus"
