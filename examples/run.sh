#!/bin/sh
# sh examples/run.sh NAME [options]: installs what is missing, configures, builds the example NAME and runs it.
# sh examples/run.sh --list: the examples, one line each.
# SCREE_PRESET=avx2 or avx512 before it builds for such a machine, where runs take less time; debug is for a debugger.
set -u
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd) || exit 1
. "$root/cmake/setup.sh"

list() {
  for source in "$root"/examples/*.cpp "$root"/examples/*/main.cpp; do
    [ -f "$source" ] || continue
    name=${source#"$root"/examples/}
    name=${name%/main.cpp}
    printf '%-16s %s\n' "${name%.cpp}" "$(sed -n 's|^/// \\brief *||p' "$source" | head -n 1)"
  done
}

case ${1-} in
--list)
  list
  exit 0
  ;;
'' | -h | --help)
  echo "usage: sh examples/run.sh NAME [options]    (NAME --help tells the options)"
  list
  [ $# -gt 0 ]
  exit
  ;;
esac

name=$1
shift
case $name in */* | *.*) known=no ;; *) known=yes ;; esac
if [ $known = no ] || { [ ! -f "$root/examples/$name.cpp" ] && [ ! -f "$root/examples/$name/main.cpp" ]; }; then
  say "error: no example is named '$name'. There are:"
  list >&2
  exit 2
fi

preset=${SCREE_PRESET:-release}
case $preset in
release | avx2 | avx512 | debug) ;;
*) die "SCREE_PRESET = '$preset' is not one of release, avx2, avx512, debug" ;;
esac

install_missing
configure "$preset" || exit 1
build "$preset" "example_$name" || exit 1
exec "$root/build/$preset/examples/$name" "$@"
