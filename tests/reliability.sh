#!/bin/sh
# The figures of docs/RELIABILITY.md, made again:
#   tests/reliability.sh [seconds a fuzzer [kills a kind of output [folder of the build [minutes]]]]
# The build must have the tool and the tests. After so many minutes (default: without end) it stops
# with code 75, and the same command goes on where it was. What each stage said is kept in
# FOLDER/reliability; without that folder all begins anew. At the end: one table, in Markdown.
set -eu
cd "$(dirname "$0")/.."
seconds="${1:-3600}"
kills="${2:-100}"
build="${3:-build}"
minutes="${4:-0}"
kept="$build/reliability"
mkdir -p "$kept"
until=""
if [ "$minutes" -gt 0 ]; then until="$(($(date +%s) + 60 * minutes))"; fi

# stage NAME COMMAND...: runs it unless it has run to its end before; its output is kept.
stage() {
  name="$1"
  shift
  if [ -f "$kept/$name.code" ]; then return; fi
  if [ -n "$until" ] && [ "$(date +%s)" -ge "$until" ]; then
    echo "reliability: time is up before '$name'; the same command goes on" >&2
    exit 75
  fi
  echo "== $name" >&2
  code=0
  "$@" >"$kept/$name.out" 2>&1 || code=$?
  if [ "$code" = 75 ]; then
    echo "reliability: time is up in '$name'; the same command goes on" >&2
    exit 75
  fi
  echo "$code" >"$kept/$name.code"
}

fuzz() {
  PLEXWAY_FUZZ_ON=1 PLEXWAY_FUZZ_UNTIL="$until" tests/fuzz.sh "$seconds" "$build/fuzz"
}

stage kills tests/kills.sh "$kills" "$build"
stage helpers-openvdb "$build/bin/test_openvdb" "the file is blamed*,no fork*"
stage helpers-tetgen "$build/bin/test_tetgen" "the surface is not blamed*"
stage damaged-vdb "$build/bin/test_openvdb" "truncated and damaged*"
stage damaged-pcd "$build/bin/test_pcl" "bad pcd*"
stage faults "$build/bin/test_cli" "[faults]"
stage packages tests/package.sh "$build" "$build/tests/package"
stage fuzzers fuzz

echo "| what | how often | found |"
echo "|---|---|---|"
sed -n "s/^\([a-z_]*\): \(.* inputs, .* edges\), \(.*\)$/| fuzzer \`\1\`, $seconds s | \2 | \3 |/p" \
  "$kept/fuzzers.out"
for name in kills helpers-openvdb helpers-tetgen damaged-vdb damaged-pcd faults packages; do
  how="$(tail -3 "$kept/$name.out" | grep . | tail -1)"
  verdict="no finding"
  if [ "$(cat "$kept/$name.code")" != 0 ]; then verdict="FINDING, see $kept/$name.out"; fi
  if [ "$name" = kills ]; then name="kills, $kills an output"; fi
  echo "| $name | $how | $verdict |"
done
grep -q FINDING "$kept"/fuzzers.out && exit 1
for code in "$kept"/*.code; do [ "$(cat "$code")" = 0 ] || exit 1; done
