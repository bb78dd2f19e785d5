# Shell functions of tests/run.sh, examples/run.sh and benchmarks/run.sh. POSIX sh; to be sourced, with
# $root naming the top folder of scree.

say() { printf '%s\n' "$*" >&2; }
die() {
  say "error: $*"
  exit 1
}

# What a build needs, as COMMAND:PACKAGE (present if the command is there) or :PACKAGE (present if dpkg says so).
needed_packages="c++:g++ cmake:cmake ninja:ninja-build gnuplot:gnuplot-nox
  :libeigen3-dev :libboost-dev :doctest-dev :libcli11-dev :nlohmann-json3-dev :libtomlplusplus-dev :libfmt-dev
  :libpng-dev :zlib1g-dev :libbenchmark-dev"

is_installed() {
  if [ -n "${1%%:*}" ]; then
    command -v "${1%%:*}" >/dev/null 2>&1
  else
    [ "$(dpkg-query -W -f='${db:Status-Status}' "${1#:}" 2>/dev/null)" = installed ]
  fi
}

as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  else
    sudo "$@"
  fi
}

# install_missing [COMMAND:PACKAGE...]: brings what is missing by apt-get; uses no network where nothing is.
install_missing() {
  missing=
  for item in $needed_packages "$@"; do
    # Elsewhere than on Debian and its kin only commands can be looked for; CMake tells which library is missing.
    if [ -z "${item%%:*}" ] && ! command -v dpkg-query >/dev/null 2>&1; then
      continue
    fi
    is_installed "$item" || missing="$missing ${item#*:}"
  done
  [ -n "$missing" ] || return 0

  command -v apt-get >/dev/null 2>&1 ||
    die "missing:$missing (Debian's names). README.md, 'Other systems', says how to get them here."
  if [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null 2>&1; then
    die "missing:$missing. Run as root: apt-get install$missing"
  fi
  say "Installing$missing"
  apt_log=$(mktemp)
  # shellcheck disable=SC2086 # a list of names
  if ! { as_root apt-get update && as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get -o DPkg::Lock::Timeout=300 install -y --no-install-recommends $missing; } >"$apt_log" 2>&1 </dev/null; then
    cat "$apt_log" >&2
    rm -f "$apt_log"
    die "apt-get could not install$missing"
  fi
  rm -f "$apt_log"
}

# configure PRESET [-DNAME=VALUE...]: once; again if values are given or the presets have changed.
configure() {
  preset=$1
  shift
  stamp=$root/build/$preset/build.ninja
  if [ $# -eq 0 ] && [ -f "$stamp" ] && [ -z "$(find "$root/CMakePresets.json" -newer "$stamp")" ]; then
    return 0
  fi
  say "Configuring $preset"
  mkdir -p "$root/build"
  if ! cmake -S "$root" --preset "$preset" "$@" >"$root/build/$preset.log" 2>&1 </dev/null; then
    cat "$root/build/$preset.log" >&2
    return 1
  fi
}

# build PRESET TARGET...: silent where nothing is to be done, else one short line a step, warnings and errors.
build() {
  preset=$1
  shift
  {
    # Two compilers a processor, as ninja would have them, are in each other's way: 14 % slower on two.
    NINJA_STATUS='[%f/%t] ' cmake --build "$root/build/$preset" --parallel "$(processors)" --target "$@" 2>&1 </dev/null
    echo "build-ended $?"
  } | while IFS= read -r line; do
    case $line in
    "build-ended "*) exit "${line#build-ended }" ;;
    "ninja: Entering"* | "ninja: no work to do." | *"] Re-checking globbed directories..." | "-- "*) ;;
    \[*\]\ *) say "${line%% *} ${line##*[ /]}" ;;
    *) say "$line" ;;
    esac
  done
}

cpu_name() { sed -n 's/^model name[[:space:]]*: //p' /proc/cpuinfo 2>/dev/null | head -n 1; }
# The name under which results of this machine are kept in benchmarks/results.
machine_name() {
  echo "$(cpu_name) $(processors) cores" | tr -cs 'A-Za-z0-9\n' '-' | tr '[:upper:]' '[:lower:]' | sed 's/^-//; s/-$//'
}
processors() { nproc 2>/dev/null || getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1; }

# run_ctest PRESET [ctest options]: failures and CTest's summary, then sets $passed, $failed and $skipped.
run_ctest() {
  preset=$1
  shift
  results=$root/build/$preset/ctest.xml
  rm -f "$results"
  {
    ctest --test-dir "$root/build/$preset" -j "$(processors)" --output-on-failure --no-tests=error \
      --output-junit "$results" "$@" 2>&1 </dev/null
    echo "ctest-ended $?"
  } | while IFS= read -r line; do
    case $line in
    "ctest-ended "*) exit "${line#ctest-ended }" ;;
    "Internal ctest changing into directory: "* | " "*" Start "*[0-9]": "* | *" Test "*"#"*" Passed "*) ;;
    *) printf '%s\n' "$line" ;;
    esac
  done
  status=$?
  total=$(junit_count tests)
  failed=$(junit_count failures)
  skipped=$(junit_count skipped)
  passed=$((total - failed - skipped))
  return "$status"
}

# One attribute of the <testsuite> of $results; 0 where CTest wrote none.
junit_count() {
  count=$(sed -n "s/^[[:space:]]*\(<testsuite .*\)\{0,1\}$1=\"\([0-9]*\)\".*/\2/p" "$results" 2>/dev/null | head -n 1)
  echo "${count:-0}"
}
