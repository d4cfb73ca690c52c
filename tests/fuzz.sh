#!/bin/sh
# All fuzzers, one after the other, for so many seconds each:
#   tests/fuzz.sh [seconds [folder of the build]]
# Builds them first (clang, libFuzzer, AddressSanitizer, UndefinedBehaviorSanitizer). What they try
# that is new stays in FOLDER/found/<format>; what breaks a promise lies there too, as crash-* or
# timeout-*, and belongs into tests/fuzz/corpus/<format> once it is mended. A line for each at the end.
# An hour of each: tests/fuzz.sh 3600
#
# PLEXWAY_FUZZ_UNTIL, in seconds since 1970: begins none that would end later, and exits with 75.
# PLEXWAY_FUZZ_ON=1: passes those over that ran as long before, so a run that ended goes on.
set -eu
cd "$(dirname "$0")/.."
seconds="${1:-3600}"
folder="${2:-build/fuzz}"
.ci/configure "$folder" -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_FLAGS_DEBUG=-O1 -g1" \
  -DCMAKE_CXX_COMPILER=clang++ -DPLEXWAY_FUZZ=ON "-DPLEXWAY_SANITIZE=address;undefined" \
  -DPLEXWAY_BUILD_TOOL=OFF -DPLEXWAY_BUILD_BENCH=OFF -DPLEXWAY_BUILD_EXAMPLES=OFF \
  -DPLEXWAY_WITH_OPENVDB=OFF -DPLEXWAY_WITH_PCL=OFF -DPLEXWAY_WITH_GL=OFF \
  -DPLEXWAY_WITH_FLANN=OFF -DPLEXWAY_WITH_BOOST_GRAPH=OFF >/dev/null
cmake --build "$folder" --parallel "$(nproc)" --target plexway_fuzzers
failed=0
for program in "$folder"/bin/fuzz_*; do
  format="${program##*/fuzz_}"
  found="$folder/found/$format"
  mkdir -p "$found"
  log="$found.log"
  line="$found.line"
  if [ "${PLEXWAY_FUZZ_ON:-0}" = 1 ] && [ -f "$line" ] &&
    [ "$(sed -n 1p "$line")" -ge "$seconds" ]; then
    sed -n 2p "$line"
    grep -q FINDING "$line" && failed=1
    continue
  fi
  if [ -n "${PLEXWAY_FUZZ_UNTIL:-}" ] &&
    [ "$(($(date +%s) + seconds))" -gt "$PLEXWAY_FUZZ_UNTIL" ]; then
    exit 75
  fi
  # What holds a reader's memory together must not depend on how long its text is.
  if "$program" -max_total_time="$seconds" -timeout=25 -rss_limit_mb=3000 -max_len=4096 \
    -print_final_stats=1 -artifact_prefix="$found/" "$found" "tests/fuzz/corpus/$format" \
    >"$log" 2>&1; then
    verdict="no finding"
  else
    verdict="FINDING, see $log"
    failed=1
  fi
  runs="$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")"
  edges="$(sed -n 's/.* cov: \([0-9]*\) .*/\1/p' "$log" | tail -1)"
  said="$format: ${runs:-?} inputs, ${edges:-?} edges, $verdict"
  printf '%s\n%s\n' "$seconds" "$said" >"$line"
  echo "$said"
done
exit $failed
