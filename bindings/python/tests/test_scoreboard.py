"""The scoreboard finds every kind of difference, and what never comes."""

from typing import Any, Callable

import pytest

from tess_model import ArgumentError, NoSuchElementError, Patch, Scoreboard, SignalDifference

QUAD = Patch("quad", outer=[3, 4, 5, 6], inner=[4, 7], partitioning="fractional_odd")
CULLED = Patch("tri", outer=[0, 1, 1], inner=1)


def fill(board: Scoreboard, patch: Patch, skip: int = 0) -> None:
    """Gives what the model gives, but for the last points."""
    board.accept(patch)
    board.counts(patch.counts.points, patch.counts.primitives)
    for i in range(patch.counts.points - skip):
        board.point(*patch.point(i), last=i + 1 == patch.counts.points)
    for t in range(patch.counts.primitives):
        board.primitive(patch.primitive(t), last=t + 1 == patch.counts.primitives)


def test_equal_streams() -> None:
    board = Scoreboard()
    for patch in (QUAD, CULLED, Patch("isoline", [2, 3], output="line"), Patch("tri", [2, 2, 2], 2, output="point")):
        fill(board, patch)
    assert board.wrong == 0 and board.due == 0 and not list(board.missing())
    assert board.checked["counts"] == 4 and board.checked["point"] > QUAD.counts.points
    assert board.coverage.groups["configuration"].hit > 0


@pytest.mark.parametrize(
    "call, expected",
    [
        (lambda b: b.counts(1, QUAD.counts.primitives), ("counts", "points", 1, QUAD.counts.points)),
        (lambda b: b.point(1, 0x10000, False), ("points", "u", 1, 0)),
        (lambda b: b.point(0, 0x10000, True), ("points", "last", 1, 0)),
        (lambda b: b.primitive([0, 1], False), ("connect", "size", 2, 3)),
    ],
)
def test_differences_are_named(call: "Callable[[Scoreboard], Any]", expected: "tuple[Any, ...]") -> None:
    board = Scoreboard()
    board.accept(QUAD)
    call(board)
    assert board.wrong == 1 and board.mismatches[0].differences[0] == SignalDifference(*expected)
    assert f"stage={expected[0]} signal={expected[1]} " in str(board.mismatches[0])


def test_what_is_missing_and_what_nobody_asked_for() -> None:
    board = Scoreboard()
    fill(board, QUAD, skip=1)
    assert board.due == 1 and list(board.missing()) == [f"point {QUAD.counts.points - 1} of {QUAD.case}"]
    board.reset()
    assert board.due == 0
    with pytest.raises(AssertionError, match="point came that no patch has"):
        board.point(0, 0, False)


def test_arguments_of_differences() -> None:
    with pytest.raises(ArgumentError, match="expected one of: points, primitives"):
        QUAD.differences({"u": 0})
    with pytest.raises(NoSuchElementError, match="no factor 6"):
        QUAD.differences({"fixed": 0}, factor=6)
    with pytest.raises(ArgumentError, match="one of them"):
        QUAD.differences({"u": 0}, point=0, factor=1)
    assert CULLED.differences({"culled": 0}, factor=0)[0].signal == "culled"
    assert [d.signal for d in QUAD.differences({"fixed": 1, "points": 1, "odd": 1}, factor=3)] == ["fixed", "points"]
