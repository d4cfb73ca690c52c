#!/bin/sh
# Runs the benchmarks that are built and writes their tables (.md and .json) to a folder. Builds
# nothing.
#
#   bench/run.sh BUILD OUT [DATA]
#
# BUILD: the build folder. OUT: where the tables go. DATA: a folder of meshes (.obj) with their
# exact answers NAME.vID.txt beside them; without it, samples are measured. Solids (.node, .ele) with
# theirs are looked for in DATA/../solids.
# QUICK=1: few repeats, to see that everything runs.
set -eu

if [ $# -lt 2 ] || [ $# -gt 3 ]; then
  sed -n '5,10s/^# \{0,1\}//p' "$0" >&2
  exit 2
fi
bin=$1/bin
out=$2
data=${3:-}
samples=$(dirname "$0")/../data

if [ "${QUICK:-0}" = 1 ]; then
  effort="--sources 3 --repeats 1 --budget 1 --limit 60"
  exact="--exact-limit 2000"
  scale="--sizes 5000,20000 $effort"
  triangulation="--sizes 20000"
  build="--sizes 20000 --repeats 1"
  corners="--most 100 --seeds 1"
  metrics="--cells 20,50"
  curves="--cells 30 --turns 1"
  solid_sizes="--sizes 8 --sources 2 --repeats 1 --budget 1"
  gl="--sizes 10000 --batch 8 --repeats 1"
  wires="--size 0.1 --sources 2 --repeats 1 --budget 1"
  many="--sides 50 --repeats 1"
  teams="--vertices 20000 --batch 8 --batch-vertices 5000 --repeats 1 --sizes 5000 --chunks 128"
else
  effort="--sources 16 --repeats 3"
  exact=""
  scale=""
  triangulation=""
  build=""
  corners=
  metrics=
  curves=
  solid_sizes="--sizes 12,26,70"
  wires=""
  many=""
  teams=""
  gl="--sizes 50000,1000000"
fi

mkdir -p "$out"
if [ -n "$data" ]; then
  set -- "$data"/*.obj
else
  set -- "$samples"/knot.ply "$samples"/hills.off "$samples"/torus.obj
fi
if [ ! -e "$1" ]; then
  echo "$data: no .obj in it" >&2
  exit 3
fi

# run NAME PROGRAM ARGUMENTS...: the JSON is the measurement, the Markdown a view of it.
run() {
  name=$1
  shift
  echo "== $name" >&2
  "$@" --markdown "$out/$name.md" --json > "$out/$name.json"
}

cxx=$(sed -n 's/^CMAKE_CXX_COMPILER:[^=]*=//p' "$bin/../CMakeCache.txt")
{
  echo "date: $(date -u +%Y-%m-%d)"
  echo "processor: $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo 2>/dev/null | head -n 1)"
  echo "cores: $(getconf _NPROCESSORS_ONLN)"
  echo "memory: $(sed -n 's/^MemTotal: *//p' /proc/meminfo 2>/dev/null)"
  echo "compiler: $("$cxx" --version 2>/dev/null | head -n 1)"
  echo "build type: $(sed -n 's/^CMAKE_BUILD_TYPE:[^=]*=//p' "$bin/../CMakeCache.txt")"
  echo "native: $(sed -n 's/^PLEXWAY_NATIVE:[^=]*=//p' "$bin/../CMakeCache.txt")"
  echo "load at start: $(cut -d ' ' -f 1 /proc/loadavg 2>/dev/null)"
} > "$out/machine.txt"

peers=$bin/bench_cgal
[ -x "$peers" ] || peers=$bin/bench
# The arguments in $effort and its like are words of their own.
# shellcheck disable=SC2086
{
  run peers "$peers" peers "$@" $effort $exact
  run policy "$bin/bench" policy "$@" $effort
  run triangulation "$bin/bench" triangulation "$@" $triangulation $effort
  run windows "$bin/bench" windows "$@" $effort
  run window_sources "$bin/bench" window_sources "$@" --sources 40
  run window_refinement "$bin/bench" window_refinement
  run build "$bin/bench" build "$@" $build
  [ -z "$data" ] || run parity "$bin/bench" parity "$@"
  run corners "$bin/bench" corners $corners
  run dimensions "$bin/bench" dimensions
  run random_plans "$bin/bench" random_plans
  run metrics "$bin/bench" metrics $metrics
  run curves "$bin/bench" curves $curves
  # Two good scans, cut into four until they have a million vertices; otherwise the sphere alone.
  set --
  for scan in bunny armadillo; do
    [ ! -e "$data/$scan.obj" ] || set -- "$@" "$data/$scan.obj"
  done
  run scale "$bin/bench" scale "$@" $scale
  run scale_shuffled "$bin/bench" scale --shuffle $scale
  run refinement "$bin/bench" refinement --parts 100,400,800
  run strips "$bin/bench" strips
  run many_sources "$bin/bench" many_sources $many
  solids=
  [ -z "$data" ] || [ ! -d "$data/../solids" ] || solids=$data/../solids
  run solids "$bin/bench" solids $solids $solid_sizes
  run wireframes "$bin/bench" wireframes $wires
  run executors "$bin/bench" executors $teams
  # Only where a device is found.
  ! "$bin/plexway" info --devices 2>/dev/null | grep -q '^gl [0-9]' ||
    run gl "$bin/bench" gl $gl
}
echo "$out: $(cd "$out" && ls | tr '\n' ' ')"
