#!/usr/bin/env python3
"""bench/peers/run with programs that speak its protocol well and badly: BUILD [test names]."""
import json
import os
import stat
import subprocess
import sys
import tempfile
import unittest

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
sys.dont_write_bytecode = True
import catalogue  # noqa: E402
import domains  # noqa: E402
import measure  # noqa: E402
import page  # noqa: E402

BUILD = ""

# The truth of a flat convex sheet, and what may go wrong with it.
PROGRAM = """#!{python}
import os, sys, time
import numpy as np
sys.path.insert(0, {adapters!r})
from common import arguments, read_off, write
domain, sources, out = arguments()
points, _ = read_off(domain)
rows = [np.linalg.norm(points - points[s], axis=1) for s in sources]
{what}
write(out, rows)
"""
FAKES = {
    "right": "",
    "short by a tenth": "rows = [0.9 * row for row in rows]",
    "as numpy": "np.save(out + '.npy', np.array(rows)); os.rename(out + '.npy', out); sys.exit(0)",
    "refuses": "print('not today', file=sys.stderr); sys.exit(3)",
    "crashes": "os.abort()",
    "hangs": "time.sleep(100)",
    "leaves a child that hangs": "os.spawnlp(os.P_NOWAIT, 'sleep', 'sleep', '100')",
    "spins": "while True: pass",
    "forgets a row": "rows = rows[1:]",
    "writes nothing": "sys.exit(0)",
    "says NaN": "rows[0][:7] = np.nan",
    "says unreached": "rows[0][-2:] = np.inf",
}


def sheet(folder, n=12):
    """A flat square, its answers beside it from a corner, two ways to have it wrong left out."""
    x, y = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n))
    points = np.stack([x, y, 0 * x], -1).reshape(-1, 3)
    v = np.arange(n * n).reshape(n, n)
    a, b, c, d = (part.ravel() for part in (v[:-1, :-1], v[:-1, 1:], v[1:, :-1], v[1:, 1:]))
    domain = domains.Domain("sheet", "surface", points,
                            np.concatenate([np.stack([a, b, c], -1), np.stack([b, d, c], -1)]))
    name = os.path.join(folder, "sheet.obj")
    domains.write_obj(domain, name)
    np.savetxt(os.path.join(folder, "sheet.v0.txt"), np.linalg.norm(points - points[0], axis=1))
    return name


class Run(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        folder = cls.kept.name
        words = [sys.executable, os.path.join(HERE, "run"), BUILD, os.path.join(folder, "out"), sheet(folder),
                 "--no-grids", "--turns", "1", "--sources", "3", "--limit", "0.6"]
        for i, (name, what) in enumerate(FAKES.items()):
            program = os.path.join(folder, f"fake{i}")
            with open(program, "w", encoding="utf-8") as file:
                file.write(PROGRAM.format(python=sys.executable, adapters=catalogue.ADAPTERS, what=what))
            os.chmod(program, os.stat(program).st_mode | stat.S_IXUSR)
            words += ["--peer", f"fake {name}={program}"]
        words += ["--peer", f"fake that is not there={folder}/none", "--only", "fake", "--only", "plexway, exact"]
        cls.page = os.path.join(folder, "page.md")
        with open(cls.page, "w", encoding="utf-8") as file:
            file.write("before\n<!-- measured -->\nold\n<!-- end of measured -->\nafter\n")
        done = subprocess.run([*words, "--page", cls.page], capture_output=True, text=True, check=False)
        if done.returncode:
            raise AssertionError(done.stderr)
        with open(os.path.join(folder, "out", "peers.json"), encoding="utf-8") as file:
            cls.rows = {row["peer"].removeprefix("fake "): row for row in json.load(file)["rows"]}

    @classmethod
    def tearDownClass(cls):
        cls.kept.cleanup()

    def test_answers_are_judged(self):
        for name in ("right", "as numpy", "leaves a child that hangs", "plexway, exact"):
            row = self.rows[name]
            self.assertNotIn("failure", row, name)
            self.assertLess(row["worst"], 1e-9, name)
            self.assertEqual(row["wrong"], 0, name)
            self.assertGreater(row["first"], 0, name)
            self.assertGreater(row["peak"], 1e6, name)
        wrong = self.rows["short by a tenth"]
        self.assertAlmostEqual(wrong["mean"], 0.1, places=9)
        self.assertAlmostEqual(wrong["worst"], 0.1, places=9)
        self.assertAlmostEqual(wrong["below"], -0.1, places=9)

    def test_values_that_are_no_distances_are_counted(self):
        self.assertEqual(self.rows["says NaN"]["wrong"], 7)
        self.assertEqual(self.rows["says unreached"]["wrong"], 2)

    def test_failures_are_rows(self):
        for name, said in {"refuses": "ended with 3: not today", "crashes": "crashed: Aborted",
                           "hangs": "no end after 6 s", "forgets a row": "wrote 0 numbers, not 1 x 144", "writes nothing": "wrote no answer",
                           "that is not there": "No such file"}.items():
            self.assertIn(said, self.rows[name]["failure"], name)
            self.assertNotIn("mean", self.rows[name], name)
        # On a machine that is busy enough the clock comes first.
        self.assertRegex(self.rows["spins"]["failure"], "of the processor|no end after")

    def test_the_page(self):
        with open(self.page, encoding="utf-8") as file:
            words = file.read()
        self.assertTrue(words.startswith("before\n<!-- measured -->\n") and words.endswith("\nafter\n"))
        self.assertNotIn("old", words)
        for name in FAKES:
            self.assertIn(f"| fake {name} |", words)
        with self.assertRaises(ValueError):
            page.replace_between("no marks", "<!-- measured -->", "<!-- end of measured -->", "")


class CommandLine(unittest.TestCase):
    def test_a_wrong_command_line_is_told(self):
        for words, said in ((["--peer", "x:stl=y"], "--peer x:stl=y"),
                            (["--truth-by", "nobody"], "no peer that is here is called nobody")):
            with tempfile.TemporaryDirectory() as folder:
                done = subprocess.run([sys.executable, os.path.join(HERE, "run"), BUILD, folder, *words],
                                      capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 1)
            self.assertIn(said, done.stderr.splitlines()[-1])


class Parts(unittest.TestCase):
    def test_ways_around_the_wall(self):
        """The closed form against Dijkstra: never above edges' paths, and equal to the taut string at some points."""
        for domain in (domains.wall(21), domains.wall(11, 4)):
            (source, exact), = domain.truths.items()
            self.assertEqual(exact[source], 0)
            self.assertEqual(len(exact), len(domain.points))
            self.assertEqual(int(domain.grid[0].sum()), len(domain.points))
            self.assertEqual(set(np.unique(domain.cells)), set(range(len(domain.points))))
            edges = np.vstack([domain.cells[:, [a, b]] for a in range(domain.cells.shape[1]) for b in range(a)])
            length = np.linalg.norm(domain.points[edges[:, 0]] - domain.points[edges[:, 1]], axis=1)
            jump = np.abs(exact[edges[:, 0]] - exact[edges[:, 1]])
            self.assertTrue(np.all(jump <= length + 1e-12))  # 1-Lipschitz along edges: no wrong branch
            straight = np.linalg.norm(domain.points - domain.points[source], axis=1)
            self.assertTrue(np.all(exact >= straight - 1e-12))
        flat = domains.wall(21)
        (source, exact), = flat.truths.items()
        at = int(np.argmin(np.linalg.norm(flat.points - [0.6, 0, 0], axis=1)))  # the foot of the wall, behind it
        around = np.hypot(0.3, 0.5) + 0.2 + 0.7
        self.assertAlmostEqual(exact[at], around, places=12)

    def test_further_sources_are_spread_and_exact_ones_first(self):
        domain = domains.Domain("d", "surface", np.zeros((9, 3)), np.array([[0, 1, 2], [4, 5, 6]]),
                                {5: np.zeros(9), 1: np.zeros(9)})
        found = domain.sources(4)
        self.assertEqual(found[:2], [1, 5])
        self.assertEqual(len(set(found)), 4)
        self.assertTrue(set(found) <= {0, 1, 2, 4, 5, 6})
        self.assertEqual(len(domain.sources(50)), 6)

    def test_errors(self):
        truth = {0: np.array([0, 1, 2, np.inf, np.nan])}
        found = measure.errors(np.array([[0, 1.1, 1.8, 5, 7]]), [0], truth)
        self.assertAlmostEqual(found["mean"], 0.1)
        self.assertAlmostEqual(found["below"], -0.1)
        self.assertEqual(found["wrong"], 1)
        found = measure.errors(np.array([[.5, 1, 2, np.inf, 7]]), [0], truth)
        self.assertEqual((found["wrong"], found["worst"]), (1, 0))

    def test_where_a_peer_is_better(self):
        rows = [{"peer": "plexway", "mesh": "m", "mean": 1e-3, "first": 1, "peak": 10},
                {"peer": "theirs", "mesh": "m", "mean": 1e-4, "first": 2, "peak": 10.5}]
        said = page.better(rows, "plexway")
        self.assertIn("mean error on 1 of 1 (at most 10 x, m)", said)
        self.assertNotIn("first answer", said)
        self.assertNotIn("memory", said)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    BUILD = os.path.abspath(sys.argv.pop(1))
    unittest.main()
