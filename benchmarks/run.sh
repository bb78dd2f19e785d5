#!/bin/sh
# sh benchmarks/run.sh [NAME...] [--keep] [--benchmark_...]: installs what is missing, configures, builds for this very
# machine and runs the benchmarks of the folders NAME, or all of them. Options go to each (Google Benchmark's).
# --keep also puts each answer, as JSON, under benchmarks/results/.
# sh benchmarks/run.sh peers [options]: side by side with other programs (benchmarks/peers/run.sh).
set -u
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd) || exit 1
. "$root/cmake/setup.sh"

if [ "${1-}" = peers ]; then
  shift
  exec sh "$root/benchmarks/peers/run.sh" "$@"
fi

known=
for folder in "$root"/benchmarks/*/; do
  name=$(basename "$folder")
  if [ "$name" != peers ] && ls "$folder"*.cpp >/dev/null 2>&1; then
    known="$known $name"
  fi
done

names=
keep=false
targets=
options=
for argument in "$@"; do
  case $argument in
  --keep) keep=true ;;
  -*) options="$options $argument" ;;
  *)
    case "$known " in
    *" $argument "*) names="$names $argument" ;;
    *) die "no benchmark is named '$argument'. There are:$known peers" ;;
    esac
    ;;
  esac
done
[ -n "$names" ] || names=$known
[ -n "$names" ] || die "there is no benchmark"
for name in $names; do targets="$targets benchmark_$name"; done

install_missing
configure native || exit 1
# shellcheck disable=SC2086 # lists of names
build native $targets || exit 1
results=$root/benchmarks/results/$(machine_name)
if $keep; then mkdir -p "$results" || exit 1; fi
status=0
for name in $names; do
  # shellcheck disable=SC2086
  set -- $options
  if $keep; then set -- "$@" "--benchmark_out=$results/$name.json" --benchmark_out_format=json; fi
  "$root/build/native/benchmarks/$name" "$@" || status=$?
done
exit "$status"
