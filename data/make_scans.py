#!/usr/bin/env python3
"""Makes the three samples of the tutorials that imitate scans: a cortex, a piece of ground, a kidney.

    data/make_scans.py FOLDER

Nothing but Python's own library is needed. The shapes are formulas, so the files are the project's own (MIT).
"""

import base64
import math
import struct
import sys
import zlib
from pathlib import Path


def rounded(value, step):
    return round(value / step) * step


# ---------------------------------------------------------------- a cortex, as GIfTI

def sphere(frequency):
    """The icosahedron's faces cut into frequency^2 triangles each: unit vectors, triangles."""
    g = (1 + math.sqrt(5)) / 2
    corners = [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g), (0, 1, -g),
               (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2),
             (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11),
             (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    number, points, triangles = {}, [], []

    def vertex(weights):
        key = tuple(sorted((c, w) for c, w in weights if w))
        if key not in number:
            at = [sum(corners[c][i] * w for c, w in key) for i in range(3)]
            length = math.hypot(*at)
            number[key] = len(points)
            points.append([x / length for x in at])
        return number[key]

    n = frequency
    for a, b, c in faces:
        at = lambda i, j: vertex([(a, n - i - j), (b, i), (c, j)])
        for i in range(n):
            for j in range(n - i):
                triangles.append((at(i, j), at(i + 1, j), at(i, j + 1)))
                if i + j + 2 <= n:
                    triangles.append((at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))
    return points, triangles


def cortex():
    """A folded half of a brain, in millimetres: x to the side, y to the front, z up; flat where the halves meet."""
    directions, triangles = sphere(28)
    points = []
    for x, y, z in directions:
        # Folds are lines of equal phase of a bent wave; none on the flat side.
        phase = 7 * y + 1.7 * math.sin(3 * z + 1) + 1.3 * math.sin(4 * x - 2 * z) + 1.1 * math.sin(5 * z + 3 * y)
        side = 1 / (1 + math.exp(-14 * (x + 0.25)))
        fold = 0.5 - 0.5 * math.cos(phase * 1.9)
        radius = 1 - 0.14 * side * fold ** 2
        flat = x if x > -0.35 else -0.35 + 0.12 * (x + 0.35)
        points.append([rounded(v, 1 / 64) for v in (38 * radius * (flat + 0.35), 72 * radius * y, 48 * radius * z)])
    names = ["medial wall", "frontal", "central", "parietal", "occipital", "temporal"]
    seeds = [(-1, 0, 0), (0.5, 0.8, 0.2), (0.6, 0.1, 0.8), (0.5, -0.5, 0.7), (0.3, -1, 0), (0.7, 0.1, -0.7)]
    labels = []
    for x, y, z in directions:
        wall = x < -0.8 and abs(z + 0.05) < 0.35
        near = [sum(s * v for s, v in zip(seed, (x, y, z))) / math.hypot(*seed) for seed in seeds]
        labels.append(0 if wall else 1 + max(range(1, 6), key=lambda k: near[k]) - 1)
    return points, triangles, labels, names


def gifti(arrays, table=""):
    kinds = {"f": ("NIFTI_TYPE_FLOAT32", "f"), "i": ("NIFTI_TYPE_INT32", "i")}
    text = ('<?xml version="1.0" encoding="UTF-8"?>\n'
            '<!DOCTYPE GIFTI SYSTEM "http://www.nitrc.org/frs/download.php/115/gifti.dtd">\n'
            f'<GIFTI Version="1.0" NumberOfDataArrays="{len(arrays)}">\n{table}')
    for intent, kind, rows in arrays:
        flat = [v for row in rows for v in (row if isinstance(row, (list, tuple)) else [row])]
        width = len(flat) // len(rows)
        shape = f'Dimensionality="{1 if width == 1 else 2}" Dim0="{len(rows)}"'
        shape += "" if width == 1 else f' Dim1="{width}"'
        packed = base64.b64encode(zlib.compress(struct.pack(f"<{len(flat)}{kinds[kind][1]}", *flat), 9)).decode()
        text += (f'<DataArray Intent="{intent}" DataType="{kinds[kind][0]}" {shape} '
                 'ArrayIndexingOrder="RowMajorOrder" Encoding="GZipBase64Binary" Endian="LittleEndian" '
                 f'ExternalFileName="" ExternalFileOffset="">\n<Data>{packed}</Data>\n</DataArray>\n')
    return text + "</GIFTI>\n"


def write_cortex(folder):
    points, triangles, labels, names = cortex()
    (folder / "cortex.surf.gii").write_text(gifti([("NIFTI_INTENT_POINTSET", "f", points),
                                                   ("NIFTI_INTENT_TRIANGLE", "i", triangles)]))
    table = "<LabelTable>\n" + "".join(f'<Label Key="{k}"><![CDATA[{name}]]></Label>\n'
                                       for k, name in enumerate(names)) + "</LabelTable>\n"
    (folder / "cortex.label.gii").write_text(gifti([("NIFTI_INTENT_LABEL", "i", labels)], table))


# ---------------------------------------------------------------- ground, as LAS

def ground():
    """Ground of 90 by 70 m as an airborne scan leaves it once buildings are taken out, which leaves holes."""
    state = 12345

    def noise():
        nonlocal state
        state = (1103515245 * state + 12345) % 2 ** 31
        return state / 2 ** 31 - 0.5

    buildings = [(18, 12, 34, 52), (46, -9, 58, 40), (46, 50, 76, 60), (70, 14, 82, 40)]
    for row in range(71):
        for column in range(91):
            x, y = column + 0.5 * noise(), row + 0.5 * noise()
            if any(a < x < b and c < y < d for a, c, b, d in buildings):
                continue
            z = 3 * math.sin(x / 21) * math.cos(y / 17) + 0.02 * y + 0.02 * noise()
            yield x, y, z


def write_ground(folder):
    points = [(round(1000 * x), round(1000 * y), round(1000 * z)) for x, y, z in ground()]
    low = [min(p[i] for p in points) / 1000 for i in range(3)]
    high = [max(p[i] for p in points) / 1000 for i in range(3)]
    origin = (1000.0, 2000.0, 210.0)
    header = struct.pack("<4sHH16sBB32s32sHHHIIBHI5I", b"LASF", 0, 0, bytes(16), 1, 2, b"plexway sample",
                         b"data/make_scans.py", 1, 2026, 227, 227, 0, 0, 20, len(points), len(points), 0, 0, 0, 0)
    header += struct.pack("<3d3d", 0.001, 0.001, 0.001, *origin)
    for i in range(3):
        header += struct.pack("<2d", high[i] + origin[i], low[i] + origin[i])
    body = b"".join(struct.pack("<3iHBBbBH", *p, 0, 9, 2, 0, 0, 0) for p in points)
    (folder / "ground.las").write_bytes(header + body)


# ---------------------------------------------------------------- a kidney, as Gmsh's .msh

def kidney(n=10):
    """A cube of n^3 cells, six tetrahedra each, made round and bent: vertices, lines of an artery, tetrahedra."""
    number = lambda i, j, k: (i * (n + 1) + j) * (n + 1) + k
    points = []
    for i in range(n + 1):
        for j in range(n + 1):
            for k in range(n + 1):
                a, b, c = (2 * v / n - 1 for v in (i, j, k))
                # From the cube most of the way to the ball.
                x = a * math.sqrt(1 - b * b / 2 - c * c / 2 + b * b * c * c / 3)
                y = b * math.sqrt(1 - c * c / 2 - a * a / 2 + c * c * a * a / 3)
                z = c * math.sqrt(1 - a * a / 2 - b * b / 2 + a * a * b * b / 3)
                x, y, z = (0.25 * cube + 0.75 * ball for cube, ball in ((a, x), (b, y), (c, z)))
                # To a bean, in millimetres: its long axis is bent about the hilum.
                turn = 1.2 * y
                side = 26 * x + 38
                points.append((side * math.cos(turn) - 38, side * math.sin(turn), 20 * z))
    points = [tuple(round(v, 3) for v in p) for p in points]
    # The axes in the order they are walked; odd orders are turned over, so that all volumes are positive.
    order = [((0, 1, 2), 1), ((0, 2, 1), -1), ((1, 0, 2), -1), ((1, 2, 0), 1), ((2, 0, 1), 1), ((2, 1, 0), -1)]
    tets = []
    for i in range(n):
        for j in range(n):
            for k in range(n):
                middle = max(abs(2 * v + 1 - n) / n for v in (i, j, k))
                region = 1 if middle > 0.6 else 2
                if i < n * 0.4 and abs(2 * j + 1 - n) < 3 and abs(2 * k + 1 - n) < 3:
                    region = 3
                for axes, sign in order:
                    at, corners = [i, j, k], [number(i, j, k)]
                    for axis in axes:
                        at[axis] += 1
                        corners.append(number(*at))
                    tets.append((region, corners if sign > 0 else [corners[c] for c in (0, 2, 1, 3)]))
    half = n // 2
    trunk = [number(i, half, half) for i in range(half + 1)]
    up = [number(half, j, half) for j in range(half, n)]
    down = [number(half, j, half) for j in range(half, 0, -1)]
    lines = [pair for part in (trunk, up, down) for pair in zip(part, part[1:])]
    return points, lines, tets


def write_kidney(folder):
    points, lines, tets = kidney()
    names = [(1, 4, "artery"), (3, 1, "cortex"), (3, 2, "medulla"), (3, 3, "pelvis")]
    out = b"$MeshFormat\n2.2 1 8\n" + struct.pack("<i", 1) + b"\n$EndMeshFormat\n$PhysicalNames\n"
    out += f"{len(names)}\n".encode() + b"".join(f'{d} {t} "{name}"\n'.encode() for d, t, name in names)
    out += b"$EndPhysicalNames\n$Nodes\n" + f"{len(points)}\n".encode()
    out += b"".join(struct.pack("<i3d", k + 1, *p) for k, p in enumerate(points)) + b"\n$EndNodes\n$Elements\n"
    out += f"{len(lines) + len(tets)}\n".encode() + struct.pack("<3i", 1, len(lines), 2)
    element = 0
    for a, b in lines:
        element += 1
        out += struct.pack("<5i", element, 4, 4, a + 1, b + 1)
    out += struct.pack("<3i", 4, len(tets), 2)
    for region, corners in tets:
        element += 1
        out += struct.pack("<7i", element, region, region, *(c + 1 for c in corners))
    (folder / "kidney.msh").write_bytes(out + b"\n$EndElements\n")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    out = Path(sys.argv[1])
    write_cortex(out)
    write_ground(out)
    write_kidney(out)
