#!/bin/sh
# Error against mesh size, as a table and a plot: docs/log/convergence.md and docs/log/convergence.svg are made
# by
#
#   bench/convergence.sh BUILD OUT [options of bench convergence]
#
# OUT gets convergence.json and convergence.svg; the table goes to stdout. Some minutes; needs python3.
set -eu
[ $# -ge 2 ] || { sed -n '5p' "$0" | sed 's/^# *//' >&2; exit 2; }
build=$1
out=$2
shift 2
here=$(dirname "$0")
mkdir -p "$out"
"$build/bin/bench" convergence --json --markdown "$out/convergence.table.md" "$@" \
  > "$out/convergence.json"
python3 "$here/convergence.py" "$out/convergence.json" "$out/convergence.svg"
cat "$out/convergence.table.md"
