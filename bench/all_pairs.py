#!/usr/bin/env python3
"""All pairs of a surface: how long, how exact, how much memory.

    bench/all_pairs.py TOOL table SURFACE      beside other programs, on a sample of rows
    bench/all_pairs.py TOOL radius             within a radius on a million vertices
    bench/all_pairs.py TOOL memory             100,000 columns: resident memory by rows

TOOL is the plexway program. Times are of the processor (user and system, threads together), each the
least of three turns and with the time to read the surface taken off, so that they mean something on
a machine that others use too. Peers are taken where they are: scipy's Dijkstra along edges, Boost's and
CGAL's in bench_cgal or bench_peers beside TOOL, and the Connectome Workbench's wb_command. What stands
beside them in the table is the clock of their own program.
"""
import json
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time

import numpy as np

TURNS = int(os.environ.get("TURNS", "3"))
ROWS = int(os.environ.get("ROWS", "40"))


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


def errors(found, truth):
    some = np.isfinite(truth) & (truth > 0)
    off = np.abs(found[some] / truth[some] - 1)
    return off.mean(), off.max()


def line(name, seconds, rows, off):
    print(f"| {name} | {1e3 * seconds / rows:.3g} | {off[0]:.2g} | {off[1]:.2g} |", flush=True)


def read_surface(tool, surface, folder):
    """Positions and triangles as plexway reads them."""
    off = os.path.join(folder, "surface.off")
    subprocess.run([tool, "convert", surface, off, "--quiet"], check=True)
    with open(off) as file:
        file.readline()
        vertices, faces, _ = map(int, file.readline().split())
        numbers = np.fromstring(file.read(), sep=" ")
    points = numbers[:3 * vertices].reshape(-1, 3)
    return points, numbers[3 * vertices:].reshape(faces, 4)[:, 1:].astype(np.int64)


def gifti(points, triangles):
    """A surface as wb_command reads it."""
    def array(intent, kind, rows):
        text = "\n".join(" ".join(map(repr, row)) for row in rows.tolist())
        return (f'<DataArray Intent="NIFTI_INTENT_{intent}" DataType="NIFTI_TYPE_{kind}"'
                f' ArrayIndexingOrder="RowMajorOrder" Dimensionality="2" Dim0="{len(rows)}"'
                f' Dim1="3" Encoding="ASCII" Endian="LittleEndian" ExternalFileName=""'
                f' ExternalFileOffset=""><MetaData>{structure if intent == "POINTSET" else ""}'
                f'</MetaData><Data>{text}</Data></DataArray>')
    structure = ("<MD><Name><![CDATA[AnatomicalStructurePrimary]]></Name>"
                 "<Value><![CDATA[CortexLeft]]></Value></MD>")
    return ('<?xml version="1.0" encoding="UTF-8"?>\n<GIFTI Version="1.0" NumberOfDataArrays="2">'
            "<MetaData/><LabelTable/>" + array("POINTSET", "FLOAT32", points) +
            array("TRIANGLE", "INT32", triangles) + "</GIFTI>\n")


def in_benchmark(tool, folder, sources, truth):
    """What the peers of bench_cgal or bench_peers take for a row, and their errors."""
    programs = [os.path.join(os.path.dirname(tool), name) for name in ("bench_cgal", "bench_peers")]
    program = next((p for p in programs if os.path.exists(p)), None)
    if program is None:
        print("no bench_cgal or bench_peers beside the tool", file=sys.stderr)
        return
    for source, exact in zip(sources, truth):
        np.savetxt(os.path.join(folder, f"surface.v{source}.txt"), exact, fmt="%.17g")
    words = [program, os.path.join(folder, "surface.off"), "--json", "--sources", str(len(sources)),
             "--only", "Dijkstra", "--only", "heat"]
    for row in json.loads(processor_time(words)[1]):
        if "mean" in row:
            yield (f"{row['peer']} (clock)", 1e-9 * row["ns_per_vertex"] * row["vertices"],
                   (row["mean"], row["max"]))


def table(tool, surface):
    with tempfile.TemporaryDirectory() as folder:
        points, triangles = read_surface(tool, surface, folder)
        n = len(points)
        rows = np.arange(ROWS) * (n // ROWS)
        sources = os.path.join(folder, "rows.txt")
        np.savetxt(sources, rows, fmt="%d")
        one = os.path.join(folder, "one.txt")
        np.savetxt(one, rows[:1], fmt="%d")
        out = os.path.join(folder, "d.npy")

        def ours(accuracy, listed, precision):
            return processor_time([tool, "pairs", surface, "--sources", listed, "--out", out,
                                   "--accuracy", accuracy, "--precision", precision,
                                   "--threads", "1", "--quiet"])

        ours("exact", sources, "double")
        truth = np.load(out)
        print(f"{os.path.basename(surface)}: {n} vertices, {ROWS} rows, one thread\n")
        print("| | processor ms a row | mean error | worst |\n|---|---|---|---|")
        for accuracy in ("fast", "accurate", "exact"):
            precision = "double" if accuracy == "exact" else "float"
            whole, _ = least(lambda: ours(accuracy, sources, precision))
            off = errors(np.load(out), truth)
            reading, _ = least(lambda: ours(accuracy, one, precision))
            line(f"plexway, {accuracy}", whole - reading, ROWS - 1, off)

        try:
            import scipy.sparse as sparse
            from scipy.sparse.csgraph import dijkstra
            edges = np.unique(np.sort(np.vstack([triangles[:, [0, 1]], triangles[:, [1, 2]],
                                                 triangles[:, [2, 0]]]), axis=1), axis=0)
            length = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
            graph = sparse.csr_matrix((length, (edges[:, 0], edges[:, 1])), shape=(n, n))

            def peer():
                start = time.process_time()
                found = dijkstra(graph, directed=False, indices=rows)
                return time.process_time() - start, found
            seconds, found = least(peer)
            line("scipy, Dijkstra along edges", seconds, ROWS, errors(found, truth))
        except ImportError:
            print("no scipy", file=sys.stderr)

        some = rows[:3]
        for peer, seconds, off in in_benchmark(tool, folder, some, truth):
            line(peer, seconds, 1, off)

        workbench = shutil.which("wb_command")
        if workbench:
            mesh = os.path.join(folder, "s.surf.gii")
            with open(mesh, "w") as file:
                file.write(gifti(points.astype(np.float32), triangles))
            metric = os.path.join(folder, "d.func.gii")
            quiet = dict(env={**os.environ, "QT_QPA_PLATFORM": "offscreen",
                              "OMP_NUM_THREADS": "1"})
            reading, _ = least(lambda: processor_time(
                [workbench, "-surface-information", mesh], **quiet))
            seconds, off = [], []
            for source, exact in zip(some, truth):
                seconds.append(least(lambda: processor_time(
                    [workbench, "-surface-geodesic-distance", mesh, str(source), metric],
                    **quiet))[0] - reading)
                text = processor_time([workbench, "-gifti-convert", "ASCII", metric, metric],
                                      **quiet)
                with open(metric) as file:
                    data = file.read().split("<Data>")[1].split("</Data>")[0]
                found = np.fromstring(data, sep=" ")
                off.append(errors(np.where(found < 0, np.inf, found), exact))
            line("Connectome Workbench, -surface-geodesic-distance", min(seconds), 1,
                 (np.mean([o[0] for o in off]), max(o[1] for o in off)))


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
    what = {"table": table, "radius": radius, "memory": memory}
    if len(sys.argv) < 3 or sys.argv[2] not in what:
        sys.exit(__doc__)
    what[sys.argv[2]](sys.argv[1], *sys.argv[3:])
