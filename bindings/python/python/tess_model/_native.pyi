"""The types of the compiled part. Its docstrings have the documentation."""

from collections.abc import Iterable, Iterator, Sequence
from os import PathLike
from typing import Any, Literal, Optional, Union, final

import numpy as np
import numpy.typing as npt

from .values import (
    Batch,
    BatchCounts,
    Counts,
    FactorContext,
    Group,
    Placement,
    PointOrigin,
    PrimitiveOrigin,
    ProcessedFactor,
    Report,
    RulesReport,
    SignalDifference,
)

__version__: str

__all__ = [
    "Cases",
    "Coverage",
    "Patch",
    "Record",
    "Tessellator",
    "VectorFile",
    "__version__",
    "check",
    "check_device",
    "check_rules",
    "context",
    "exclusions",
    "generate",
    "place",
    "process_factor",
    "write_vectors",
]

_Floats = Union[float, Sequence[float], npt.NDArray[np.floating[Any]]]
_Bits = Union[int, Sequence[int], npt.NDArray[np.integer[Any]]]
_Path = Union[str, PathLike[str]]
_Array = npt.NDArray[Any]
_Words = Union[npt.NDArray[np.integer[Any]], Sequence[int], Sequence[Sequence[int]]]
_Answer = tuple[Patch, _Words, _Words]

@final
class Patch:
    def __new__(
        cls,
        domain: str,
        outer: _Floats,
        inner: Optional[_Floats] = None,
        *,
        partitioning: str = "integer",
        output: str = "triangle_cw",
        split: str = "ruler",
    ) -> Patch: ...
    @staticmethod
    def from_bits(
        domain: str,
        outer: _Bits,
        inner: Optional[_Bits] = None,
        *,
        partitioning: str = "integer",
        output: str = "triangle_cw",
        split: str = "ruler",
    ) -> Patch: ...
    @staticmethod
    def from_case(line: str) -> Patch: ...
    @property
    def case(self) -> str: ...
    @property
    def command(self) -> str: ...
    @property
    def domain(self) -> str: ...
    @property
    def partitioning(self) -> str: ...
    @property
    def output(self) -> str: ...
    @property
    def split(self) -> str: ...
    @property
    def factors(self) -> tuple[float, ...]: ...
    @property
    def factor_bits(self) -> tuple[int, ...]: ...
    @property
    def kind(self) -> Literal["culled", "minimum", "regular"]: ...
    @property
    def counts(self) -> Counts: ...
    @property
    def processed(self) -> tuple[ProcessedFactor, ...]: ...
    @property
    def points(self) -> npt.NDArray[np.uint32]: ...
    @property
    def points_f32(self) -> npt.NDArray[np.float32]: ...
    @property
    def indices(self) -> npt.NDArray[np.uint32]: ...
    def point(self, i: int) -> tuple[int, int]: ...
    def primitive(self, t: int) -> tuple[int, ...]: ...
    def locate_point(self, i: int) -> PointOrigin: ...
    def locate_primitive(self, t: int) -> PrimitiveOrigin: ...
    def place(self, factor: str, p: int) -> Placement: ...
    def explain(
        self,
        *,
        point: Optional[int] = None,
        primitive: Optional[int] = None,
        factor: Optional[int] = None,
    ) -> str: ...
    def explanation(
        self,
        *,
        point: Optional[int] = None,
        primitive: Optional[int] = None,
        factor: Optional[int] = None,
    ) -> dict[str, Any]: ...
    def differences(
        self,
        observed: dict[str, int],
        *,
        point: Optional[int] = None,
        primitive: Optional[int] = None,
        factor: Optional[int] = None,
    ) -> tuple[SignalDifference, ...]: ...
    def to_svg(self, *, indices: bool = False, colours: str = "plain", size: int = 800) -> str: ...
    def listing(self) -> str: ...
    def _repr_svg_(self) -> str: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __reduce__(self) -> tuple[Any, tuple[str]]: ...
    def __copy__(self) -> Patch: ...
    def __deepcopy__(self, _memo: dict[Any, Any]) -> Patch: ...

@final
class Tessellator:
    def __new__(
        cls,
        partitioning: str = "integer",
        output: str = "triangle_cw",
        split: str = "ruler",
        threads: int = 1,
    ) -> Tessellator: ...
    @property
    def level(self) -> str: ...
    @property
    def threads(self) -> int: ...
    def __reduce__(self) -> tuple[type[Tessellator], tuple[str, str, str, int]]: ...
    def count(self, domain: str, factors: npt.ArrayLike) -> BatchCounts: ...
    def tessellate(
        self,
        domain: str,
        factors: npt.ArrayLike,
        *,
        points: str = "float32",
        indices: str = "uint32",
        base_vertex: Optional[int] = None,
        out: Optional[tuple[_Array, ...]] = None,
    ) -> Batch: ...

@final
class Coverage:
    def __new__(cls) -> Coverage: ...
    def record(self, patches: Union[Patch, Iterable[Patch]]) -> int: ...
    def record_context(self, factor: int, parity: str, split_order: str = "ruler") -> None: ...
    def add(self, bin: str, hits: int = 1) -> None: ...
    def merge(self, other: Coverage) -> None: ...
    @property
    def bins(self) -> dict[str, int]: ...
    @property
    def groups(self) -> dict[str, Group]: ...
    @property
    def missed(self) -> list[str]: ...
    def holes(self, exclude: Optional[Iterable[str]] = None) -> list[str]: ...
    def report(self, exclude: Optional[Iterable[str]] = None) -> str: ...
    def to_ucis(self) -> str: ...
    @staticmethod
    def from_ucis(text: str) -> Coverage: ...
    def write(self, path: _Path) -> None: ...
    @staticmethod
    def read(path: _Path) -> Coverage: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __reduce__(self) -> tuple[type[Coverage], tuple[()], tuple[str, Optional[str]]]: ...
    def __setstate__(self, state: tuple[str, Optional[str]], /) -> None: ...

@final
class Cases:
    def __iter__(self) -> Iterator[Patch]: ...
    def __next__(self) -> Patch: ...

@final
class Record:
    @property
    def line(self) -> int: ...
    @property
    def text(self) -> Optional[str]: ...
    @property
    def patch(self) -> Optional[Patch]: ...
    @property
    def points(self) -> Optional[npt.NDArray[np.uint32]]: ...
    @property
    def indices(self) -> Optional[npt.NDArray[np.uint32]]: ...

@final
class VectorFile:
    def __new__(cls, path: _Path) -> VectorFile: ...
    @property
    def kind(self) -> str: ...
    @property
    def count(self) -> Optional[int]: ...
    @property
    def source(self) -> str: ...
    def __iter__(self) -> Iterator[Record]: ...
    def __next__(self) -> Record: ...

def context(factor: int, parity: str, split_order: str = "ruler") -> FactorContext: ...
def process_factor(
    factor: float, partitioning: str = "integer", *, role: str = "outer", split: str = "ruler"
) -> Optional[ProcessedFactor]: ...
def place(factor: int, parity: str, p: int, split_order: str = "ruler") -> Placement: ...
def generate(
    level: int = 1,
    *,
    seed: int = 1,
    count: Optional[int] = None,
    domain: Optional[str] = None,
    partitioning: Optional[str] = None,
    output: Optional[str] = None,
    split: Optional[str] = None,
    shard: Optional[tuple[int, int]] = None,
    rules: bool = False,
) -> Cases: ...
def exclusions(
    *,
    domain: Union[str, Iterable[str], None] = None,
    partitioning: Union[str, Iterable[str], None] = None,
    output: Union[str, Iterable[str], None] = None,
    split: Union[str, Iterable[str], None] = None,
) -> list[str]: ...
def write_vectors(path: _Path, patches: Iterable[Patch], *, form: str = "patches") -> None: ...
def check(
    path: _Path,
    *,
    tested: str = "auto",
    order: str = "exact",
    elements: str = "primitives",
    conversion: str = "exact",
    denormals: str = "keep",
    coverage: Optional[Coverage] = None,
    cases: Optional[Iterable[Patch]] = None,
) -> Report: ...
def check_device(
    answers: Iterable[_Answer],
    *,
    order: str = "exact",
    elements: str = "primitives",
    conversion: str = "exact",
    denormals: str = "keep",
    cases: Optional[Iterable[Patch]] = None,
) -> Report: ...
def check_rules(answers: Union[_Path, Iterable[_Answer]], specification: str) -> RulesReport: ...
