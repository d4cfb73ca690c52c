#!/bin/sh
# All fuzzers, one after the other, for so many seconds each:
#   tests/fuzz.sh [seconds [folder of the build]]
# Builds them first (clang, libFuzzer, AddressSanitizer, UndefinedBehaviorSanitizer). What they try
# that is new stays in FOLDER/found/<format>; what breaks a promise lies there too, as crash-* or
# timeout-*, and belongs into tests/fuzz/corpus/<format> once it is mended. A line for each at the end.
# An hour of each: tests/fuzz.sh 3600
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
  echo "$format: ${runs:-?} inputs, ${edges:-?} edges, $verdict"
done
exit $failed
