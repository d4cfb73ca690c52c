#!/bin/sh
# Fuzzers, one at a time (clang, libFuzzer, AddressSanitizer, UndefinedBehaviorSanitizer):
#   tests/fuzz.sh [seconds [folder of the build [seconds in all]]]
# A folder that is configured, with PLEXWAY_FUZZ, is taken as it is.
# Each runs for so many seconds, once; where `seconds in all` is given, in turns until they are up,
# the one that ran least so far first, so the same command goes on where it ended. An hour of each:
#   tests/fuzz.sh 3600
#
# What they try that is new stays in FOLDER/found/<format>; what breaks a promise lies there, too,
# as crash-* or timeout-*, and belongs into tests/fuzz/corpus/<format> once it is mended. A line for
# each run, also in <format>.runs: seconds of the processor, inputs, edges, finding or none.
#
# With CI set they draw the same each time, so that a change is judged by what it changed.
#
# PLEXWAY_FUZZ_TOOL=ON: argument lines, too, for which the tool is built.
set -eu
cd "$(dirname "$0")/.."
seconds="${1:-3600}"
folder="${2:-build/fuzz}"
in_all="${3:-0}"
if [ ! -f "$folder/CMakeCache.txt" ]; then
  .ci/configure "$folder" -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_FLAGS_DEBUG=-O1 -g1" \
    -DCMAKE_CXX_COMPILER=clang++ -DPLEXWAY_FUZZ=ON "-DPLEXWAY_SANITIZE=address;undefined" \
    -DPLEXWAY_BUILD_TOOL=OFF -DPLEXWAY_BUILD_TESTS=OFF \
    -DPLEXWAY_BUILD_BENCH=OFF -DPLEXWAY_BUILD_EXAMPLES=OFF \
    -DPLEXWAY_WITH_OPENVDB=OFF -DPLEXWAY_WITH_PCL=OFF -DPLEXWAY_WITH_GL=OFF \
    -DPLEXWAY_WITH_FLANN=OFF -DPLEXWAY_WITH_BOOST_GRAPH=OFF >/dev/null
fi
if [ "${PLEXWAY_FUZZ_TOOL:-OFF}" = ON ]; then
  cmake -DPLEXWAY_BUILD_TOOL=ON "$folder" >/dev/null
fi
cmake --build "$folder" --parallel "$(nproc)" --target plexway_fuzzers
folder="$(realpath "$folder")"  # that of argument lines moves to a folder of its own
until="$(($(date +%s) + in_all))"
ran=" "
failed=" "

names() {
  for program in "$folder"/bin/fuzz_*; do
    name="${program##*/fuzz_}"
    if [ "$name" != arguments ] || [ "${PLEXWAY_FUZZ_TOOL:-OFF}" = ON ]; then echo "$name"; fi
  done
}

# The one that ran least, of those that may run once more; nothing if there is none.
next() {
  for name in $(names); do
    case "$failed" in *" $name "*) continue ;; esac
    if [ "$in_all" = 0 ]; then
      case "$ran" in *" $name "*) continue ;; esac
    fi
    touch "$folder/found/$name.runs"
    awk -v name="$name" '{ sum += $1 } END { print sum + 0, name }' "$folder/found/$name.runs"
  done | sort -n | sed -n '1s/.* //p'
}

mkdir -p "$folder/found"
while [ "$in_all" = 0 ] || [ "$(($(date +%s) + seconds))" -le "$until" ]; do
  name="$(next)"
  [ -n "$name" ] || break
  found="$folder/found/$name"
  mkdir -p "$found"
  log="$found.log"
  verdict=none
  # What holds a reader's memory together must not depend on how long its text is.
  (
    code=0
    "$folder/bin/fuzz_$name" -max_total_time="$seconds" -timeout=25 -rss_limit_mb=3000 \
      -max_len=4096 ${CI:+-seed=1} -artifact_prefix="$found/" "$found" "$PWD/tests/fuzz/corpus/$name" \
      >"$log" 2>&1 || code=$?
    times >"$found.time"
    exit $code
  ) || verdict=FINDING
  # libFuzzer's clock runs on while others compute: what it found slow runs again by itself, for as
  # many seconds of the processor.
  if [ "$verdict" = FINDING ] && grep -q '^SUMMARY: libFuzzer: timeout' "$log"; then
    slow="$(sed -n 's/.*Test unit written to //p' "$log" | tail -1)"
    if (
      # Dash and bash have it.
      # shellcheck disable=SC3045
      ulimit -t 25
      "$folder/bin/fuzz_$name" -timeout=0 "$slow" >>"$log" 2>&1
    ); then
      rm "$slow"
      verdict=none
    fi
  fi
  cpu="$(tail -1 "$found.time" | tr 'ms' '  ' | awk '{ printf "%.1f", 60 * ($1 + $3) + $2 + $4 }')"
  inputs="$(sed -n 's/^#\([0-9]*\)\t.*/\1/p' "$log" | tail -1)"
  edges="$(sed -n 's/.* cov: \([0-9]*\) .*/\1/p' "$log" | tail -1)"
  echo "$cpu ${inputs:-0} ${edges:-0} $verdict" >>"$found.runs"
  ran="$ran$name "
  if [ "$verdict" = FINDING ]; then
    failed="$failed$name "
    echo "$name: FINDING, see $log"
  else
    echo "$name: ${inputs:-?} inputs, ${edges:-?} edges, $cpu s, no finding"
  fi
done
[ "$failed" = " " ]
