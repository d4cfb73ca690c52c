"""What Python costs beside C++: a call, building from arrays, rows on threads.

    PYTHONPATH=build/python python3 python/bench/overhead.py [FILE]

A call: k calls of `distance` beside the same k solves in one call of `distances`, in turns. Building: what
comes before the library's constructor (a call that fails there) beside the whole. All in processor time, but
threads, which are by the clock.
"""

import statistics
import sys
import time

import numpy as np

import plexway


def seconds(work, clock=time.process_time):
    begun = clock()
    work()
    return clock() - begun


def report(surface):
    V, F = np.array(surface.vertices), np.array(surface.simplices)
    print(surface)

    sources = list(range(0, 40))
    out = np.empty((len(sources), len(V)), np.float32)
    single = plexway.Surface(V[F[0]], [[0, 1, 2]])
    single.distance(0)
    calls = 20000
    empty = min(seconds(lambda: [single.distance(0) for _ in range(calls)]) for _ in range(5))
    print(f"a call on a single triangle, its solve included: {1e6 * empty / calls:.2f} us")

    def one_by_one():
        for source in sources:
            surface.distance(source)

    def together():
        surface.distances(sources, out=out, threads=1)

    one_by_one(), together()
    pairs = [(seconds(one_by_one), seconds(together)) for _ in range(9)]
    per_call = [1e6 * (a - b) / len(sources) for a, b in pairs]
    solve = 1e6 * statistics.median(b for _, b in pairs) / len(sources)
    print(f"a solve: {solve:.0f} us; a call more: {statistics.median(per_call):.1f} us in the middle, "
          f"{min(per_call):.1f} to {max(per_call):.1f}")

    def before():
        try:
            plexway.Surface(V, F, precision="none such")
        except ValueError:
            pass

    shares = [seconds(before) / seconds(lambda: plexway.Surface(V, F)) for _ in range(9)]
    print(f"building from arrays: {100 * statistics.median(shares):.1f} % of it before the library")

    many = np.arange(0, len(V), max(1, len(V) // 200))
    rows = np.empty((len(many), len(V)), np.float32)
    one = min(seconds(lambda: surface.distances(many, out=rows, threads=1), time.perf_counter) for _ in range(3))
    two = min(seconds(lambda: surface.distances(many, out=rows, threads=2), time.perf_counter) for _ in range(3))
    print(f"{len(many)} rows: two threads {one / two:.2f} times as fast as one")


if __name__ == "__main__":
    report(plexway.read(sys.argv[1] if len(sys.argv) > 1 else "data/knot.ply"))
