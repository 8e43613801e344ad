"""Bad arguments raise the package's errors, too much memory Python's, and Ctrl-C ends what takes long."""

# Arguments of wrong types are what is tested here.
# mypy: disable-error-code="arg-type,list-item"

import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any, Callable

import numpy as np
import pytest

import tess_model
from tess_model import (
    ArgumentError, Coverage, FileFormatError, NoSuchElementError, Patch, TessError, Tessellator, tessellate,
)

PATCH = Patch("tri", [3, 4, 5], 6)
HUGE = np.broadcast_to(np.float32(3), (2**40, 6))


@pytest.mark.parametrize(
    "call",
    [
        lambda: Patch("tri", "abc", 4),
        lambda: Patch("tri", b"abc", 4),
        lambda: Patch("tri", bytearray(3), 4),
        lambda: Patch("tri", [1, "2", 3], 4),
        lambda: Patch("tri", {1: 2}, None),
        lambda: Patch("tri", np.ma.masked_array([1.0, 2.0, 3.0], mask=[0, 1, 0]), 4),
        lambda: Patch.from_bits("tri", [2**32, 0, 0], 0),
        lambda: Patch.from_bits("tri", [-1, 0, 0], 0),
        lambda: Patch.from_bits("tri", [1.5, 0, 0], 0),
        lambda: PATCH.point(-1),
        lambda: PATCH.point(2**32),
        lambda: PATCH.primitive(-1),
        lambda: PATCH.locate_point("7"),
        lambda: PATCH.place("u0", -1),
        lambda: PATCH.explain(point=-1),
        lambda: PATCH.explanation(primitive=2**40),
        lambda: PATCH.to_svg(size=-5),
        lambda: tess_model.context(-1, "odd"),
        lambda: tess_model.place(0x28000, "odd", -1),
        lambda: tess_model.generate(300),
        lambda: tess_model.generate(seed=-1),
        lambda: tess_model.generate(count=2**64),
        lambda: tess_model.generate(shard=(1, -2)),
        lambda: tess_model.generate(shard="1/2"),
        lambda: tess_model.generate(output="triangles"),
        lambda: Tessellator(threads=-1),
        lambda: tessellate("tri", np.ones((1, 4), np.float32), base_vertex=-1),
        lambda: tessellate("tri", np.ma.masked_array(np.ones((1, 4), np.float32), mask=True)),
        lambda: Coverage().add("middle/ruler/oddxodd", -1),
        lambda: tess_model.check_device([]),
        lambda: tess_model.check_device([(PATCH, PATCH.points)]),
        lambda: tess_model.check_device([(PATCH, PATCH.points, PATCH.indices)], cases=[]),
        lambda: tess_model.check_device([(PATCH, np.ma.masked_array(PATCH.points, mask=True), PATCH.indices)]),
    ],
)
def test_bad_arguments(call: "Callable[[], object]") -> None:
    with pytest.raises((ArgumentError, NoSuchElementError)) as caught:
        call()
    assert "extract" not in str(caught.value) and "enum" not in str(caught.value)


def test_numbers_of_every_kind_are_factors() -> None:
    same = [
        Patch("tri", (3, 4, 5), 6),
        Patch("tri", np.array([3, 4, 5]), np.array([6.0])),
        Patch("tri", [np.float32(3), np.int64(4), 5.0], np.float64(6)),
        Patch.from_bits("tri", np.array([0x40400000, 0x40800000, 0x40A00000], np.int64), 0x40C00000),
    ]
    assert all(patch == PATCH for patch in same)


@pytest.mark.parametrize(
    "call",
    [
        lambda: Tessellator().count("quad", HUGE),
        lambda: tessellate("quad", HUGE),
        lambda: tessellate("quad", HUGE.view(np.uint32)),
        lambda: tess_model.check_device([(PATCH, np.broadcast_to(np.uint32(0), (2**40, 2)), PATCH.indices)]),
        lambda: tess_model.check_device([(PATCH, PATCH.points, np.broadcast_to(np.uint32(0), 2**42))]),
    ],
)
def test_too_much_memory(call: "Callable[[], object]") -> None:
    with pytest.raises(MemoryError, match="no memory for a copy"):
        call()


def test_coverage_files_of_bytes_and_without_end(tmp_path: Path) -> None:
    file = tmp_path / "bytes.xml"
    file.write_bytes(b"\xff\xfe")
    with pytest.raises(FileFormatError, match="bytes.xml: line 1"):
        Coverage.read(file)
    if Path("/dev/zero").exists():
        with pytest.raises(FileFormatError, match="/dev/zero: line 1"):
            Coverage.read("/dev/zero")


def test_other_patches_than_those_asked(tmp_path: Path) -> None:
    other = Patch("tri", [3, 4, 5], 7)
    answer = (PATCH, PATCH.points, PATCH.indices)
    assert tess_model.check_device([answer], cases=[PATCH]).equal
    for answers, cases in [([answer, answer], [PATCH, other]), ([answer], [PATCH, PATCH]), ([answer] * 2, [PATCH])]:
        with pytest.raises(ArgumentError, match="answer"):
            tess_model.check_device(answers, cases=cases)
    file = tmp_path / "device.txt"
    tess_model.write_vectors(file, [PATCH, PATCH], form="listings")
    assert tess_model.check(file, cases=[PATCH, PATCH]).equal
    for asked in ([PATCH, other], [PATCH], [PATCH] * 3):
        assert not tess_model.check(file, cases=asked).equal


def test_the_order_of_a_sequence() -> None:
    # The same triangles in the same order, with points numbered backwards.
    points, indices = PATCH.points[::-1].copy(), (len(PATCH.points) - 1 - PATCH.indices).astype(np.uint32)
    answer = [(PATCH, points, indices)]
    assert not tess_model.check_device(answer).equal
    assert tess_model.check_device(answer, order="sequence").equal
    turned = [(PATCH, points, indices[::-1].copy())]
    assert not tess_model.check_device(turned, order="sequence").equal


def test_filters_of_generated_patches() -> None:
    some = list(tess_model.generate(3, count=50, output="point", split="center"))
    assert len(some) == 50 and all((patch.output, patch.split) == ("point", "center") for patch in some)


def interrupted(script: str, path: "Path | str" = "") -> float:
    """Seconds from the signal to the end of a script, which must end by KeyboardInterrupt."""
    # A shell that starts the tests in its background has them ignore the signal.
    heed = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)\n"
    program = heed + "import sys, tess_model as t\nprint(flush=True)\n" + script
    process = subprocess.Popen(
        [sys.executable, "-c", program, str(path)], stdout=subprocess.PIPE, stderr=subprocess.PIPE
    )
    assert process.stdout is not None
    process.stdout.readline()
    time.sleep(0.5)
    assert process.poll() is None, "it works when the signal comes"
    begun = time.monotonic()
    process.send_signal(signal.SIGINT)
    try:
        _, said = process.communicate(timeout=30)
    finally:
        process.kill()
    assert b"KeyboardInterrupt" in said, said
    return time.monotonic() - begun


@pytest.mark.skipif(sys.platform == "win32", reason="signals are sent as POSIX has them")
@pytest.mark.parametrize(
    "script",
    [
        "next(t.generate(3, count=10**10, shard=(10**10, 10**10)))",
        "list(t.generate(3, count=10**10))",
        "t.Coverage().record(t.generate(3, count=10**10))",
        "t.write_vectors(sys.argv[1], t.generate(3, count=10**10))",
    ],
)
def test_ctrl_c(script: str, tmp_path: Path) -> None:
    assert interrupted(script, tmp_path / "vectors.csv") < 20


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
@pytest.mark.parametrize("has_begun", [False, True])
@pytest.mark.parametrize("script", ["t.check(sys.argv[1])", "list(t.VectorFile(sys.argv[1]))"])
def test_ctrl_c_at_a_stalled_pipe(script: str, has_begun: bool, tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    # A writer that gives the first line, or none that ever opens it.
    writer: Any = None
    if has_begun:
        sleep = "printf '# tess-vectors 1 kind=listings source=a\\n'; sleep 100"
        writer = subprocess.Popen(["sh", "-c", f"exec > '{pipe}'; {sleep}"])
    try:
        assert interrupted(script, pipe) < 20
    finally:
        if writer:
            writer.kill()


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
@pytest.mark.parametrize(
    "script, other_end",
    [
        (script, end)
        for script, other_end in [
            ("t.Coverage.read(sys.argv[1])", "exec 3>'{}'; printf '<?xml' >&3"),
            ("t.Coverage().write(sys.argv[1])", "exec 3<'{}'"),
            ("t.write_vectors(sys.argv[1], [t.Patch('tri', [3, 4, 5], 6)] * 5000)", "exec 3<'{}'"),
            ("t.write_vectors(sys.argv[1], [t.Patch('tri', [3, 4, 5], 6)] * 5000, form='listings')", "exec 3<'{}'"),
        ]
        for end in ("", other_end)
    ],
)
def test_ctrl_c_at_a_pipe_without_end(script: str, other_end: str, tmp_path: Path) -> None:
    """Nobody opens the other end; or somebody does, and reads nothing, or writes no more."""
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    other = subprocess.Popen(["sh", "-c", f"{other_end.format(pipe)}; sleep 100"]) if other_end else None
    try:
        assert interrupted(script, pipe) < 20
    finally:
        if other:
            other.kill()


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="needs a timer's signal")
@pytest.mark.parametrize("points, indices", [("fixed", "uint16"), ("float32", "uint32")])
def test_a_signal_ends_a_batch(points: str, indices: str) -> None:
    """A handler that raises ends a large batch between two parts: the last patches are not written."""
    tessellator, factors = Tessellator(), np.full((4000, 6), 64, np.float32)
    counts = tessellator.count("quad", factors)
    out = (
        np.zeros((counts.points, 2), "uint32" if points == "fixed" else points),
        np.zeros(counts.indices, indices),
        np.zeros((counts.patches, 4), np.uint32),
    )

    def raises(*_: object) -> None:
        raise TimeoutError("the timer's")

    before = signal.signal(signal.SIGALRM, raises)
    written = 0
    try:
        for delay in (0.01, 0.02, 0.04, 0.08, 0.16):
            with pytest.raises(TimeoutError, match="the timer's"):
                signal.setitimer(signal.ITIMER_REAL, delay)
                tessellator.tessellate("quad", factors, out=out)
            written = int(out[2].any(axis=1).sum())
            if written:
                break
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    assert 0 < written < counts.patches
    small = tessellator.tessellate("quad", factors[:3])
    np.testing.assert_array_equal(small.points[: 4225], Patch("quad", [64] * 4, [64] * 2).points_f32)


def test_parts_of_a_large_batch() -> None:
    """A batch that is written in parts equals the same patches in batches that are not; what it refuses, too."""
    tessellator = Tessellator("fractional_odd", threads=2)
    # Large patches first: a part of average length is too large there.
    sizes = np.repeat(np.float32([62.5, 1.5, 17.25, 0, 5]), [1200, 100_000, 150, 50, 1000])
    factors = np.repeat(sizes[:, None], 6, axis=1)
    for base_vertex in (None, 7):
        whole = tessellator.tessellate("quad", factors, base_vertex=base_vertex)
        patch = 0
        while patch < len(factors):
            first_point, _, first_index, _ = whole.ranges[patch].astype(np.int64)
            some = factors[patch : patch + (300 if patch < 1200 else 40_000)]
            part = tessellator.tessellate("quad", some)
            points = slice(first_point, first_point + len(part.points))
            indices = slice(first_index, first_index + len(part.indices))
            np.testing.assert_array_equal(whole.points[points], part.points)
            firsts = np.zeros(len(some), np.int64) if base_vertex is None else part.ranges[:, 0].astype(np.int64) + first_point + base_vertex
            own = part.indices.astype(np.int64) + np.repeat(firsts, part.ranges[:, 3])
            np.testing.assert_array_equal(whole.indices[indices], own)
            moved = part.ranges.astype(np.int64) + [first_point, 0, first_index, 0]
            np.testing.assert_array_equal(whole.ranges[patch : patch + len(some)], moved)
            patch += len(some)
        assert (len(whole.points), len(whole.indices)) == (points.stop, indices.stop)
    with pytest.raises(ArgumentError, match="indices end at 65535"):
        tessellator.tessellate("quad", factors, base_vertex=0, indices="uint16")
    before = whole.indices[:5000].copy()
    for given, base_vertex, message in [
        ((whole.points, whole.indices), 2**32 + 1 - len(whole.points), "the index 4294967296, but"),
        ((whole.points, whole.indices, whole.ranges[1:]), None, "range buffer"),
        ((whole.points[1:], whole.indices), None, "point buffer"),
    ]:
        with pytest.raises(TessError, match=message):
            tessellator.tessellate("quad", factors, base_vertex=base_vertex, out=given)
        np.testing.assert_array_equal(whole.indices[:5000], before, "nothing is written")
