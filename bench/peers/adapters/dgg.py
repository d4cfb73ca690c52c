#!/usr/bin/env python3
"""Discrete geodesic graphs (Adikusuma, Fang, He 2020), the authors' programs DGG_Precompute and DGG_Solution, which lie
in one folder; the mean error asked for is PLEXWAY_PEER_DGG_ERROR (default 0.01)."""
import glob
import os
import shutil
import subprocess
import sys
import tempfile

from common import arguments, read_text, write

programs, domain, sources, out = arguments(4)
with open(domain, encoding="ascii") as file:
    count = sum(line.startswith("v ") for line in file)


def call(folder, name, *words):
    done = subprocess.run([os.path.join(programs, name), *words], cwd=folder, stdout=subprocess.DEVNULL)
    if done.returncode:
        sys.exit(f"{name} ended with {done.returncode}")


def row(source, folder, graph):
    answer = os.path.join(folder, "d.txt")
    call(folder, "DGG_Solution", "SSAD", "mesh.obj", graph, str(source), answer)
    return read_text(answer, count)


with tempfile.TemporaryDirectory() as work:
    shutil.copy(domain, os.path.join(work, "mesh.obj"))
    call(work, "DGG_Precompute", "f", "mesh.obj", os.environ.get("PLEXWAY_PEER_DGG_ERROR", "0.01"), "1")
    graphs = glob.glob(os.path.join(work, "*.binary"))
    if len(graphs) != 1:
        sys.exit(f"DGG_Precompute left {len(graphs)} graphs")
    write(out, (row(source, work, os.path.basename(graphs[0])) for source in sources))
