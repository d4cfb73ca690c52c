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

# run NAME "OPTIONS" "OPTIONS IF QUICK" [FILES...]: the JSON is the measurement, the Markdown a view
# of it. Options are words of their own.
# shellcheck disable=SC2086
run() {
  name=$1
  options=$2
  [ "${QUICK:-0}" != 1 ] || options=$3
  shift 3
  echo "== $name" >&2
  program=$bin/bench
  [ "$name" != peers ] || [ ! -x "$bin/bench_cgal" ] || program=$bin/bench_cgal
  "$program" "${name%%-*}" "$@" $options --markdown "$out/$name.md" --json > "$out/$name.json"
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

few="--sources 2 --repeats 1 --budget 1"
solids=
[ -z "$data" ] || [ ! -d "$data/../solids" ] || solids=$data/../solids
run peers "--sources 16" "$few --limit 60 --exact-limit 2000" "$@"
run surfaces "--triangles input,delaunay,refined" "$few" "$@"
run surfaces-windows "--compared 40 --random --by fast,accurate" "$few --compared 2" "$@"
run surfaces-labels "--by fast,plain,centroid,tuned,published,upper_bound,fifo,priority --against fast" \
  "$few --by fast,plain" "$@"
run surfaces-made "--make bumpy:50000,bumpy:400000,bumpy:1000000,wavy:500000 --triangles input,delaunay" \
  "$few --make bumpy:5000,wavy:5000"
run surfaces-torus "--make torus:800,torus:3200,torus:12800,torus:51200,torus:204800 --compared 3 --by fast,accurate" \
  "$few --make torus:800 --compared 1"
run surfaces-flat "--make corners:50,corners:400,strip:1000,strip:100000" "$few --make corners:50"
run executors "" "--sizes 5000 --repeats 1 --batch 4" "$@"
run build "" "--sizes 20000 --repeats 1" "$@"
run convergence "" "--only cube"
run dimensions "" "--draws 2"
run random_plans "" "--plans 2"
run metrics "" "--cells 20,50"
run many_sources "" "--sides 50 --repeats 1"
run curves "" "--cells 30 --turns 1"
run mixed "" "--cells 6"
run paths "" "--bounded"
run solids "--sizes 12,26,70" "--sizes 8 $few" $solids
run wireframes "" "--size 0.1 $few"
run clouds "--generated 100000" "--generated 2000 $few"
echo "$out: $(cd "$out" && ls | tr '\n' ' ')"
