"""The programs that are compared, and how each is had. To add one: a line here and, where it does not speak the protocol
itself (see `run --protocol`), an adapter."""
import dataclasses
import importlib.util
import os
import shutil
import subprocess
import sys

ADAPTERS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "adapters")


@dataclasses.dataclass
class Peer:
    name: str
    method: str
    had: str  # the package it comes in
    reads: dict  # format by kind of domain
    command: list  # takes DOMAIN SOURCES OUT behind it, or {domain}, {sources}, {out} in it
    missing: str = ""  # why it cannot be run here

    @property
    def ours(self):
        return self.name.startswith("plexway")

    def words(self, domain, sources, out):
        given = {"{domain}": domain, "{sources}": sources, "{out}": out}
        if any(word in given for word in self.command):
            return [given.get(word, word) for word in self.command]
        return [*self.command, domain, sources, out]


def ours(tool):
    surface, both = {"surface": "off"}, {"surface": "off", "solid": "medit"}
    start = [tool, "pairs", "{domain}", "--sources", "{sources}", "--out", "{out}", "--threads", "1", "--quiet"]
    return [
        Peer("plexway, fast", "one label a triangle, float", "this project", surface,
             [*start, "--accuracy", "fast", "--precision", "float"]),
        Peer("plexway", "the default: merged windows (surfaces), strings (solids), float", "this project", both, start),
        Peer("plexway, exact", "windows, double", "this project", surface,
             [*start, "--accuracy", "exact", "--precision", "double", "--type", "float64"]),
    ]


def compiled(tool):
    """Those of bench_cgal, or without CGAL of bench: what Debian has as libraries."""
    folder = os.path.dirname(tool)
    with_cgal, without = (os.path.join(folder, name) for name in ("bench_cgal", "bench"))
    program = with_cgal if os.path.exists(with_cgal) else without

    def one(name, inside, method, had, cgal=False):
        missing = "" if os.path.exists(with_cgal if cgal else program) else \
            "bench_cgal is not built" if cgal else "neither bench_cgal nor bench is built"
        return Peer(name, method, had, {"surface": "off"},
                    [program, "peers", "--rows", inside, "{domain}", "--from", "{sources}", "--to", "{out}"], missing)
    return [
        one("Boost Dijkstra", "Boost Dijkstra, float", "Dijkstra along edges, float", "libboost-graph-dev"),
        one("CGAL heat", "CGAL heat, intrinsic Delaunay", "heat method on intrinsic Delaunay triangles", "libcgal-dev",
            True),
        one("CGAL exact", "CGAL exact paths", "exact (Xin and Wang)", "libcgal-dev", True),
    ]


def has_module(python, name):
    if python == sys.executable:
        try:
            return importlib.util.find_spec(name) is not None
        except ModuleNotFoundError:
            return False
    return subprocess.run([python, "-c", f"import {name}"], capture_output=True, check=False).returncode == 0


def python_peer(name, adapter, module, method, had, reads, python, *words):
    missing = "" if has_module(python, module) else f"Python has no {module} ({had})"
    return Peer(name, method, had, reads, [python, os.path.join(ADAPTERS, adapter), *words], missing)


def debian(python):
    surface = {"surface": "off"}
    workbench = shutil.which("wb_command")
    return [
        python_peer("scipy Dijkstra", "scipy_dijkstra.py", "scipy", "Dijkstra along edges", "python3-scipy",
                    {"surface": "off", "solid": "medit"}, python),
        python_peer("VTK Dijkstra", "vtk_dijkstra.py", "vtkmodules", "Dijkstra along edges", "python3-vtk9", surface,
                    python),
        Peer("Workbench", "Dijkstra along edges and over pairs of triangles, float", "connectome-workbench",
             {"surface": "gifti"}, [python, os.path.join(ADAPTERS, "workbench.py"), workbench or ""],
             "" if workbench else "no wb_command (connectome-workbench)"),
        python_peer("scikit-fmm", "scikit_fmm.py", "skfmm", "fast marching of second order, grids alone",
                    "python3-scikit-fmm", {"surface": "grid", "solid": "grid"}, python),
    ]


# Of PyPI: taken where the Python that runs them has them (--python).
def of_python(python):
    surface = {"surface": "off"}
    return [
        python_peer("pygeodesic", "exact_pygeodesic.py", "pygeodesic", "exact (Mitchell, Mount, Papadimitriou)",
                    "pygeodesic of PyPI", surface, python),
        python_peer("geometry-central heat", "geometry_central.py", "potpourri3d", "heat method", "potpourri3d of PyPI",
                    surface, python, "heat"),
        python_peer("geometry-central marching", "geometry_central.py", "potpourri3d", "fast marching",
                    "potpourri3d of PyPI", surface, python, "march"),
        python_peer("libigl exact", "libigl.py", "igl", "exact (Mitchell, Mount, Papadimitriou)", "libigl of PyPI", surface,
                    python, "exact"),
        python_peer("libigl heat", "libigl.py", "igl", "heat method", "libigl of PyPI", surface, python, "heat"),
    ]


def spoken(given):
    """NAME[:FORMAT]=COMMAND: programs that speak the protocol themselves. A solid's format is medit, others are surfaces'."""
    found = []
    for text in given:
        name, equals, command = text.partition("=")
        name, _, form = name.partition(":")
        form = form or "off"
        if not equals or not command or form not in ("off", "obj", "gifti", "medit", "grid"):
            raise ValueError(f"--peer {text}: NAME[:off|obj|gifti|medit|grid]=COMMAND")
        reads = {"solid": form} if form == "medit" else {"surface": form}
        if form == "grid":
            reads["solid"] = form
        found.append(Peer(name, "as given", "--peer", reads, command.split()))
    return found


def everything(tool, python, given):
    return [*ours(tool), *compiled(tool), *debian(python), *of_python(python), *spoken(given)]
