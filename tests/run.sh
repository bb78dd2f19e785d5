#!/bin/sh
# sh tests/run.sh [ctest options]: installs what is missing, configures, builds, runs the tests.
# Without an option that chooses labels (-L, -LE) everything runs but the tests labelled `long`.
set -u
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd) || exit 1
. "$root/cmake/setup.sh"

install_missing
configure release || exit 1
build release scree_tests scree_examples || exit 1

case " $* " in
*" -L"* | *" --label"*) ;;
*) set -- -LE '^long$' "$@" ;;
esac
run_ctest release "$@"
status=$?

line="$passed passed, $failed failed"
[ "$skipped" -eq 0 ] || line="$line, $skipped skipped"
echo "$line"
exit "$status"
