#!/usr/bin/env python3
"""All pairs of a surface: how long, how much memory.

    bench/all_pairs.py TOOL radius             within a radius on a million vertices
    bench/all_pairs.py TOOL memory             100,000 columns: resident memory by rows

TOOL is the plexway program. Times are of the processor (user and system, threads together), each the
least of three turns and with the time to read the surface taken off, so that they mean something on
a machine that others use too. Beside other programs: bench/peers/run, whose time of each further source is a row.
"""
import json
import os
import resource
import subprocess
import sys
import tempfile

import numpy as np

TURNS = int(os.environ.get("TURNS", "3"))


def processor_time(words, **more):
    """Seconds of user and system time of a child, and its output."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(words, check=True, capture_output=True, text=True, **more)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return (after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime), done.stdout


def least(run):
    found = [run() for _ in range(TURNS)]
    return min(seconds for seconds, _ in found), found[0][1]


def resident(words):
    """The most memory that a child had at once, in bytes."""
    child = subprocess.Popen(words, stdout=subprocess.DEVNULL)
    _, status, used = os.wait4(child.pid, 0)
    if status != 0:
        sys.exit(f"{words[0]} failed")
    return 1024 * used.ru_maxrss


def hills(n, name):
    """A height field of n x n vertices, as binary .ply."""
    x, y = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n))
    z = 0.02 * (np.sin(37 * x + 5 * y) + np.cos(29 * y - 11 * x))
    points = np.stack([x, y, z], axis=-1).reshape(-1, 3).astype("<f4")
    v = np.arange(n * n).reshape(n, n)
    a, b, c, d = v[:-1, :-1], v[:-1, 1:], v[1:, :-1], v[1:, 1:]
    corners = np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3),
                              np.stack([b, d, c], -1).reshape(-1, 3)]).astype("<i4")
    faces = np.zeros(len(corners), dtype=[("count", "u1"), ("corner", "<i4", 3)])
    faces["count"], faces["corner"] = 3, corners
    with open(name, "wb") as file:
        file.write((f"ply\nformat binary_little_endian 1.0\nelement vertex {n * n}\n"
                    "property float x\nproperty float y\nproperty float z\n"
                    f"element face {len(corners)}\nproperty list uchar int vertex_indices\n"
                    "end_header\n").encode())
        file.write(points.tobytes())
        file.write(faces.tobytes())


def hills_and_rows(folder, n, vertices):
    """Such a surface, and a list of these vertices: two files."""
    surface, rows = (os.path.join(folder, name) for name in ("hills.ply", "rows.txt"))
    hills(n, surface)
    np.savetxt(rows, vertices, fmt="%d")
    return surface, rows


def radius(tool):
    n, rows = 1000, 400
    some = np.random.default_rng(1).choice(n * n, rows, replace=False)
    with tempfile.TemporaryDirectory() as folder:
        surface, sources = hills_and_rows(folder, n, some)
        print(f"{n * n} vertices, {rows} rows\n")
        print("| radius in edges | entries a row | processor us a row | ns an entry |\n|---|---|---|---|")

        def run(reach):
            out = os.path.join(folder, "d.npz")
            seconds, text = processor_time([tool, "pairs", surface, "--sources", sources, "--radius",
                                            str(reach / (n - 1)), "--out", out, "--threads", "1",
                                            "--accuracy", "fast", "--json"])
            return seconds, json.loads(text)["entries"]
        reading, _ = least(lambda: run(0))
        for reach in (2, 4, 8, 16, 32, 64):
            seconds, entries = least(lambda: run(reach))
            seconds -= reading
            print(f"| {reach} | {entries / rows:.4g} | {1e6 * seconds / rows:.3g} |"
                  f" {1e9 * seconds / entries:.3g} |", flush=True)


def memory(tool):
    n = 317
    print(f"{n * n} columns, two threads\n\n| rows | resident MB |\n|---|---|")
    for rows in (50, 200, 800):
        with tempfile.TemporaryDirectory() as folder:
            surface, sources = hills_and_rows(folder, n, np.arange(rows) * (n * n // rows))
            used = resident([tool, "pairs", surface, "--sources", sources, "--out",
                             os.path.join(folder, "d.npy"), "--threads", "2", "--accuracy", "fast",
                             "--quiet"])
            print(f"| {rows} | {used / 1e6:.4g} |", flush=True)


if __name__ == "__main__":
    what = {"radius": radius, "memory": memory}
    if len(sys.argv) < 3 or sys.argv[2] not in what:
        sys.exit(__doc__)
    what[sys.argv[2]](sys.argv[1], *sys.argv[3:])
