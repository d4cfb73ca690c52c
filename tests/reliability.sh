#!/bin/sh
# The table of docs/log/reliability.md, made again:
#   tests/reliability.sh MINUTES [kills of each output [folder of the build [seconds a turn]]]
# The build must have the tool and the tests. First kills, helpers that fail, damaged files and the
# packages; then fuzzers in turns until the minutes are up, which begin none that would end later.
# The same command goes on: a stage that ran to its end is not run again, and the fuzzer that ran
# least is the next. An hour of each fuzzer are about 1,900 minutes, in any portions.
#
# What each stage said is kept in FOLDER/reliability, what fuzzers did in FOLDER/fuzz/found; without
# these two all begins anew. At the end: one table, in Markdown, and a line where a finding is.
set -eu
cd "$(dirname "$0")/.."
minutes="${1:?tests/reliability.sh MINUTES [kills [folder of the build [seconds a turn]]]}"
kills="${2:-100}"
build="${3:-build}"
turn="${4:-60}"
until="$(($(date +%s) + 60 * minutes))"
kept="$build/reliability"
found="$build/fuzz/found"
mkdir -p "$kept"
late=0

# stage NAME COMMAND...: runs it unless it ran before; its output is kept, and how it ended.
stage() {
  name="$1"
  shift
  if [ -f "$kept/$name.code" ]; then return; fi
  if [ "$(date +%s)" -ge "$until" ]; then
    late=1
    return
  fi
  echo "== $name" >&2
  code=0
  "$@" >"$kept/$name.out" 2>&1 || code=$?
  echo "$code" >"$kept/$name.code"
}

stage kills tests/kills.sh "$kills" "$build"
stage helpers-openvdb "$build/bin/test_openvdb" --warn NoTests "the file is blamed*,no fork*"
stage helpers-tetgen "$build/bin/test_tetgen" --warn NoTests "the surface is not blamed*"
stage damaged-vdb "$build/bin/test_openvdb" --warn NoTests "truncated and damaged*"
stage damaged-pcd "$build/bin/test_pcl" --warn NoTests "bad pcd*"
stage faults "$build/bin/test_tool" --warn NoTests "faults:*"
stage packages tests/package.sh "$build" "$build/tests/package"

left="$((until - $(date +%s)))"
if [ "$left" -ge "$turn" ]; then
  echo "== fuzzers, for $((left / 60)) min" >&2
  PLEXWAY_FUZZ_TOOL=ON tests/fuzz.sh "$turn" "$build/fuzz" "$left" >"$kept/fuzzers.out" 2>&1 || true
fi

failed=0
echo "| what | how often | found |"
echo "|---|---|---|"
for name in kills helpers-openvdb helpers-tetgen damaged-vdb damaged-pcd faults packages; do
  [ -f "$kept/$name.code" ] || continue
  how="$(tail -3 "$kept/$name.out" | grep . | tail -1)"
  verdict="nothing"
  if [ "$(cat "$kept/$name.code")" != 0 ]; then
    verdict="FINDING, see $kept/$name.out"
    failed=1
  fi
  if [ "$name" = kills ]; then name="kills, $kills of each output"; fi
  echo "| $name | $how | $verdict |"
done
echo
echo "| output | kills | too late | temporary files left | half files | helpers left |"
echo "|---|---|---|---|---|---|"
sed -n 's/^kills of \(.*\): \(.*\) ended it, \(.*\) too late; temporary files \(.*\), half files \(.*\), helpers \(.*\)$/| `\1` | \2 | \3 | \4 | \5 | \6 |/p' \
  "$kept/kills.out" 2>/dev/null || true
echo
echo "| fuzzer | seconds | inputs | edges reached | found | seconds since |"
echo "|---|---|---|---|---|---|"
for runs in "$found"/*.runs; do
  [ -s "$runs" ] || continue
  awk -v name="$(basename "$runs" .runs)" '
    { time += $1; inputs += $2; if ($3 > edges) edges = $3; since += $1 }
    $4 != "none" { ++findings; since = 0 }
    END { printf "| `%s` | %d | %d | %d | %s | %d |\n", name, time, inputs, edges,
                 findings ? findings : "nothing", since }' "$runs"
  tail -1 "$runs" | grep -q FINDING && failed=1
done
if [ -f "$found/arguments.log" ]; then
  echo
  echo "| command | lines, last run | done (code 0) | refused |"
  echo "|---|---|---|---|"
  sed -n 's/^lines of \([^:]*\): \([0-9]*\), \([0-9]*\) of them with code 0, \([0-9]*\) refused$/| `\1` | \2 | \3 | \4 |/p' \
    "$found/arguments.log"
fi
if [ "$failed" = 0 ] && [ "$late" = 1 ]; then
  echo "reliability: time was up before all was tried; the same command goes on" >&2
  exit 75
fi
exit $failed
