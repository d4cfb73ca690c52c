#!/usr/bin/env python3
"""What the corpora of all fuzzers reach, those of the repository and those found so far:
    tests/fuzz_coverage.py [folder of the fuzzers' build]
Prints a table in Markdown: of each reader, and of each folder of the rest, how many functions were
entered and how many of the edges that sanitizers see were taken. Many edges are those of exceptions
that unwind and of the sanitizers' own checks, so all of them are never taken. A function counts with
the most that any one fuzzer reaches of it. Needs llvm-symbolizer.
"""

import collections
import os
import pathlib
import re
import subprocess
import sys

root = pathlib.Path(__file__).resolve().parent.parent
folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else root / "build/fuzz").resolve()
line_of = re.compile(r"^(UN)?COVERED_FUNC: hits: \d+ edges: (\d+)/(\d+) (.*) (\S+):(\d+)$")
ours = re.compile(r".*?/((?:src|complexes|include/plexway)/.*)$")

reached = {}  # by function: edges taken, edges
for program in sorted((folder / "bin").glob("fuzz_*")):
    name = program.name.removeprefix("fuzz_")
    inputs = [d for d in (folder / "found" / name, root / "tests/fuzz/corpus" / name) if d.is_dir()]
    run = subprocess.run([program, "-runs=0", "-print_coverage=1", *inputs], cwd=folder,
                         stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                         stderr=subprocess.PIPE, errors="replace", check=False)
    if run.returncode != 0:
        print(f"fuzz_{name} ended with {run.returncode}", file=sys.stderr)
    for line in run.stderr.splitlines():
        found = line_of.match(line)
        place = found and ours.match(os.path.normpath(found[5]))
        if not place:
            continue
        key = (place[1], found[6], found[4])
        taken, edges = reached.get(key, (0, 0))
        reached[key] = (max(taken, int(found[2])), max(edges, int(found[3])))


def group(file):
    path = pathlib.PurePosixPath(file)
    if file.startswith("src/io/") and path.suffix == ".cpp":
        return f"`{file}`"
    if file.startswith("complexes/"):
        return f"`{file}`"
    return f"`{path.parent}`"


sums = collections.defaultdict(lambda: [0, 0, 0, 0])
for (file, _, _), (taken, edges) in reached.items():
    row = sums[group(file)]
    row[0] += taken > 0
    row[1] += 1
    row[2] += taken
    row[3] += edges

print("| what | functions | entered | edges | taken |")
print("|---|---|---|---|---|")
for name, (entered, functions, taken, edges) in sorted(sums.items()):
    if entered:
        print(f"| {name} | {functions} | {100 * entered / functions:.0f} % "
              f"| {edges} | {100 * taken / edges:.0f} % |")
