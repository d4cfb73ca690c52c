#!/usr/bin/env python3
"""VTP (Qin et al. 2016), the authors' program: a run a source, `VTP -m X.obj -s ID -o X.txt`."""
import os
import subprocess
import sys
import tempfile

from common import arguments, read_text, write

program, domain, sources, out = arguments(4)
with open(domain, encoding="ascii") as file:
    count = sum(line.startswith("v ") for line in file)


def row(source, answer):
    if os.path.exists(answer):
        os.remove(answer)
    done = subprocess.run([program, "-m", domain, "-s", str(source), "-o", answer], stdout=subprocess.DEVNULL)
    if done.returncode or not os.path.exists(answer):
        sys.exit(f"{os.path.basename(program)} ended with {done.returncode} and "
                 f"{'an' if os.path.exists(answer) else 'no'} answer")
    return read_text(answer, count)


with tempfile.TemporaryDirectory() as folder:
    write(out, (row(source, os.path.join(folder, "d.txt")) for source in sources))
