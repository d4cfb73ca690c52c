"""Memory stays flat: PLEXWAY_LEAK_SOLVES solves, 1e5 in full, fewer by default."""

import gc
import os

import meshes
import numpy as np
import pytest

import plexway as px

COUNT = int(os.environ.get("PLEXWAY_LEAK_SOLVES", "5000"))


def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="no /proc here")
def test_resident_memory_is_flat():
    V, F = meshes.grid(8, jitter=0.2)
    sheet = px.Surface(V, F)
    frame = px.Wireframe(V, meshes.loose_edges(F))
    out = np.empty((2, len(V)), np.float32)

    def work(times):
        for i in range(times):
            v = i % len(V)
            sheet.distance(v)
            sheet.nearest([v, 3])
            frame.distance([0.3, 0.4, 0])
            if i % 20 == 0:
                sheet.distances([v, 1], out=out, threads=1)
                sheet.field(v).path(5).points
                px.Surface(V, F).vertices
                with pytest.raises(px.UsageError):
                    sheet.distance(10**6)
        gc.collect()

    work(500)
    before = resident()
    work(COUNT)
    # Three arrays of 300 bytes a turn are kept by nobody: a leak of one would be 1.5 MB.
    assert resident() - before < 1_000_000
