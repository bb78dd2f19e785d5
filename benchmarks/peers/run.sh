#!/bin/sh
# sh benchmarks/run.sh peers [--out DIR] [--repeats N] [--steps N] [--keep]: times scree side by side with LAMMPS
# on a settled bed of 20,000 spheres and leaves peers.csv, a chart and what machine it was in DIR (out/peers).
# --keep also puts the table and the machine under benchmarks/results/.
# LAMMPS='lmp /path/to/lmp' names the LAMMPS binaries to time; the first is the one that ratios refer to.
set -u
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd) || exit 1
. "$root/cmake/setup.sh"

out=$root/out/peers
repeats=7
steps=300
warm=100
keep=false
while [ $# -gt 0 ]; do
  case $1 in
  --out) out=${2-} && shift ;;
  --repeats) repeats=${2-} && shift ;;
  --steps) steps=${2-} && shift ;;
  --keep) keep=true ;;
  *) die "unknown option '$1'; there are --out DIR, --repeats N, --steps N, --keep" ;;
  esac
  shift || die "the last option lacks its value"
done
[ -n "$out" ] || die "--out needs a folder"

LAMMPS=${LAMMPS:-lmp}
if [ "$LAMMPS" = lmp ]; then
  install_missing lmp:lammps taskset:util-linux
else
  install_missing taskset:util-linux
fi
for preset in generic native; do
  configure "$preset" || exit 1
  build "$preset" benchmark_peers || exit 1
done
mkdir -p "$out" || exit 1
native=$root/build/native/benchmarks/peers
generic=$root/build/generic/benchmarks/peers
deck=$root/benchmarks/peers/lammps_bed.in
lammps=${LAMMPS%% *}

# lammps_run NAME [-var NAME VALUE]...: LAMMPS's output in $out/NAME.log.
lammps_run() {
  log=$out/$1.log
  shift
  # shellcheck disable=SC2086 # a launcher with its options, or nothing
  ${launcher-} "$lammps" -in "$deck" -log none -var warm "$warm" -var steps "$steps" "$@" >"$log" 2>&1 </dev/null || {
    cat "$log" >&2
    die "LAMMPS failed: $lammps"
  }
}

# ---- the work, and whether both do the same --------------------------------------------------------------------

bed=$out/bed.txt
if [ ! -f "$bed" ]; then
  say "Settling the bed (once, about a minute)"
  "$native" make "$out/bed.part" --threads "$(processors)" && mv "$out/bed.part" "$bed" || exit 1
fi
grains=$(head -n 1 "$bed" | cut -d ' ' -f 1)
"$native" data "$bed" "$out/bed.data" && "$native" data --squeezed "$bed" "$out/squeezed.data" || exit 1
lammps_run check_forces -var data "$out/squeezed.data" -var check forces -var friction 1e4 -var dump "$out/forces.dump"
lammps_run check_places -var data "$out/bed.data" -var check places -var dump "$out/places.dump"
"$generic" same "$bed" "$out/forces.dump" "$out/places.dump" --steps "$warm" >"$out/same.txt" || exit 1
cat "$out/same.txt"

# ---- what it runs on --------------------------------------------------------------------------------------------

commit=$(git -C "$root" rev-parse --short HEAD 2>/dev/null || echo unknown)
[ -z "$(git -C "$root" status --porcelain -- include benchmarks cmake 2>/dev/null)" ] || commit=$commit+changes
cpu=$(cpu_name)
flags_of() {
  tr -d '\n' <"$root/build/$1/compile_commands.json" | tr '{' '\n' | sed -n '/benchmarks\/peers\/main/p' |
    tr ' ' '\n' | grep -E '^-(O|std|D|m|f)' | grep -v '^-fdiagnostics' | tr '\n' ' '
}
{
  echo "date:     $(date -u +%Y-%m-%d)"
  echo "cpu:      $cpu, $(processors) processors"
  echo "system:   $(sed -n 's/^PRETTY_NAME="\(.*\)"/\1/p' /etc/os-release 2>/dev/null), $(uname -sr)"
  echo "scree:    $commit"
  echo "compiler: $(c++ --version | head -n 1)"
  echo "generic:  $(flags_of generic)"
  echo "native:   $(flags_of native)"
  for lammps in $LAMMPS; do
    echo "LAMMPS:   $("$lammps" -h 2>/dev/null | grep -m 1 'Simulator') ($lammps)"
  done
  echo "work:     $grains spheres, $warm steps before $steps timed ones, $repeats repeats in turn"
} >"$out/machine.txt"

# ---- repeats in turn, each a fresh process on the same core ------------------------------------------------------

contacts=0
# time_scree NAME PROGRAM REAL THREADS [options]
time_scree() {
  name=$1 program=$2 real=$3 threads=$4
  shift 4
  result=$(taskset -c "0-$((threads - 1))" "$program" time "$bed" --real "$real" --threads "$threads" \
    --warm "$warm" --steps "$steps" "$@") || exit 1
  contacts=$(echo "$result" | cut -d ' ' -f 2)
  [ "$(echo "$result" | cut -d ' ' -f 3)" = 0 ] || say "warning: $name renewed its lists within the timed steps"
  echo "$name;$commit;$real;$threads;${result%% *}" >>"$out/repeats.txt"
}
# time_lammps THREADS: the binary $lammps
time_lammps() {
  threads=$1
  launcher="taskset -c 0-$((threads - 1))"
  # taskset before mpirun: the ranks inherit it.
  [ "$threads" = 1 ] || launcher="$launcher mpirun --allow-run-as-root --bind-to none -np $threads"
  lammps_run timed -var data "$out/bed.data"
  seconds=$(sed -n '/^timed part/,$s/^Loop time of \([^ ]*\) .*/\1/p' "$log")
  [ -n "$seconds" ] || die "no loop time in $log"
  grep -q 'Neighbor list builds = 0' "$log" || say "warning: LAMMPS renewed its lists"
  version=$(sed -n 's/^LAMMPS (\([^)]*\)).*/\1/p' "$log" | head -n 1)
  label=LAMMPS
  [ "$lammps" = "${LAMMPS%% *}" ] || label="LAMMPS ($lammps)"
  echo "$label;$version;double;$threads;$seconds" >>"$out/repeats.txt"
}

two=false
[ "$(processors)" -lt 2 ] || two=true
: >"$out/repeats.txt"
repeat=0
while [ "$repeat" -lt "$repeats" ]; do
  repeat=$((repeat + 1))
  say "Repeat $repeat of $repeats"
  for lammps in $LAMMPS; do time_lammps 1; done
  time_scree "scree generic" "$generic" double 1
  time_scree "scree generic + energy audit" "$generic" double 1 --audit
  time_scree "scree native" "$native" double 1
  time_scree "scree native + energy audit" "$native" double 1 --audit
  time_scree "scree native + energy audit" "$native" float 1 --audit
  if $two; then
    if command -v mpirun >/dev/null 2>&1; then
      for lammps in $LAMMPS; do time_lammps 2; done
    fi
    time_scree "scree generic" "$generic" double 2
    time_scree "scree native" "$native" double 2
  fi
done

# ---- table and chart ---------------------------------------------------------------------------------------------

cat "$out/machine.txt"
"$native" table "$out/repeats.txt" "$out/peers.csv" --grains "$grains" --contacts "$contacts" --steps "$steps" \
  >"$out/peers.md" || exit 1
cat "$out/peers.md"
gnuplot -e "out='$out'" "$root/benchmarks/peers/chart.gp" || say "warning: no chart (gnuplot failed)"

if $keep; then
  results=$root/benchmarks/results/$(machine_name)
  mkdir -p "$results" && cp "$out/peers.csv" "$out/peers.md" "$out/machine.txt" "$out/same.txt" "$results/" || exit 1
  say "Kept in $results"
fi
echo "$out"
