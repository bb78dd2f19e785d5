#!/bin/sh
# sh benchmarks/run.sh peers [--out DIR] [--repeats N] [--works "NAME ..."] [--keep]: times scree side by side with
# LAMMPS and LIGGGHTS and leaves peers.csv, the tables, a chart and what machine it was in DIR (out/peers).
# --works: some of bed bed100k flow clumps bucket scale. --keep also puts the results under benchmarks/results/.
# LAMMPS='lmp /path/to/lmp' and LIGGGHTS='...' name the binaries to time.
set -u
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd) || exit 1
. "$root/cmake/setup.sh"

out=$root/out/peers
repeats=5
works="bed bed100k flow clumps bucket scale"
keep=false
while [ $# -gt 0 ]; do
  case $1 in
  --out) out=${2-} && shift ;;
  --repeats) repeats=${2-} && shift ;;
  --works) works=${2-} && shift ;;
  --keep) keep=true ;;
  *) die "unknown option '$1'; there are --out DIR, --repeats N, --works \"NAME ...\", --keep" ;;
  esac
  shift || die "the last option lacks its value"
done
[ -n "$out" ] || die "--out needs a folder"
for work in $works; do
  case $work in
  bed | bed100k | flow | clumps | bucket | scale) ;;
  *) die "no work is named '$work'" ;;
  esac
done

LAMMPS=${LAMMPS:-lmp}
LIGGGHTS=${LIGGGHTS:-liggghts}
set -- taskset:util-linux /usr/bin/time:time
[ "$LAMMPS" != lmp ] || set -- "$@" lmp:lammps
[ "$LIGGGHTS" != liggghts ] || set -- "$@" liggghts:liggghts
install_missing "$@"
for preset in generic avx2 native; do
  configure "$preset" || exit 1
  build "$preset" benchmark_peers || exit 1
done
mkdir -p "$out" || exit 1
native=$root/build/native/benchmarks/peers
portable=$root/build/generic/benchmarks/peers
avx2=$root/build/avx2/benchmarks/peers
decks=$root/benchmarks/peers
two=false
[ "$(processors)" -lt 2 ] || two=true

# peer_run BINARY THREADS NAME [-var NAME VALUE]...: LAMMPS or LIGGGHTS, output and peak memory in $out/NAME.log.
peer_run() {
  binary=$1 threads=$2 log=$out/$3.log
  shift 3
  deck=$decks/lammps.in
  case " $LIGGGHTS " in *" $binary "*) deck=$decks/liggghts.in ;; esac
  launcher="taskset -c 0-$((threads - 1)) /usr/bin/time -f %M,KiB"
  # taskset before mpirun: the ranks inherit it.
  [ "$threads" = 1 ] || launcher="$launcher mpirun --allow-run-as-root --bind-to none -np $threads"
  # shellcheck disable=SC2086 # a launcher with its options
  (cd "$out" && $launcher "$binary" -in "$deck" -log none "$@") >"$log" 2>&1 </dev/null || {
    cat "$log" >&2
    die "$binary failed"
  }
}

# ---- the beds ----------------------------------------------------------------------------------------------------

# made FILE COMMAND...: runs the command, which writes FILE.part, unless FILE is there.
made() {
  file=$out/$1
  shift
  [ -f "$file" ] && return
  say "Making ${file##*/}"
  "$@" && mv "$file.part" "$file" || exit 1
}
cores=$(processors)
tilt=30
made cell.bed "$native" make "$out/cell.bed.part" --threads "$cores"
made bed.bed "$native" tile "$out/cell.bed" "$out/bed.bed.part" 2 2
for work in $works; do
  case $work in
  bed100k) made bed100k.bed "$native" tile "$out/cell.bed" "$out/bed100k.bed.part" 4 5 ;;
  flow) made flow.bed "$native" flow "$out/bed.bed" "$out/flow.bed.part" --tilt $tilt --steps 15000 --threads "$cores" ;;
  clumps)
    made clump_cell.bed "$native" make "$out/clump_cell.bed.part" --shape tetrahedron --threads "$cores"
    made clumps.bed "$native" tile "$out/clump_cell.bed" "$out/clumps.bed.part" 2 2
    ;;
  bucket) made bucket.bed "$native" room "$out/bed.bed" "$out/bucket.bed.part" "$out/bucket.stl" ;;
  scale)
    made bed100k.bed "$native" tile "$out/cell.bed" "$out/bed100k.bed.part" 4 5
    made bed1000k.bed "$native" tile "$out/cell.bed" "$out/bed1000k.bed.part" 10 20
    ;;
  esac
done
for bed in bed bed100k flow clumps bucket; do
  [ ! -f "$out/$bed.bed" ] || made "$bed.data" "$native" data "$out/$bed.bed" "$out/$bed.data.part"
done

# ---- whether all do the same ---------------------------------------------------------------------------------------

# same_forces BINARY BED [-var ...]: both builds of scree beside another code.
same_forces() {
  binary=$1 bed=$2
  shift 2
  made "$bed.squeezed" "$native" data --squeezed "$out/$bed.bed" "$out/$bed.squeezed.part"
  rm -f "$out/forces.dump"
  peer_run "$binary" 1 check -var data "$out/$bed.squeezed" -var warm 0 -var steps 0 -var check forces -var first 1 \
    -var friction 1e4 -var dump "$out/forces.dump" "$@"
  for program in "$portable" "$native"; do
    echo "$bed, $binary:"
    "$program" same "$out/$bed.bed" "$out/forces.dump" || exit 1
  done
}
lammps=${LAMMPS%% *}
{
  same_forces "$lammps" bed
  same_forces "${LIGGGHTS%% *}" bed
  [ ! -f "$out/clumps.bed" ] || same_forces "$lammps" clumps -var grains clumps
  peer_run "$lammps" 1 check -var data "$out/bed.data" -var warm 100 -var steps 0 -var check places \
    -var dump "$out/places.dump"
  "$native" places "$out/bed.bed" "$out/places.dump" --steps 100 || exit 1
} >"$out/same.txt"
cat "$out/same.txt"
grep -q '^after' "$out/same.txt" || exit 1

# ---- what it runs on -----------------------------------------------------------------------------------------------

commit=$(git -C "$root" rev-parse --short HEAD 2>/dev/null || echo unknown)
[ -z "$(git -C "$root" status --porcelain -- include benchmarks cmake 2>/dev/null)" ] || commit=$commit+changes
flags_of() {
  tr -d '\n' <"$root/build/$1/compile_commands.json" | tr '{' '\n' | sed -n '/benchmarks\/peers\/main/p' |
    tr ' ' '\n' | grep -E '^-(O|std|D|m|f)' | grep -v '^-fdiagnostics' | tr '\n' ' '
}
# version_of BINARY
version_of() {
  # LIGGGHTS leaves a log where it is called.
  (cd "$out" && "$1" -h 2>/dev/null </dev/null) |
    sed -n 's/^Large-scale Atomic[^-]*Simulator - //p; s/^LIGGGHTS (Version \([^,]*\),.*/\1/p' | head -n 1
}
{
  echo "date:     $(date -u +%Y-%m-%d)"
  echo "cpu:      $(cpu_name), $(processors) processors"
  echo "system:   $(sed -n 's/^PRETTY_NAME="\(.*\)"/\1/p' /etc/os-release 2>/dev/null), $(uname -sr)"
  echo "scree:    $commit"
  echo "compiler: $(c++ --version | head -n 1)"
  echo "portable: $(flags_of generic)"
  echo "AVX2:     $(flags_of avx2)"
  echo "native:   $(flags_of native)"
  for binary in $LAMMPS; do echo "LAMMPS:   $(version_of "$binary") ($binary)"; done
  for binary in $LIGGGHTS; do echo "LIGGGHTS: $(version_of "$binary") ($binary)"; done
  echo "repeats:  $repeats, all codes in turn"
} >"$out/machine.txt"

# ---- repeats in turn, each a fresh process on the same core --------------------------------------------------------

# time_scree WORK CODE REAL THREADS BED WARM STEPS [options]
time_scree() {
  work=$1 code=$2 real=$3 threads=$4 bed=$5 warm=$6 steps=$7
  shift 7
  program=$native
  case $code in
  *portable*) program=$portable ;;
  *AVX2*) program=$avx2 ;;
  esac
  result=$(taskset -c "0-$((threads - 1))" "$program" time "$out/$bed.bed" --real "$real" --threads "$threads" \
    --warm "$warm" --steps "$steps" "$@") || exit 1
  # grains;contacts;steps;MB;renewals;seconds
  case $work in
  bed | bed100k)
    [ "$(echo "$result" | cut -d ';' -f 5)" = 0 ] || say "warning: $code renewed its lists within the timed steps"
    ;;
  esac
  echo "$work;$code;$commit;$real;$threads;$(echo "$result" | cut -d ';' -f 1-4,6)" >>"$out/repeats.txt"
}
# time_peer WORK BINARY THREADS BED WARM STEPS [-var ...]
time_peer() {
  work=$1 binary=$2 threads=$3 bed=$4 warm=$5 steps=$6
  shift 6
  peer_run "$binary" "$threads" timed -var data "$out/$bed.data" -var warm "$warm" -var steps "$steps" "$@"
  seconds=$(sed -n '/^timed part/,$s/^Loop time of \([^ ]*\) .*/\1/p' "$log")
  [ -n "$seconds" ] || die "no loop time in $log"
  case $work in
  bed | bed100k)
    sed '1,/^timed part/d' "$log" | grep -q 'Neighbor list builds = 0' || say "warning: $binary renewed its lists"
    ;;
  esac
  megabytes=$(sed -n 's/^\([0-9]*\),KiB$/\1/p' "$log" | awk '{ print $1 / 1024 }')
  [ "$threads" = 1 ] || megabytes=0 # that of mpirun
  case " $LIGGGHTS " in
  *" $binary "*) label=LIGGGHTS first=${LIGGGHTS%% *} ;;
  *) label=LAMMPS first=${LAMMPS%% *} ;;
  esac
  [ "$binary" = "$first" ] || label="$label ($binary)"
  grains=$(head -n 1 "$out/$bed.bed" | cut -d ' ' -f 1)
  echo "$work;$label;$(version_of "$binary");double;$threads;$grains;0;$steps;$megabytes;$seconds" >>"$out/repeats.txt"
}
# peers_on WORK THREADS BED WARM STEPS [-var ...]
peers_on() {
  work_=$1 threads_=$2
  shift 2
  for each in $LAMMPS $LIGGGHTS; do time_peer "$work_" "$each" "$threads_" "$@"; done
}
# scree_on WORK THREADS BED WARM STEPS [options]
scree_on() {
  work_=$1 threads_=$2
  shift 2
  time_scree "$work_" "scree portable" double "$threads_" "$@"
  time_scree "$work_" "scree native" double "$threads_" "$@"
  [ "$threads_" != 1 ] || time_scree "$work_" "scree native" float 1 "$@"
}

: >"$out/repeats.txt"
repeat=0
while [ "$repeat" -lt "$repeats" ]; do
  repeat=$((repeat + 1))
  say "Repeat $repeat of $repeats"
  for work in $works; do
    case $work in
    bed)
      peers_on bed 1 bed 100 300
      scree_on bed 1 bed 100 300
      time_scree bed "scree AVX2" double 1 bed 100 300
      time_scree bed "scree portable + audit" double 1 bed 100 300 --audit
      time_scree bed "scree native + audit" double 1 bed 100 300 --audit
      if $two; then
        peers_on bed 2 bed 100 300
        scree_on bed 2 bed 100 300
      fi
      ;;
    bed100k)
      peers_on bed100k 1 bed100k 30 100
      scree_on bed100k 1 bed100k 30 100
      if $two; then
        for each in $LAMMPS; do time_peer bed100k "$each" 2 bed100k 30 100; done
        scree_on bed100k 2 bed100k 30 100
      fi
      ;;
    flow)
      peers_on flow 1 flow 200 1000 -var skin 0.002 -var tilt $tilt
      scree_on flow 1 flow 200 1000 --tilt $tilt
      ;;
    clumps)
      for each in $LAMMPS; do time_peer clumps "$each" 1 clumps 100 300 -var grains clumps; done
      scree_on clumps 1 clumps 100 300
      ;;
    bucket)
      time_peer "no bucket" "${LIGGGHTS%% *}" 1 bucket 200 400
      time_peer "bucket 520" "${LIGGGHTS%% *}" 1 bucket 200 400 -var bucket 1 -var stl "$out/bucket.stl"
      time_scree "no bucket" "scree native" double 1 bucket 500 1000
      time_scree "bucket 520" "scree native" double 1 bucket 500 1000 --bucket simplified
      time_scree "bucket 5000" "scree native" double 1 bucket 500 1000 --bucket detailed
      ;;
    scale)
      # As many steps before in each: packs are dealt out anew while a bed that was read in comes to rest.
      time_scree "scale 5k" "scree native" double 1 cell 500 1000
      time_scree "scale 20k" "scree native" double 1 bed 500 300
      time_scree "scale 100k" "scree native" double 1 bed100k 500 100
      time_scree "scale 1000k" "scree native" double 1 bed1000k 500 100
      ;;
    esac
  done
done

# ---- tables and chart ----------------------------------------------------------------------------------------------

cat "$out/machine.txt"
"$native" table "$out/repeats.txt" "$out" || exit 1
cat "$out/peers.md" "$out/goals.md"
gnuplot -e "out='$out'" "$root/benchmarks/peers/chart.gp" || say "warning: no chart (gnuplot failed)"

if $keep; then
  results=$root/benchmarks/results/$(machine_name)
  mkdir -p "$results" || exit 1
  for file in peers.csv peers.md goals.md machine.txt same.txt; do cp "$out/$file" "$results/" || exit 1; done
  say "Kept in $results"
fi
echo "$out"
