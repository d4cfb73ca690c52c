"""The package and its stubs agree, by mypy."""

import subprocess
import sys
from pathlib import Path

import pytest

import plexway

pytest.importorskip("mypy")


def checked(*files):
    return subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--no-error-summary", *files],
        capture_output=True,
        text=True,
    )


def test_package(tmp_path):
    ran = checked("--cache-dir", str(tmp_path), str(Path(plexway.__file__).parent))
    assert ran.returncode == 0, ran.stdout + ran.stderr


def test_what_a_user_writes(tmp_path):
    good = tmp_path / "good.py"
    good.write_text(
        "from typing import Any\nimport numpy as np\nimport plexway\n"
        "s = plexway.Surface(np.zeros((3, 3)), [[0, 1, 2]])\n"
        "d: np.ndarray[Any, Any] = s.distance(0, radius=2.0)\n"
        "length: float = s.path(0, 1).length\n"
    )
    bad = tmp_path / "bad.py"
    bad.write_text("import plexway\nplexway.read('a.obj').distance(0, radios=2)\n")
    cache = ("--cache-dir", str(tmp_path / "cache"))
    assert checked(*cache, str(good)).returncode == 0, checked(*cache, str(good)).stdout
    ran = checked(*cache, str(bad))
    assert ran.returncode != 0 and "radios" in ran.stdout
