#!/usr/bin/env python3
"""What the first answer costs, and the solves that lag: asked beside measured, as Markdown.

    bench/first.py BUILD [--data FOLDER] [--scan FILE] [--before BUILD] [--turns N] [--only TEXT]

BUILD is a build folder with bin/plexway and bin/bench; --before another one, which takes turns with it. FOLDER has
`surfaces` and `solids` with their exact answers; what needs it is left out without. FILE is a scan, by default the dragon
of data/fetch.sh, or a surface made here. The least of the turns counts; ratios to Dijkstra are medians inside one process
(bench/measure.hpp), of which the least counts too.
"""
import argparse
import glob
import json
import os
import statistics
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))


class Build:
    """The programs of a build folder; what they print is JSON."""

    def __init__(self, folder):
        self.bin = os.path.join(os.path.abspath(folder), "bin")

    def run(self, name, *words):
        done = subprocess.run([os.path.join(self.bin, name), *words, "--json"], check=True, capture_output=True, text=True,
                              stdin=subprocess.DEVNULL)
        return json.loads(done.stdout)

    def used(self, folder, name, *words):
        """What the system says that a whole run took."""
        report = os.path.join(folder, "report.json")
        subprocess.run([sys.executable, "-S", "-E", os.path.join(HERE, "peers", "limited.py"), "600", "0", report, os.devnull,
                        os.path.join(self.bin, name), *words], check=True)
        with open(report, encoding="utf-8") as file:
            found = json.load(file)
        if found["status"]:
            raise RuntimeError(f"{name} {' '.join(words)} ended with {found['status']}")
        return found


def building(build, scan, folder, data):
    """Nanoseconds and bytes each, from surfaces and solids in memory to ready."""
    solids = glob.glob(os.path.join(data, "solids", "notch_100k.node")) if data else []
    rows = build.run("bench", "build", scan, *solids, "--sizes", "100000", "--repeats", "3")
    name = os.path.splitext(os.path.basename(scan))[0]
    keys = {"surface, float": "surface, float", "by Delaunay, float": "Delaunay, float"}
    for row in rows:
        if row["input"] == name and row["built"] in keys:
            what = keys[row["built"]]
            yield f"{what}: ns a vertex", row["ns"]
            yield f"{what}: instructions a vertex", row.get("instructions")
            yield f"{what}: cycles a vertex", row.get("cycles")
            yield f"{what}: peak bytes a vertex beyond the input", row["peak_bytes"]
            yield f"{what}: held bytes a vertex", row["held_bytes"]
        if row["built"] == "solid, float":
            yield "solid, float: ns a tetrahedron", row["ns"]
            yield "solid, float: instructions a tetrahedron", row.get("instructions")
            yield "solid, float: cycles a tetrahedron", row.get("cycles")


def threads(build, scan, folder, data):
    """By the clock: what two threads gain; means something on a machine with two idle cores."""
    solids = glob.glob(os.path.join(data, "solids", "notch_100k.node")) if data else []
    name = os.path.splitext(os.path.basename(scan))[0]
    ns = [{(row["input"], row["built"]): row["ns"]
           for row in build.run("bench", "build", scan, *solids, "--sizes", "100000", "--repeats", "3", "--threads", str(n))}
          for n in (1, 2)]
    for built in ("surface, float", "by Delaunay, float"):
        yield f"{built}: two threads, share of the time of one", ns[1][name, built] / ns[0][name, built]
    for key in ns[0]:
        if key[1] == "solid, float":
            yield "solid, float: two threads, share of the time of one", ns[1][key] / ns[0][key]


def clouds(build, scan, folder, data):
    for row in build.run("bench", "clouds", "--generated", "100000", "--kinds", "sphere", "--sources", "2", "--repeats", "1"):
        yield "cloud of 100,000 points after its neighbours: us a point", row["build_us"]


def whole(build, scan, folder, data):
    out = os.path.join(folder, "d.npy")
    used = build.used(folder, "plexway", "distance", scan, "--source", "vertex:0", "--accuracy", "fast", "--out", out, "--quiet")
    yield "whole command, `fast`: processor s", used["processor"]
    yield "whole command, `fast`: s by the clock", used["wall"]
    yield "whole command, `fast`: peak MB", used["peak"] / 1e6


def opening(build, scan, folder, data):
    kept = os.path.join(folder, "kept.plexway")
    build.run("plexway", "prepare", scan, "--out", kept)
    used = build.used(folder, "plexway", "distance", kept, "--source", "vertex:0", "--accuracy", "fast", "--quiet")
    yield "whole command on the prepared file: processor s", used["processor"]
    times = [build.run("plexway", "distance", kept, "--source", "vertex:0", "--accuracy", "fast")["seconds"]
             for _ in range(3)]
    yield "prepared file opens and is checked: ms", 1e3 * min(t["load"] + t["build"] for t in times)


def solids(build, scan, folder, data):
    if not data:
        return
    with tempfile.TemporaryDirectory(dir=folder) as some:
        for name in glob.glob(os.path.join(data, "solids", "cavity_100k.*")):
            os.symlink(os.path.abspath(name), os.path.join(some, os.path.basename(name)))
        rows = build.run("bench", "solids", some, "--sizes", "12,70", "--sources", "3", "--repeats", "1", "--budget", "10",
                         "--processor")
    by = {row["mesh"]: row for row in rows}
    if "cavity_100k" in by:
        yield "cavity_100k: x Dijkstra", by["cavity_100k"].get("ratio")
        yield "cavity_100k: mean error", by["cavity_100k"].get("mean")
    if "ns_per_tet" in by.get("cube_70", {}):
        yield "cube of 2M tetrahedra: time each, x that of 10k", by["cube_70"]["ns_per_tet"] / by["cube_12"]["ns_per_tet"]


def fast(build, scan, folder, data):
    meshes = sorted(glob.glob(os.path.join(data, "surfaces", "*.obj"))) if data else []
    if not meshes:
        return
    rows = build.run("bench", "peers", *meshes, "--only", "saddles, float",
                     "--sources", "6", "--repeats", "2", "--budget", "5", "--processor")
    ratios = {row["mesh"]: row["ratio"] for row in rows if "ratio" in row}
    if not ratios:
        raise RuntimeError("bench peers measured nothing: " + "; ".join(sorted({row.get("note", "") for row in rows})))
    yield "`fast` on the input's triangles: x Dijkstra, median of the meshes", statistics.median(ratios.values())
    yield f"the same, worst ({max(ratios, key=ratios.get)})", max(ratios.values())


PARTS = {"building": building, "threads": threads, "clouds": clouds, "whole": whole, "opening": opening, "solids": solids, "fast": fast}

# What was asked for, and what was before.
ASKED = {
    "surface, float: ns a vertex": ("400", "1,600"),
    "Delaunay, float: ns a vertex": ("800", "4,700"),
    "surface, float: peak bytes a vertex beyond the input": ("220", "282"),
    "Delaunay, float: peak bytes a vertex beyond the input": ("480", "776"),
    "Delaunay, float: held bytes a vertex": ("220", ""),
    "surface, float: held bytes a vertex": ("220", ""),
    "surface, float: two threads, share of the time of one": ("0.625", "1"),
    "Delaunay, float: two threads, share of the time of one": ("0.625", "1"),
    "solid, float: ns a tetrahedron": ("200", "430 to 480"),
    "solid, float: two threads, share of the time of one": ("0.625", "1"),
    "cloud of 100,000 points after its neighbours: us a point": ("2.4", "4.2"),
    "whole command, `fast`: s by the clock": ("0.6", "2.4"),
    "prepared file opens and is checked: ms": ("20", ""),
    "cavity_100k: x Dijkstra": ("8", "15 to 18"),
    "cube of 2M tetrahedra: time each, x that of 10k": ("1.8", "2.3"),
    "`fast` on the input's triangles: x Dijkstra, median of the meshes": ("1.3", "1.4 to 1.6"),
}


def made_here(build, folder):
    subprocess.run([os.path.join(build.bin, "plexway_generate_data"), folder, "bumpy-400k"], check=True,
                   stdout=subprocess.DEVNULL)
    return next(iter(glob.glob(os.path.join(folder, "bumpy-400k.*"))))


def main():
    parser = argparse.ArgumentParser(usage="bench/first.py BUILD [options]", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("build", metavar="BUILD")
    add("--data", metavar="FOLDER")
    add("--scan", metavar="FILE")
    add("--before", metavar="BUILD")
    add("--turns", type=int, default=3)
    add("--only", metavar="TEXT", choices=list(PARTS), action="append")
    given = parser.parse_args()
    parts = given.only or PARTS
    builds = [Build(folder) for folder in [given.build, *([given.before] if given.before else [])]]
    with tempfile.TemporaryDirectory() as folder:
        fetched = os.path.join(os.path.dirname(HERE), "data", "fetched", "dragon_vrip.ply")
        scan = given.scan or (fetched if os.path.exists(fetched) else made_here(builds[0], folder))
        found = [{} for _ in builds]
        for turn in range(given.turns):
            for part in parts:
                for build, kept in zip(builds, found):
                    print(f"turn {turn + 1}: {part}", file=sys.stderr, flush=True)
                    for key, value in PARTS[part](build, os.path.abspath(scan), folder, given.data):
                        if value is not None:
                            kept[key] = min(value, kept.get(key, value))
    print(f"{os.path.basename(scan)}; load {os.getloadavg()[0]:.1f}; the least of {given.turns} turns\n")
    print("| | asked at most | once |" + (" before |" if given.before else "") + " measured |")
    print("|---|---:|---:|---:|" + ("---:|" if given.before else ""))
    for key, value in found[0].items():
        asked, once = ASKED.get(key, ("", ""))
        missed = asked and value > float(asked)
        old = f" {found[1].get(key, float('nan')):.3g} |" if given.before else ""
        print(f"| {key} | {asked} | {once} |{old} {'**' if missed else ''}{value:.3g}{'**' if missed else ''} |")
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except subprocess.CalledProcessError as problem:
        said = (problem.stderr or "").strip().splitlines()
        sys.exit(f"bench/first.py: {problem.cmd[0]} ended with {problem.returncode}" + (f": {said[-1]}" if said else ""))
    except (OSError, RuntimeError) as problem:
        sys.exit(f"bench/first.py: {problem}")
