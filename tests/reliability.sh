#!/bin/sh
# The figures of docs/RELIABILITY.md, made again:
#   tests/reliability.sh [seconds a fuzzer [kills a kind of output [folder of the build]]]
# The build must have the tool and the tests.
set -eu
cd "$(dirname "$0")/.."
seconds="${1:-3600}"
kills="${2:-100}"
build="${3:-build}"
echo "== fuzzers, $seconds s each"
tests/fuzz.sh "$seconds" || true
echo "== kills, $kills of each kind of output"
tests/kills.sh "$kills" "$build" | tail -1
echo "== helpers that crash, are killed, run out of memory, are missing"
"$build/bin/test_openvdb" "the file is blamed*" | tail -1
"$build/bin/test_openvdb" "no fork*" | tail -1
"$build/bin/test_tetgen" "the surface is not blamed*" | tail -1
echo "== damaged files of libraries (.vdb, .pcd)"
"$build/bin/test_openvdb" "truncated and damaged*" | tail -1
"$build/bin/test_pcl" "*" | tail -1
echo "== packages"
tests/package.sh "$build" "$build/tests/package" | tail -1
