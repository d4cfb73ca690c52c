"""What is measured: surfaces and solids with sources and, where they are known, exact answers. Every program gets the
same simplices and numbers; a file is written once for each format that some program reads."""
import glob
import math
import os
import re
import subprocess

import numpy as np


class Domain:
    def __init__(self, name, kind, points, cells, truths=None, note="", grid=None):
        self.name, self.kind, self.points, self.cells = name, kind, points, cells
        self.truths = truths or {}  # source: one a vertex, NaN where it is not known
        self.note, self.grid = note, grid  # grid: (open points of a box, their distance)
        self.files = {}

    def file(self, form, folder):
        """The domain's file in this format, made when it is first asked for."""
        if form not in self.files:
            name = os.path.join(folder, f"{self.name}.{ENDINGS[form]}")
            WRITERS[form](self, name)
            self.files[form] = name
        return self.files[form]

    def sources(self, count):
        """Those with exact answers first, then more from all over."""
        found = sorted(self.truths)
        used = np.unique(self.cells)
        place = 0.5
        while len(found) < count and len(found) < len(used):
            vertex = int(used[int(place * len(used))])
            if vertex not in found:
                found.append(vertex)
            place = math.fmod(place + 0.6180339887498949, 1.0)
        return found[:max(count, 1)]


def write_off(domain, name):
    with open(name, "w", encoding="ascii") as file:
        file.write(f"OFF\n{len(domain.points)} {len(domain.cells)} 0\n")
        file.writelines(" ".join(map(repr, p)) + "\n" for p in domain.points.tolist())
        file.writelines("3 %d %d %d\n" % tuple(t) for t in domain.cells.tolist())


def write_obj(domain, name):
    with open(name, "w", encoding="ascii") as file:
        file.writelines("v " + " ".join(map(repr, p)) + "\n" for p in domain.points.tolist())
        file.writelines("f %d %d %d\n" % tuple(t) for t in (domain.cells + 1).tolist())


def write_medit(domain, name):
    with open(name, "w", encoding="ascii") as file:
        file.write(f"MeshVersionFormatted 2\nDimension 3\nVertices\n{len(domain.points)}\n")
        file.writelines(" ".join(map(repr, p)) + " 0\n" for p in domain.points.tolist())
        file.write(f"Tetrahedra\n{len(domain.cells)}\n")
        file.writelines("%d %d %d %d 0\n" % tuple(t) for t in (domain.cells + 1).tolist())
        file.write("End\n")


def write_gifti(domain, name):
    structure = ("<MD><Name><![CDATA[AnatomicalStructurePrimary]]></Name>"
                 "<Value><![CDATA[CortexLeft]]></Value></MD>")

    def array(intent, kind, rows, meta=""):
        words = "\n".join(" ".join(map(repr, row)) for row in rows.tolist())
        return (f'<DataArray Intent="NIFTI_INTENT_{intent}" DataType="NIFTI_TYPE_{kind}"'
                f' ArrayIndexingOrder="RowMajorOrder" Dimensionality="2" Dim0="{len(rows)}"'
                f' Dim1="3" Encoding="ASCII" Endian="LittleEndian" ExternalFileName=""'
                f' ExternalFileOffset=""><MetaData>{meta}</MetaData><Data>{words}</Data></DataArray>')
    with open(name, "w", encoding="ascii") as file:
        file.write('<?xml version="1.0" encoding="UTF-8"?>\n<GIFTI Version="1.0" NumberOfDataArrays="2">'
                   "<MetaData/><LabelTable/>"
                   + array("POINTSET", "FLOAT32", domain.points.astype(np.float32), structure)
                   + array("TRIANGLE", "INT32", domain.cells) + "</GIFTI>\n")


def write_grid(domain, name):
    np.savez(name, open=domain.grid[0], spacing=domain.grid[1])


ENDINGS = {"off": "off", "obj": "obj", "gifti": "surf.gii", "medit": "mesh", "grid": "npz"}
WRITERS = {"off": write_off, "obj": write_obj, "gifti": write_gifti, "medit": write_medit, "grid": write_grid}


def truths_beside(file, count):
    """The exact answers NAME.vID.txt beside a file."""
    found = {}
    base = os.path.splitext(file)[0]
    for name in glob.glob(glob.escape(base) + ".v*.txt"):
        number = re.fullmatch(r"v(\d+)", name[len(base) + 1:-len(".txt")])
        if number:
            found[int(number[1])] = np.loadtxt(name)
    for source, row in found.items():
        if len(row) != count:
            raise ValueError(f"{file}: the answers from {source} are {len(row)} numbers, not {count}")
    return found


def read(tool, file, folder, note=""):
    """A surface (or solid, .node and .mesh) as plexway reads it, equal corners of an .stl made one."""
    name = os.path.splitext(os.path.basename(file))[0]
    solid = file.endswith((".node", ".ele", ".mesh"))
    plain = os.path.join(folder, "read." + ("mesh" if solid else "off"))
    subprocess.run([tool, "convert", file, plain, "--quiet"], check=True, stdin=subprocess.DEVNULL,
                   capture_output=True, text=True)
    with open(plain, encoding="ascii") as lines:
        words = lines.read().split()
    os.remove(plain)
    if solid:
        at, cells_at = words.index("Vertices"), words.index("Tetrahedra")
        count, cells = int(words[at + 1]), int(words[cells_at + 1])
        points = np.array(words[at + 2:at + 2 + 4 * count], float).reshape(-1, 4)[:, :3]
        corners = np.array(words[cells_at + 2:cells_at + 2 + 5 * cells], int).reshape(-1, 5)[:, :4] - 1
    else:
        count, cells = int(words[1]), int(words[2])
        points = np.array(words[4:4 + 3 * count], float).reshape(-1, 3)
        corners = np.array(words[4 + 3 * count:4 + 3 * count + 4 * cells], int).reshape(-1, 4)[:, 1:]
    return Domain(name, "solid" if solid else "surface", points, corners, truths_beside(file, count), note)


def wall(n, layers=1):
    """A unit square (or prism) of n points a side behind a block that stands on one side of it: grids, and simplices
    between the same points. The way around the block is known: past its two upper corners, which are points of the
    grid."""
    step = 1 / (n - 1)
    left, right, high = int(0.4 * (n - 1)), int(0.6 * (n - 1)), int(0.7 * (n - 1))
    is_open = np.ones((n, n), bool)
    is_open[left + 1:right, :high] = False  # what touches the block's sides stays
    number = np.full((layers, n, n), -1)
    number[:, is_open] = np.arange(layers * is_open.sum()).reshape(layers, -1)
    z, x, y = np.nonzero(number >= 0)
    points = np.stack([x, y, z], -1) * step
    source = (int(0.1 * (n - 1)), int(0.2 * (n - 1)), layers // 2)

    cell = np.ones((n - 1, n - 1), bool)
    cell[left:right, :high] = False
    i, j = np.nonzero(cell)
    if layers == 1:
        a, b, c, d = (number[0, i + p, j + q] for p, q in ((0, 0), (1, 0), (0, 1), (1, 1)))
        cells = np.concatenate([np.stack([a, b, d], -1), np.stack([a, d, c], -1)])
    else:
        cells = []
        for order in ((0, 1, 2), (0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0)):
            for k in range(layers - 1):  # six tetrahedra a cube, each along one way through it
                corner, at = [], [0, 0, 0]
                corner.append(number[k, i, j])
                for axis in order:
                    at[axis] = 1
                    corner.append(number[k + at[2], i + at[0], j + at[1]])
                cells.append(np.stack(corner, -1))
        cells = np.concatenate(cells)

    flat = np.hypot
    sx, sy = source[0] * step, source[1] * step
    px, py = points[:, 0], points[:, 1]
    l, r, h = left * step, right * step, high * step
    to_left, across = flat(sx - l, sy - h), r - l
    # Over the left corner, and the right one too for what is behind the block; straight where nothing is between.
    slope = (h - sy) / (l - sx)
    straight = flat(px - sx, py - sy)
    shaded = (px > l + step / 4) & (py < sy + slope * (px - sx))
    by_left = to_left + flat(px - l, py - h)
    behind = (px > r - step / 4) & (py < h)
    planar = np.where(behind, to_left + across + flat(px - r, py - h), np.where(shaded, by_left, straight))
    exact = np.hypot(planar, points[:, 2] - source[2] * step)
    name = f"wall_{n}" if layers == 1 else f"wall_{n}x{layers}"
    # numpy's order of a box is (layer, x, y); so is the numbering.
    grid = (number[0] >= 0 if layers == 1 else number >= 0, step)
    at = int(number[source[2], source[0], source[1]])
    return Domain(name, "surface" if layers == 1 else "solid", points, cells, {at: exact},
                  "grid, in closed form", grid)
