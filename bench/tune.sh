#!/bin/sh
# Makes the training and the validation set with their exact answers, tunes on the one and judges by
# the other: everything docs/log/tuning.md says. Needs bench_cgal, so CGAL, for the answers.
#
#   bench/tune.sh BUILD OUT [SCANS]
#
# BUILD: the build folder. OUT: where sets and results go; sets that are there are taken as they are.
# SCANS: a folder of .obj with NAME.vID.txt beside them, to judge by as well. The bunny of
# data/fetch.sh is in the training set where it was fetched; one named bunny.obj is not judged by.
# QUICK=1: few evaluations, to see that everything runs. SETS_ONLY=1: no tuning, only the judging.
set -eu

if [ $# -lt 2 ] || [ $# -gt 3 ]; then
  sed -n '5,11s/^# \{0,1\}//p' "$0" >&2
  exit 2
fi
bin=$1/bin
out=$2
scans=${3:-}
here=$(dirname "$0")

mkdir -p "$out"
for set in training validation; do
  [ ! -d "$out/$set" ] || continue
  rm -rf "$out/$set.part"
  "$bin/bench" tuning_set $set "$out/$set.part" > "$out/$set.txt"
  if [ $set = training ] && [ -e "$here/../data/fetched/bunny.obj" ]; then
    cp "$here/../data/fetched/bunny.obj" "$out/$set.part/"
  fi
  "$bin/bench_cgal" truth "$out/$set.part"/*.obj
  mv "$out/$set.part" "$out/$set"
done

if [ "${QUICK:-0}" = 1 ]; then
  table="--evaluations 20 --restarts 2"
  saddles="--evaluations 10"
  effort="--sources 2 --repeats 1 --budget 1"
else
  table="--evaluations 300 --restarts 3"
  saddles="--evaluations 250 --restarts 2"
  effort="--sources 12 --repeats 3"
fi
# shellcheck disable=SC2086
if [ "${SETS_ONLY:-0}" != 1 ]; then
  "$bin/plexway" tune "$out"/training/*.obj --seed 2 $table \
    --out "$out/table.json" --cpp "$out/table.inc" --checkpoint "$out/table.checkpoint"
  "$bin/plexway" tune "$out"/training/*.obj --what saddles --from standard --triangulation auto \
    --seed 1 $saddles --out "$out/saddles.json" --cpp "$out/saddles.inc"
fi

# What is built in, and beside it what was found now.
found=
[ ! -e "$out/table.json" ] || found="--table $out/table.json"
# shellcheck disable=SC2086
{
  "$bin/bench" validation "$out"/validation/*.obj $found $effort --markdown "$out/validation.md" \
    --json > "$out/validation.json"
  [ ! -e "$out/saddles.json" ] ||
    "$bin/bench" validation "$out"/validation/*.obj --saddles "$out/saddles.json" $effort \
      --markdown "$out/validation_saddles.md" --json > "$out/validation_saddles.json"
  if [ -n "$scans" ]; then
    set --
    for scan in "$scans"/*.obj; do
      [ "$(basename "$scan")" = bunny.obj ] || set -- "$@" "$scan"
    done
    "$bin/bench" validation "$@" $found $effort --markdown "$out/scans.md" --json > "$out/scans.json"
  fi
}
grep '^| all' "$out"/*.md
