"""What Python costs beside C++: a call, and building from arrays.

    PYTHONPATH=build/python python3 python/bench/overhead.py [FILE]

A call: k calls of `distance` beside the same k solves in one call of `distances` that keeps one number of
each, in turns; the difference has the memory of each result in it, which C++ would take as well. Building: what
comes before the library's constructor (a call that fails there) beside the whole. By the clock and in
processor time: on a machine that others use the clock says nothing.
"""

import statistics
import sys
import time

import numpy as np

import plexway


CLOCKS = {"by the clock": time.perf_counter, "processor time": time.process_time}


def seconds(work, clock=time.process_time):
    begun = clock()
    work()
    return clock() - begun


def report(surface):
    V, F = np.array(surface.vertices), np.array(surface.simplices)
    print(surface)

    sources = list(range(0, 40))
    out = np.empty((len(sources), 1), np.float32)
    single = plexway.Surface(V[F[0]], [[0, 1, 2]])
    single.distance(0)
    calls = 20000
    empty = min(seconds(lambda: [single.distance(0) for _ in range(calls)]) for _ in range(5))
    print(f"a call on a single triangle, its solve included: {1e6 * empty / calls:.2f} us")

    def one_by_one():
        for source in sources:
            surface.distance(source, accuracy="fast")

    def together():
        surface.distances(sources, columns=[0], out=out, threads=1, accuracy="fast")

    one_by_one(), together()
    for name, clock in CLOCKS.items():
        pairs = [(seconds(one_by_one, clock), seconds(together, clock)) for _ in range(15)]
        per_call = [1e6 * (a - b) / len(sources) for a, b in pairs]
        solve = 1e6 * statistics.median(b for _, b in pairs) / len(sources)
        print(f"{name}: a solve {solve:.0f} us; a call more {statistics.median(per_call):.1f} us in "
              f"the middle of 15 turns, {min(per_call):.1f} to {max(per_call):.1f}")

    def before():
        try:
            plexway.Surface(V, F, precision="none such")
        except ValueError:
            pass

    def whole():
        plexway.Surface(V, F)

    for name, clock in CLOCKS.items():
        shares = [seconds(before, clock) / seconds(whole, clock) for _ in range(15)]
        print(f"{name}: building from arrays: {100 * statistics.median(shares):.1f} % of it before "
              f"the library, in the middle of 15 turns")


if __name__ == "__main__":
    report(plexway.read(sys.argv[1] if len(sys.argv) > 1 else "data/knot.ply"))
