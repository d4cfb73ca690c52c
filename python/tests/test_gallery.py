"""Each script of the gallery runs; what it promises it asserts itself."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(os.environ.get("PLEXWAY_SOURCE_DIR", Path(__file__).parents[2]))
SCRIPTS = sorted((ROOT / "python" / "gallery").glob("*.py"))


def test_there_are_five():
    assert len(SCRIPTS) == 5


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda s: s.stem)
def test_script(script):
    ran = subprocess.run(
        [sys.executable, "-W", "error", str(script)], cwd=ROOT, capture_output=True, text=True
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert ran.stdout
