#!/bin/sh
# All pairs of a surface: how long, how exact, how much memory.
#   bench/all_pairs.sh TOOL SURFACE [OUT]
# TOOL is the plexway program, SURFACE a file it reads; OUT a folder for what it writes (a new one).
# Rows are a sample where all would take long; the time of all is what the tool estimates.
# Where python3 has scipy, Dijkstra along edges solves the same rows beside it.
set -eu
tool="$1"
surface="$2"
out="${3:-$(mktemp -d)}"
mkdir -p "$out"
rows="${ROWS:-500}"

echo "== all x all, estimated"
"$tool" pairs "$surface" --sources all --out "$out/all.npy" --estimate
echo "== $rows rows x all"
vertices="$("$tool" info "$surface" --json | python3 -c 'import json,sys; print(json.load(sys.stdin)["vertices"])')"
python3 -c "
n, k = $vertices, min($rows, $vertices)
print(*(i * (n // k) for i in range(k)), sep='\n')" >"$out/rows.txt"
/usr/bin/time -f 'resident %M kB, %e s' \
  "$tool" pairs "$surface" --sources "$out/rows.txt" --out "$out/rows.npy" --threads "${THREADS:-2}"
echo "== what is near, by radius"
for edges in 2 4 8 16; do
  radius="$("$tool" info "$surface" --json | python3 -c "
import json,sys
print($edges * json.load(sys.stdin)['mean_edge'])")"
  "$tool" pairs "$surface" --sources "$out/rows.txt" --radius "$radius" --out "$out/near.npz" --json |
    python3 -c "
import json,sys
j = json.load(sys.stdin)
print('%2d edges: %8d entries, %.3g s, %.3g us an entry' %
      ($edges, j['entries'], j['seconds'], 1e6 * j['seconds'] / j['entries']))"
done
python3 - "$surface" "$out" <<'PEER' || echo "no peer: python3 has no scipy or meshio"
import sys, time
import numpy as np, scipy.sparse as sp, scipy.sparse.csgraph as graph, meshio
mesh = meshio.read(sys.argv[1])
p, t = mesh.points, mesh.cells_dict["triangle"]
e = np.unique(np.sort(np.vstack([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]]), axis=1), axis=0)
w = np.linalg.norm(p[e[:, 0]] - p[e[:, 1]], axis=1)
g = sp.csr_matrix((w, (e[:, 0], e[:, 1])), shape=(len(p), len(p)))
rows = np.loadtxt(sys.argv[2] + "/rows.txt", dtype=int)
start = time.perf_counter()
d = graph.dijkstra(g, directed=False, indices=rows)
seconds = time.perf_counter() - start
ours = np.load(sys.argv[2] + "/rows.npy")
some = np.isfinite(d) & (d > 0)
print("== scipy's Dijkstra along edges, one thread: %.3g s for %d rows, longer than ours by %.2g on average"
      % (seconds, len(rows), np.mean(d[some] / ours[some] - 1)))
PEER
