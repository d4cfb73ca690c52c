"""What the adapters share. Each is a program: ADAPTER [PROGRAM] DOMAIN SOURCES OUT (see bench/peers/run --protocol)."""
import sys

import numpy as np


def arguments(count=3):
    """The last words of the command line: domain, sources (as numbers), out; programs before them."""
    words = sys.argv[1:]
    if len(words) < count:
        sys.exit("usage: " + sys.argv[0] + " [PROGRAM...] DOMAIN SOURCES OUT")
    *programs, domain, sources, out = words
    with open(sources, encoding="ascii") as file:
        return (*programs, domain, [int(word) for word in file.read().split()], out)


def read_off(name):
    with open(name, encoding="ascii") as file:
        file.readline()
        vertices, faces, _ = map(int, file.readline().split())
        numbers = np.fromstring(file.read(), sep=" ")
    return (numbers[:3 * vertices].reshape(-1, 3),
            numbers[3 * vertices:].reshape(faces, 4)[:, 1:].astype(np.int64))


def read_medit(name):
    with open(name, encoding="ascii") as file:
        words = file.read().split()
    at, cells_at = words.index("Vertices"), words.index("Tetrahedra")
    points = np.array(words[at + 2:at + 2 + 4 * int(words[at + 1])], float).reshape(-1, 4)[:, :3]
    cells = np.array(words[cells_at + 2:cells_at + 2 + 5 * int(words[cells_at + 1])], int)
    return points, cells.reshape(-1, 5)[:, :4] - 1


def write(out, rows):
    """A row for each source, as plain doubles, each written when it is there."""
    with open(out, "wb") as file:
        for row in rows:
            file.write(np.ascontiguousarray(row, "<f8").tobytes())
