#!/usr/bin/env python3
"""Parallel VTP (Du et al. 2021), the authors' program: a run a source, `-alg 1 -m X.obj -s ID -np N -o`, which writes
beside X.obj. PLEXWAY_PEER_THREADS is N (default 1)."""
import glob
import os
import shutil
import subprocess
import sys
import tempfile

from common import arguments, read_text, write

program, domain, sources, out = arguments(4)
with open(domain, encoding="ascii") as file:
    count = sum(line.startswith("v ") for line in file)


def row(source, folder):
    mesh = os.path.join(folder, "mesh.obj")
    done = subprocess.run([program, "-alg", "1", "-m", mesh, "-s", str(source), "-np",
                           os.environ.get("PLEXWAY_PEER_THREADS", "1"), "-o"], cwd=folder,
                          stdout=subprocess.DEVNULL)
    answers = glob.glob(os.path.join(folder, f"mesh_source{source}_*result.txt"))
    if done.returncode or len(answers) != 1:
        sys.exit(f"{os.path.basename(program)} ended with {done.returncode} and {len(answers)} answers")
    return read_text(answers[0], count)


with tempfile.TemporaryDirectory() as work:
    shutil.copy(domain, os.path.join(work, "mesh.obj"))
    write(out, (row(source, work) for source in sources))
