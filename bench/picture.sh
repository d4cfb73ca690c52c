#!/bin/sh
# How long a picture of two million triangles takes: with reading, distances and writing, and the
# same without the picture. The best of three.
#
#   bench/picture.sh BUILD
#
# LIBGL_ALWAYS_SOFTWARE=1 takes Mesa's llvmpipe where there is a graphics processor.
set -eu
[ $# -eq 1 ] || { sed -n '5p' "$0" | sed 's/^# *//' >&2; exit 2; }
bin=$1/bin
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
"$bin/plexway_generate_data" "$dir" bumpy-400k bumpy-1m > /dev/null

# Milliseconds of the quickest of three runs.
best() {
  least=
  for _ in 1 2 3; do
    start=$(date +%s%N)
    "$@" > /dev/null
    spent=$((($(date +%s%N) - start) / 1000000))
    if [ -z "$least" ] || [ "$spent" -lt "$least" ]; then least=$spent; fi
  done
  echo "$least"
}

echo "| triangles | without a picture, ms | with one, ms | the picture, ms |"
echo "| ---: | ---: | ---: | ---: |"
for sample in "bumpy-400k 800000" "bumpy-1m 1997120"; do
  file=$dir/${sample% *}.ply
  without=$(best "$bin/plexway" distance "$file" --source vertex:0 --quiet)
  with=$(best "$bin/plexway" distance "$file" --source vertex:0 --quiet --picture "$dir/a.png")
  echo "| ${sample#* } | $without | $with | $((with - without)) |"
done
