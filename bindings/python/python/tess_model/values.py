"""The model's results: named tuples.

Numbers are exact. ``16.16`` is an integer in units of 1/65536, and so is ``15.16``, for factors.
``bits`` are those of a binary32 number.
"""

from typing import Any, NamedTuple, Optional

import numpy as np
import numpy.typing as npt


class Counts(NamedTuple):
    """Output sizes of a patch (specification, section 12.6)."""

    points: int
    """Domain points, 0..4225."""
    primitives: int
    """Points, lines or triangles."""
    indices: int
    """1, 2 or 3 for each primitive, 0..24576."""


class FactorContext(NamedTuple):
    """The numbers that place the points of an edge with this factor (specification, section 4)."""

    parity: str
    """``even`` or ``odd``: the number of segments."""
    inv_floor: int
    """Length of a segment of the coarser subdivision, 16 fraction bits."""
    inv_ceil: int
    """Length of a segment of the finer subdivision, 16 fraction bits."""
    fraction: int
    """Weight of the finer subdivision, 16 fraction bits, below 0x10000."""
    half_points: int
    """Points on a half edge, without the midpoint of an even edge: 1..32."""
    split: int
    """The position on the half edge that is splitting, or ``half_points + 1`` if none is: 0..33."""
    points: int
    """Points on the edge: 2..65."""


class ProcessedFactor(NamedTuple):
    """One factor after each step of factor processing (specification, section 3)."""

    name: str
    """``density``, ``detail``, ``u0``, ``v0``, ``w0``, ``u1``, ``v1``, ``inside``, ``inside_u``,
    ``inside_v``."""
    raw: int
    """The factor before processing: bits."""
    clamped: int
    """After clamping: bits."""
    rounded: int
    """After rounding: bits."""
    fixed: int
    """As a 15.16 number."""
    context: FactorContext
    """Parity and the numbers of section 4."""

    @property
    def parity(self) -> str:
        """``even`` or ``odd``."""
        return self.context.parity


class Blend(NamedTuple):
    """The places of a point in both subdivisions, 16 fraction bits each."""

    coarse: int
    fine: int
    fraction: int
    """Weight of ``fine``, below 0x10000."""


class Placement(NamedTuple):
    """A location in one dimension, with every step (specification, section 5)."""

    flip: bool
    """Whether the point is on the second half of the edge, or in its middle."""
    position: int
    """On the half edge: 0..half_points."""
    blend: Optional[Blend]
    """``None`` in the exact middle of an even edge."""
    half_location: int
    """Before mirroring, 16 fraction bits."""
    location: int
    """16.16, 0..0x10000."""


class PointOrigin(NamedTuple):
    """The origin of a domain point (specification, section 6)."""

    kind: str
    """``corner`` (of a minimum patch), ``line``, ``outer_edge``, ``ring`` or ``centre``."""
    line: Optional[int]
    """Number of the isoline."""
    ring: Optional[int]
    """Number of the ring, from 1."""
    edge: Optional[int]
    """Number of the edge."""
    p: int
    """Number of the point on its line, edge or centre; for a corner, that of the corner."""


class PrimitiveOrigin(NamedTuple):
    """The origin of a primitive (specification, sections 7 and 8)."""

    kind: str
    """``sequence``, ``line``, ``minimum``, ``transition``, ``ring`` or ``centre``."""
    line: Optional[int]
    """Number of the isoline."""
    ring: Optional[int]
    """Number of the inner ring, from 2."""
    edge: Optional[int]
    """Number of the edge."""
    step: int
    """Number of the primitive along its line, stitch, centre or sequence."""


class Batch(NamedTuple):
    """The output of a batch, one patch after another."""

    points: "npt.NDArray[Any]"
    """Shape (points, 2): u and v of each point, float32 or uint32 (16.16)."""
    indices: "npt.NDArray[Any]"
    """Shape (indices,), uint32 or uint16."""
    ranges: "npt.NDArray[np.uint32]"
    """Shape (patches, 4): first point, points, first index, indices."""

    def patch(self, i: int) -> "tuple[npt.NDArray[Any], npt.NDArray[Any]]":
        """Points and indices of patch ``i``: views."""
        first_point, points, first_index, indices = (int(x) for x in self.ranges[i])
        return (
            self.points[first_point : first_point + points],
            self.indices[first_index : first_index + indices],
        )


class BatchCounts(NamedTuple):
    """Output sizes of a batch: elements of the three arrays."""

    patches: int
    points: int
    indices: int


class Group(NamedTuple):
    """The number of bins of a coverage group, and how many were hit."""

    hit: int
    bins: int


class Difference(NamedTuple):
    """The first wrong element of a record."""

    number: int
    """Number of the record, from 1."""
    line: Optional[int]
    """Line of the file on which the record starts."""
    case: Optional[str]
    """The patch, as ``Patch.from_case`` takes it."""
    element: str
    """Name of the element that differs, such as ``point 7 u``."""
    observed: str
    """The value found: hex, or a decimal count."""
    expected: str
    """The correct value."""
    stage: str
    """The stage of the specification that the difference points to."""
    text: str
    """All of this as ``tess check`` prints it."""


class SignalDifference(NamedTuple):
    """A signal of a circuit that differs from the model."""

    stage: str
    """The stage of the specification."""
    signal: str
    """The name of the signal."""
    observed: int
    """Value from the circuit."""
    expected: int
    """Value from the model."""

    def __str__(self) -> str:
        return f"{self.signal} of stage {self.stage}: observed {self.observed:#x}, expected {self.expected:#x}"


class RuleExample(NamedTuple):
    """The smallest patches that break a rule."""

    cases: "tuple[str, ...]"
    """One patch or two, as ``Patch.from_case`` takes them."""
    what: str
    """Description of the violation."""


class RuleRow(NamedTuple):
    """Outcome of one rule of a standard."""

    rule: str
    """The name of the rule in docs/rules.md."""
    source: str
    """The place in the standard that states it."""
    verdict: str
    """``held``, ``held as far as asked``, ``broken`` or ``not exercised``."""
    judged: int
    """Patches, or pairs of a patch and an earlier one, that it judged."""
    broken: int
    """How many of them break it."""
    example: Optional[RuleExample]
    """The smallest example, if it is broken."""
    not_asked: "tuple[str, ...]"
    """The levels that were not asked and could show a fault: domains, their spacings, their roles,
    and numbers of segments and classes of values in a role."""


class RulesReport(NamedTuple):
    """The verdicts of all rules of one standard."""

    specification: str
    """``vulkan``, ``opengl`` or ``d3d11``."""
    patches: int
    """Patches that were judged."""
    rows: "tuple[RuleRow, ...]"
    """The rules of the standard, in order."""
    text: str
    """All of this as ``tess check --rules`` prints it."""

    @property
    def holds(self) -> bool:
        """Whether no rule is broken."""
        return all(row.verdict != "broken" for row in self.rows)

    def rule(self, name: str) -> RuleRow:
        """The row of a rule; raises ``KeyError`` if the standard has no rule of this name."""
        for row in self.rows:
            if row.rule == name:
                return row
        raise KeyError(name)


class Report(NamedTuple):
    """The verdict on vectors or on a device."""

    cases: int
    """Records that were checked."""
    mismatches: int
    """Records that differ."""
    differences: "tuple[Difference, ...]"
    """The first differences, at most 20."""

    @property
    def equal(self) -> bool:
        """Whether there is no mismatch."""
        return self.mismatches == 0
