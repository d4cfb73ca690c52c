"""The native module; use the package."""

from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Union

from ._arrays import Array

__version__: str

class Error(Exception):
    """Base of all errors of plexway; the text is one line that says what to do."""

class InputError(Error, ValueError):
    """A file or an array is not what it must be."""

class PrecisionError(InputError):
    """Sizes that single precision cannot hold beside each other: build the domain with
    precision='double'."""

class UsageError(Error, ValueError):
    """A call asks for something that makes no sense."""

class NotBuilt(Error, RuntimeError):
    """The feature exists, but not in this build or here."""

class EndlessError(Error, ArithmeticError):
    """A solve that does not end, because lengths are no metric, was stopped."""

class Cancelled(Error):
    """A progress function returned False."""


_Report = Optional[Callable[[float], Any]]
_Path = Tuple[Optional[Array], Array, Array, float, int, Array]

class Point:
    def __init__(self, *place: Any) -> None: ...
    @property
    def vertex(self) -> Optional[int]: ...
    @property
    def simplex(self) -> Optional[int]: ...
    @property
    def barycentric(self) -> List[float]: ...
    @property
    def offset(self) -> float: ...

class VertexSet:
    def __init__(self, vertices: Any, offsets: Any, offset: float) -> None: ...
    @property
    def points(self) -> List[Point]: ...

class Ball:
    def __init__(self, centre: Point, radius: float, offset: float) -> None: ...

class Curve:
    def __init__(self, points: Sequence[Point], offset: float) -> None: ...
    @property
    def points(self) -> List[Point]: ...

class WholeSimplex:
    def __init__(self, simplex: int, offset: float) -> None: ...

_Source = Union[Point, VertexSet, Ball, Curve, WholeSimplex]

class SolveArguments:
    def __init__(
        self, executor: str, threads: int, radius: float, visibility: str, accuracy: Any
    ) -> None: ...

class Domain:
    @property
    def kind(self) -> str: ...
    @property
    def dimension(self) -> int: ...
    @property
    def simplex_name(self) -> str: ...
    @property
    def vertex_count(self) -> int: ...
    @property
    def simplex_count(self) -> int: ...
    @property
    def given_simplices(self) -> int: ...
    @property
    def components(self) -> int: ...
    @property
    def mean_edge(self) -> float: ...
    @property
    def bytes(self) -> int: ...
    @property
    def build_seconds(self) -> float: ...
    @property
    def refracting_edges(self) -> int: ...
    @property
    def double(self) -> bool: ...
    @property
    def file(self) -> str: ...
    @property
    def file_report(self) -> Dict[str, Any]: ...
    @property
    def triangulation(self) -> Dict[str, Any]: ...
    @property
    def wanted_triangulation(self) -> str: ...
    @property
    def notes(self) -> Tuple[str, ...]: ...
    @property
    def doubts(self) -> Tuple[str, ...]: ...
    @property
    def violations(self) -> Tuple[int, int]: ...
    @property
    def measured(self) -> Optional[Array]: ...
    @property
    def refracts(self) -> bool: ...
    @property
    def positions(self) -> Optional[Array]: ...
    @property
    def simplices(self) -> Optional[Array]: ...
    @property
    def all_simplices(self) -> Optional[Array]: ...
    @property
    def mask(self) -> Optional[Tuple[Array, Array]]: ...
    @property
    def merge(self) -> Optional[float]: ...
    @property
    def lengths(self) -> Optional[Array]: ...
    @property
    def parts(self) -> Any: ...
    @property
    def cloud(self) -> Optional[Dict[str, Any]]: ...
    def corners(self, simplex: int) -> List[int]: ...
    def closest(self, point: Sequence[float]) -> Tuple[Point, float]: ...
    def position(self, point: Point) -> List[float]: ...
    def joined(self, points: Sequence[Point], offset: float) -> Curve: ...
    def boundary(self, offset: float) -> _Source: ...
    def write_field(self, out: str, distance: Any, label: Any) -> None: ...
    def keep(self, out: str) -> None: ...

class Field:
    @property
    def distance(self) -> Array: ...
    @property
    def bytes(self) -> int: ...
    @property
    def notes(self) -> Tuple[str, ...]: ...
    @property
    def doubts(self) -> Tuple[str, ...]: ...
    def label(self) -> Array: ...
    def trace(self, point: Point, margin: Optional[float]) -> _Path: ...
    def at(self, points: Sequence[Point], level: str) -> Array: ...
    def gradient(self) -> Array: ...

def openmp_built() -> bool: ...
def from_arrays(
    kind: str, positions: Any, vertices: Any, simplices: Any, lengths: Any, **options: Any
) -> Domain: ...
def from_simplices(
    positions: Any,
    vertices: Any,
    simplices: Any,
    dimension: int,
    axes: int,
    lengths: Any,
    **options: Any,
) -> Domain: ...
def from_points(positions: Any, normals: Any, original: Any, **options: Any) -> Domain: ...
def from_parts(parts: Sequence[Any], tolerance: float, **options: Any) -> Domain: ...
def read(
    files: Sequence[str], tolerance: float, kind: Optional[str], **options: Any
) -> Domain: ...
def known_formats() -> str: ...
def read_labels(file: str, vertices: int) -> Array: ...
def solve(
    domain: Domain,
    sources: Sequence[_Source],
    arguments: SolveArguments,
    labels: bool,
    errors: bool,
    progress: _Report,
) -> Tuple[Array, Any, Any, Tuple[str, ...]]: ...
def solve_each(
    domain: Domain,
    sources: Sequence[_Source],
    arguments: SolveArguments,
    out: Array,
    columns: Any,
    progress: _Report,
) -> Tuple[int, int, Tuple[str, ...]]: ...
def near(
    domain: Domain,
    sources: Sequence[_Source],
    columns: Any,
    radius: float,
    nearest: Optional[int],
    arguments: SolveArguments,
    progress: _Report,
) -> Tuple[Array, Array, Array, Tuple[str, ...]]: ...
def pairs_file(
    domain: Domain,
    sources: Sequence[_Source],
    columns: Any,
    out: str,
    radius: float,
    nearest: Optional[int],
    type: str,
    block: int,
    restart: bool,
    arguments: SolveArguments,
    progress: _Report,
) -> Tuple[str, ...]: ...
def path_field(
    domain: Domain, sources: Sequence[_Source], arguments: SolveArguments, progress: _Report
) -> Field: ...
def find_paths(
    domain: Domain,
    sources: Sequence[_Source],
    targets: Sequence[Point],
    margin: Optional[float],
    progress: _Report,
) -> List[_Path]: ...
def shortened(domain: Domain, points: Sequence[Point]) -> _Path: ...
def isolines(domain: Domain, distance: Any, values: Any) -> List[_Path]: ...
def isosurfaces(
    domain: Domain, distance: Any, values: Any
) -> Tuple[Array, Array, Array]: ...
def poisson(
    domain: Domain,
    radius: float,
    count: int,
    seed: int,
    at_vertices: bool,
    by_simplices: bool,
    spacing: Any,
    progress: _Report,
) -> Tuple[List[Point], float, bool]: ...
def farthest(
    domain: Domain, start: Sequence[_Source], count: int, radius: float, progress: _Report
) -> Tuple[List[Point], Array, float]: ...
def cvt(
    domain: Domain,
    seeds: Sequence[_Source],
    iterations: int,
    tolerance: float,
    progress: _Report,
) -> Tuple[List[Point], Array, Array, Array, bool]: ...
def picture(
    domain: Domain,
    distance: Any,
    sources: Sequence[Point],
    paths: Sequence[Any],
    width: int,
    height: int,
    view: Optional[Tuple[float, float]],
    isolines: Optional[int],
    map: str,
    transparent: bool,
    title: str,
    cut: bool,
) -> Array: ...
def page(
    domain: Domain,
    file: str,
    distance: Any,
    sources: Sequence[Point],
    paths: Sequence[Any],
    title: str,
    map: str,
) -> None: ...
