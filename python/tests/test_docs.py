"""Every docstring's examples, every example of docs/reference/python.md, and a docstring on everything."""

import doctest
import inspect
import os
from pathlib import Path

import pytest

import plexway as px
from plexway import _domain, _grid, _kinds, _make, _metrics, _results, _sources

SOURCE = Path(os.environ.get("PLEXWAY_SOURCE_DIR", Path(__file__).parents[2]))


@pytest.mark.parametrize("module", [px, _domain, _grid, _kinds, _make, _metrics, _results, _sources])
def test_docstrings(module):
    assert doctest.testmod(module).failed == 0


@pytest.mark.parametrize("page", ["docs/reference/python.md", "docs/coming-from.md"])
def test_pages(page):
    file = SOURCE / page
    ran = doctest.testfile(str(file), module_relative=False)
    assert ran.attempted > 0 and ran.failed == 0


@pytest.mark.parametrize("name", [n for n in px.__all__ if not n.startswith("_")])
def test_everything_is_told(name):
    thing = getattr(px, name)
    assert inspect.getdoc(thing)
    if inspect.isclass(thing) and issubclass(thing, (px.Domain, px.Field)):
        for member, value in vars(thing).items():
            if not member.startswith("_"):
                assert inspect.getdoc(value), member
