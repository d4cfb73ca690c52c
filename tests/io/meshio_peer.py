"""Another reader and writer of our formats, for meshio_test.cpp.

meshio_peer.py make FOLDER   writes the mesh of FOLDER/truth.txt in all forms that we read
meshio_peer.py check FOLDER FILE...   compares files in FOLDER with its truth.txt, bit by bit

A line of truth.txt: v x y z | d distance | l label | (e, f or t) corners.
"""

import os
import sys

import meshio
import numpy

KINDS = {"e": "line", "f": "triangle", "t": "tetra"}


def read_truth(folder):
    rows = {}
    with open(os.path.join(folder, "truth.txt"), encoding="ascii") as file:
        for line in file:
            kind, *fields = line.split()
            rows.setdefault(kind, []).append(fields)
    points = numpy.array(rows["v"], dtype=float)
    cells = [(KINDS[k], numpy.array(rows[k], dtype=int)) for k in "eft" if k in rows]
    data = {}
    if "d" in rows:
        data["distance"] = numpy.array(rows["d"], dtype=float).ravel()
    if "l" in rows:
        data["label"] = numpy.array(rows["l"], dtype=int).ravel()
    return points, cells, data


def make(folder):
    points, cells, _ = read_truth(folder)
    # Triangles beside the tetrahedra, which are to be passed over.
    mesh = meshio.Mesh(points, [("triangle", cells[0][1][:, :3].copy()), *cells])
    only = meshio.Mesh(points, cells)

    def write(name, what, **options):
        try:
            meshio.write(os.path.join(folder, name), what, **options)
        except ImportError as missing:  # lzma or h5py, say
            print(name, missing)

    for binary in (False, True):
        tail = "binary" if binary else "ascii"
        write(f"gmsh22_{tail}.msh", mesh, file_format="gmsh22", binary=binary)
        write(f"gmsh41_{tail}.msh", only, file_format="gmsh", binary=binary)
        write(f"legacy42_{tail}.vtk", mesh, file_format="vtk42", binary=binary)
        write(f"legacy51_{tail}.vtk", mesh, file_format="vtk", binary=binary)
        write(f"xml_{tail}.vtu", mesh, binary=binary, compression=None)
    write("xml_zlib.vtu", mesh, binary=True, compression="zlib")
    write("medit.mesh", mesh, file_format="medit", float_fmt=".17g")
    write("tetgen.node", only, file_format="tetgen", float_fmt=".17g")


def check(folder, names):
    points, cells, data = read_truth(folder)
    for name in names:
        mesh = meshio.read(os.path.join(folder, name))

        def same(what, have, want):
            have = numpy.asarray(have).reshape(numpy.shape(want))
            if not numpy.array_equal(have, want):
                sys.exit(f"{name}: {what} differ:\n{have}\n{want}")

        same("points", mesh.points, points)
        kinds = [block.type for block in mesh.cells]
        # meshio counts no cells where a file has only points.
        want = [] if name.endswith(".ply") and cells[0][0] == "tetra" else cells
        if kinds != [kind for kind, _ in want]:
            sys.exit(f"{name}: holds {kinds}")
        for block, (kind, corners) in zip(mesh.cells, want):
            same(kind, block.data, corners)
        for key, values in data.items():
            key = "quality" if name.endswith(".ply") and key == "distance" else key
            same(key, mesh.point_data[key], values)


if __name__ == "__main__":
    if sys.argv[1] == "make":
        make(sys.argv[2])
    else:
        check(sys.argv[2], sys.argv[3:])
