"""A scoreboard for circuits that stream their output: each element is compared when it arrives."""

from collections import deque
from typing import Iterator, NamedTuple, Sequence

from ._native import Coverage, Patch
from .values import SignalDifference

SHOWN = 20
"""The number of mismatches that are kept."""


class _Stream:
    """The patches whose elements in a stream are not complete yet."""

    def __init__(self) -> None:
        self.patches: "deque[tuple[Patch, int]]" = deque()
        self.next = 0
        self.checked = 0

    def expect(self, patch: Patch, elements: int) -> None:
        if elements > 0:
            self.patches.append((patch, elements))

    def pop(self) -> "tuple[Patch, int] | None":
        """The patch and number of the element that arrives now; None if no patch has it."""
        if not self.patches:
            return None
        patch, elements = self.patches[0]
        number = self.next
        self.checked += 1
        self.next += 1
        if self.next == elements:
            self.next = 0
            self.patches.popleft()
        return patch, number

    def clear(self) -> None:
        self.patches.clear()
        self.next = 0


class Mismatch(NamedTuple):
    """An element that differs from the model."""

    patch: Patch
    """The patch that it belongs to."""
    element: str
    """The name of the element: ``counts``, ``point 7``, ``primitive 3``."""
    differences: "tuple[SignalDifference, ...]"
    """The signals that differ."""
    command: str
    """The command that explains the element."""

    def __str__(self) -> str:
        first = self.differences[0]
        return (
            f"MISMATCH stage={first.stage} signal={first.signal} {self.element} "
            f"observed={first.observed:#x} expected={first.expected:#x}\n    {self.patch.case}\n    {self.command}"
        )


class Scoreboard:
    """Compares the streams of a circuit with the model, in order.

    Call ``accept`` when the circuit accepts a patch, and ``counts``, ``point`` and ``primitive`` when an element
    arrives. The three streams are independent of each other. ``accept`` records the bins of ``coverage``.

    >>> from tess_model import Patch, Scoreboard
    >>> board, patch = Scoreboard(), Patch("isoline", [1, 2], output="line")
    >>> board.accept(patch)
    >>> board.counts(3, 2)
    >>> for number, (u, v) in enumerate([(0, 0), (0x8000, 0), (0x10000, 0)]):
    ...     board.point(u, v, last=number == 2)
    >>> board.primitive([0, 1], last=False)
    >>> board.primitive([1, 3], last=True)
    >>> board.due
    0
    >>> print(board.mismatches[0])
    MISMATCH stage=connect signal=i1 primitive 1 observed=0x3 expected=0x2
        case isoline integer line ruler 3f800000 40000000
        tess explain isoline --outer 0x3f800000,0x40000000 --partitioning integer --output line --split ruler --primitive 1 --observed size=0x2,i0=0x1,i1=0x3,i2=0x0,last=0x1
    """

    def __init__(self) -> None:
        self.coverage = Coverage()
        """The coverage of the accepted patches."""
        self.mismatches: "list[Mismatch]" = []
        """The first mismatches."""
        self.wrong = 0
        """The number of elements that differ."""
        self._streams = {name: _Stream() for name in ("counts", "point", "primitive")}

    def accept(self, patch: Patch) -> None:
        """Records that the circuit has accepted a patch."""
        counts = patch.counts
        self.coverage.record(patch)
        for stream, elements in zip(self._streams.values(), (1, counts.points, counts.primitives)):
            stream.expect(patch, elements)

    def counts(self, points: int, primitives: int) -> None:
        """Compares the counts of a patch when they arrive."""
        self._compare("counts", {"points": points, "primitives": primitives})

    def point(self, u: int, v: int, last: bool) -> None:
        """Compares a point when it arrives; ``u`` and ``v`` are 16.16."""
        self._compare("point", {"u": u, "v": v, "last": int(last)})

    def primitive(self, indices: Sequence[int], last: bool, size: "int | None" = None) -> None:
        """Compares a primitive when it arrives. ``indices`` are its 1 to 3 indices; or, with ``size``, all three
        fields, of which the unused ones must be 0."""
        i0, i1, i2 = (*indices, 0, 0)[:3]
        size = len(indices) if size is None else size
        self._compare("primitive", {"size": size, "i0": i0, "i1": i1, "i2": i2, "last": int(last)})

    def reset(self) -> None:
        """Records that the circuit was reset: nothing is due for the patches that it has accepted."""
        for stream in self._streams.values():
            stream.clear()

    @property
    def checked(self) -> "dict[str, int]":
        """The number of elements of each stream that were compared."""
        return {name: stream.checked for name, stream in self._streams.items()}

    @property
    def due(self) -> int:
        """The number of incomplete patches in the stream that is furthest behind."""
        return max(len(stream.patches) for stream in self._streams.values())

    def missing(self) -> "Iterator[str]":
        """The next element of each stream that is due."""
        for name, stream in self._streams.items():
            if stream.patches:
                yield f"{name} {stream.next} of {stream.patches[0][0].case}"

    def _compare(self, name: str, observed: "dict[str, int]") -> None:
        found = self._streams[name].pop()
        assert found is not None, f"{name} came that no patch has: {observed}"
        patch, number = found
        which = {} if name == "counts" else {name: number}
        differences = patch.differences(observed, **which)
        if differences:
            self.wrong += 1
            if len(self.mismatches) < SHOWN:
                element = "counts" if name == "counts" else f"{name} {number}"
                self.mismatches.append(Mismatch(patch, element, differences, _command(patch, which, observed)))


def _command(patch: Patch, which: "dict[str, int]", observed: "dict[str, int]") -> str:
    """The command that explains the element and compares it again."""
    chosen = "".join(f" --{name} {number}" for name, number in which.items())
    seen = ",".join(f"{signal}={value:#x}" for signal, value in observed.items())
    return f"{patch.command.replace('tess patch', 'tess explain', 1)}{chosen} --observed {seen}"
