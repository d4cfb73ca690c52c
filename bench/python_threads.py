"""Rows on threads, from Python: one thread and two in turns, in one process.

    PYTHONPATH=build/python python3 bench/python_threads.py FILE [SOURCES [TURNS]]

Each turn solves the same rows by one thread and by two, in changing order, and takes their ratio by the
clock; told is the middle of the ratios, and beside it how much of two processors the process got meanwhile:
on a machine that others use the ratio says nothing unless that is near 2. The memory that a thread more
takes beside its row is told, too.
"""

import resource
import statistics
import sys
import time

import numpy as np

import plexway


def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * resource.getpagesize()


def timed(surface, sources, rows, threads):
    clock, processor = time.perf_counter(), time.process_time()
    surface.distances(sources, out=rows, threads=threads, accuracy="fast")
    clock = time.perf_counter() - clock
    return clock, (time.process_time() - processor) / clock


def main(file, count=1000, turns=7):
    surface = plexway.read(file)
    n = surface.vertex_count
    sources = np.linspace(0, n - 1, int(count)).astype(int)
    rows = np.zeros((len(sources), n), np.float32)
    memory = {}
    for accuracy in ("fast", "accurate"):
        for threads in (1, 9):
            few = rows[:90]
            surface.distances(sources[:90], out=few, threads=threads, accuracy=accuracy)
            memory[accuracy, threads] = resident(), surface.info()["bytes"]
    ratios, shares = [], []
    for turn in range(int(turns)):
        order = (1, 2) if turn % 2 == 0 else (2, 1)
        found = {threads: timed(surface, sources, rows, threads) for threads in order}
        ratios.append(found[1][0] / found[2][0])
        shares.append(found[2][1])
        print(
            f"turn {turn}: one thread {found[1][0]:.3f} s (of {found[1][1]:.2f} processors), "
            f"two {found[2][0]:.3f} s (of {found[2][1]:.2f}): {ratios[-1]:.2f}"
        )
    print(
        f"{surface}, {len(sources)} rows: two threads are {statistics.median(ratios):.2f} times as "
        f"fast as one (in the middle of {len(ratios)} turns, {min(ratios):.2f} to {max(ratios):.2f}; "
        f"{statistics.median(shares):.2f} processors)"
    )
    triangles = surface.info()["simplices"]
    for accuracy in ("fast", "accurate"):
        by_system, told = (
            (more - less) / 8 for more, less in zip(memory[accuracy, 9], memory[accuracy, 1])
        )
        print(
            f"memory beside the rows, {accuracy}: {by_system / 2**20:.1f} MiB a thread more, which is "
            f"{by_system / triangles:.0f} bytes a triangle ({told / triangles:.0f} by info())"
        )


if __name__ == "__main__":
    main(*sys.argv[1:])
