"""An independent reader of .glb and .gltf, NPY and VTU, for cells_test.cpp and convert_test.cpp.

gltf_peer.py check FILE --mode M --vertices N --cells N [--distance ...] [--label ...]
    parses FILE and checks the rules of the glTF 2.0 specification that concern it
gltf_peer.py numpy FILE VALUES          NumPy's own reader
gltf_peer.py matrix NPY CSV             the same n x n numbers in both
gltf_peer.py vtk FOLDER VALUES LABELS   VTK's readers of d.vtu and d.glb, if VTK is installed
"""

import argparse
import base64
import json
import struct
import sys

import numpy

TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
CORNERS = {0: 1, 1: 2, 4: 3}


def need(good, what):
    if not good:
        sys.exit(what)


def numbers(text):
    return numpy.array([float(part) for part in text.split(",")])


def load(name):
    with open(name, "rb") as file:
        raw = file.read()
    if name.endswith(".gltf"):
        document = json.loads(raw.decode("utf-8"))
        head, data = document["buffers"][0]["uri"].split(",", 1)
        need(head == "data:application/octet-stream;base64", head)
        return document, base64.b64decode(data, validate=True)
    magic, version, length = struct.unpack_from("<4sII", raw)
    need(magic == b"glTF" and version == 2 and length == len(raw), "header")
    size, kind = struct.unpack_from("<I4s", raw, 12)
    need(kind == b"JSON" and size % 4 == 0, "JSON chunk")
    document = json.loads(raw[20 : 20 + size].decode("utf-8"))
    need("uri" not in document["buffers"][0], "uri in .glb")
    size2, kind = struct.unpack_from("<I4s", raw, 20 + size)
    need(kind == b"BIN\0" and size2 % 4 == 0 and 28 + size + size2 == len(raw), "BIN chunk")
    return document, raw[28 + size :]


def array(document, data, index):
    accessor = document["accessors"][index]
    view = document["bufferViews"][accessor["bufferView"]]
    kind, width = numpy.dtype(TYPES[accessor["componentType"]]), WIDTHS[accessor["type"]]
    need(view["byteOffset"] % kind.itemsize == 0, "an accessor is not aligned")
    count = accessor["count"] * width
    need(accessor["count"] > 0 and count * kind.itemsize <= view["byteLength"], "too long")
    need(view["byteOffset"] + view["byteLength"] <= document["buffers"][0]["byteLength"], "view")
    values = numpy.frombuffer(data, kind, count, view["byteOffset"]).reshape(-1, width)
    need(numpy.isfinite(values).all(), "a number is not finite")
    return accessor, view, values


def check(options):
    document, data = load(options.file)
    need(document["asset"]["version"] == "2.0", "version")
    need(0 <= len(data) - document["buffers"][0]["byteLength"] < 4, "length of the buffer")
    (node,) = document["nodes"]
    need(document["scenes"][document["scene"]]["nodes"] == [0], "scene")
    (primitive,) = document["meshes"][node["mesh"]]["primitives"]
    need(primitive["mode"] == options.mode, "mode")
    need(0 <= primitive["material"] < len(document["materials"]), "material")
    attributes = primitive["attributes"]

    accessor, view, at = array(document, data, attributes["POSITION"])
    need(accessor["type"] == "VEC3" and accessor["componentType"] == 5126, "positions")
    need(view["target"] == 34962 and len(at) == options.vertices, f"{len(at)} vertices")
    need((numpy.float32(accessor["min"]) == at.min(axis=0)).all(), "min")
    need((numpy.float32(accessor["max"]) == at.max(axis=0)).all(), "max")
    shift = numpy.array(node.get("translation", [0, 0, 0]))
    if options.low:
        need(numpy.allclose(at.min(axis=0) + shift, numbers(options.low), 1e-12, 1e-6), "low")
        need(numpy.allclose(at.max(axis=0) + shift, numbers(options.high), 1e-12, 1e-6), "high")

    accessor, view, corners = array(document, data, primitive["indices"])
    need(accessor["type"] == "SCALAR" and view["target"] == 34963, "indices")
    need(corners.max() < len(at), "an index is out of range")
    need(len(corners) == CORNERS[options.mode] * options.cells, f"{len(corners)} indices")
    if options.plain:
        need(set(attributes) == {"POSITION"}, str(attributes))
        return
    accessor, _, colour = array(document, data, attributes["COLOR_0"])
    need(accessor["normalized"] and accessor["type"] == "VEC4", "colours")
    need(len(colour) == len(at) and (colour[:, 3] == 65535).all(), "alpha")
    for name, want in (("_DISTANCE", options.distance), ("_LABEL", options.label)):
        if want:
            accessor, _, values = array(document, data, attributes[name])
            need(numpy.array_equal(values.ravel(), numbers(want)), f"{name}: {values.ravel()}")


def read_vtk(folder, values, labels):
    try:
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkIOGeometry import vtkGLTFReader
        from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
    except ImportError:
        print("VTK is not installed")
        return
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(folder + "/d.vtu")
    reader.Update()
    data = reader.GetOutput().GetPointData()
    need(numpy.array_equal(vtk_to_numpy(data.GetArray("distance")), numbers(values)), "distance")
    need(numpy.array_equal(vtk_to_numpy(data.GetArray("label")), numbers(labels)), "label")
    reader = vtkGLTFReader()
    reader.SetFileName(folder + "/d.glb")
    reader.Update()
    blocks = reader.GetOutput()
    while not hasattr(blocks, "GetPolys"):
        blocks = blocks.GetBlock(0)
    raw = blocks.GetPointData().GetArray("_DISTANCE")  # VTK 9.1 has it, older ones pass it over
    if raw is not None:
        want = [-1 if v == numpy.inf else v for v in numbers(values)]
        need(numpy.array_equal(vtk_to_numpy(raw), want), "_DISTANCE")
    need(blocks.GetNumberOfPoints() == 4 and blocks.GetNumberOfPolys() == 2, str(blocks))


if __name__ == "__main__":
    if sys.argv[1] == "numpy":
        need(numpy.array_equal(numpy.load(sys.argv[2]), numbers(sys.argv[3])), "values differ")
    elif sys.argv[1] == "matrix":
        square, table = numpy.load(sys.argv[2]), numpy.loadtxt(sys.argv[3], delimiter=",")
        need(square.ndim == 2 and numpy.array_equal(square, table), "values differ")
    elif sys.argv[1] == "vtk":
        read_vtk(*sys.argv[2:])
    else:
        parser = argparse.ArgumentParser()
        parser.add_argument("what")
        parser.add_argument("file")
        for name in ("mode", "vertices", "cells"):
            parser.add_argument("--" + name, type=int, required=True)
        for name in ("distance", "label", "low", "high"):
            parser.add_argument("--" + name)
        parser.add_argument("--plain", action="store_true")
        check(parser.parse_args())
