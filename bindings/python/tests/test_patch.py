"""One patch: arguments, elements, display."""

import copy
import pickle
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

import tess_model
from tess_model import ArgumentError, NoSuchElementError, Patch

QUAD = Patch("quad", outer=[3, 4, 5, 6], inner=[4, 7])


def test_the_same_factors_in_every_form() -> None:
    for outer, inner in [
        ((3, 4, 5, 6), (4.0, 7)),
        (np.array([3, 4, 5, 6], dtype=np.float32), np.array([4, 7], dtype=np.float64)),
        (np.array([6, 5, 4, 3])[::-1], [np.float32(4), np.int64(7)]),
    ]:
        assert Patch("quad", outer, inner) == QUAD  # type: ignore[arg-type]
    bits = np.array([3, 4, 5, 6, 4, 7], dtype=np.float32).view(np.uint32)
    assert Patch.from_bits("quad", bits[:4], bits[4:]) == QUAD
    assert Patch.from_case(QUAD.case) == QUAD == eval(repr(QUAD))
    assert QUAD.factor_bits == tuple(bits) and QUAD.factors == (3, 4, 5, 6, 4, 7)


def test_copies() -> None:
    for same in (copy.copy(QUAD), copy.deepcopy(QUAD), pickle.loads(pickle.dumps(QUAD))):
        assert same == QUAD and hash(same) == hash(QUAD)
    assert QUAD != Patch("quad", [3, 4, 5, 6], [4, 7], split="center") and QUAD != 1
    minus = Patch("isoline", [-0.0, 1])
    assert minus != Patch("isoline", [0.0, 1]) and minus.kind == "culled"


def test_elements_and_where_they_come_from() -> None:
    counts = QUAD.counts
    assert {QUAD.locate_point(i).kind for i in range(counts.points)} == {"outer_edge", "ring", "centre"}
    kinds = {QUAD.locate_primitive(t).kind for t in range(counts.primitives)}
    assert kinds == {"transition", "ring"} or kinds == {"transition", "ring", "centre"}
    assert QUAD.locate_point(0) == ("outer_edge", None, None, 0, 0)
    assert QUAD.place("v0", 1).location == QUAD.point(QUAD.processed[0].context.points)[0]
    factor = QUAD.processed[5]
    for p in range(factor.context.points):
        assert QUAD.place("inside_v", p) == tess_model.place(factor.fixed, factor.parity, p)
    assert tess_model.context(factor.fixed, factor.parity) == factor.context


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: QUAD.point(36), "no point 36: the patch has 36 points and 52 primitives"),
        (lambda: QUAD.primitive(52), "no primitive 52"),
        (lambda: QUAD.locate_point(2**32 - 1), "no point 4294967295"),
        (lambda: QUAD.explain(point=99), "no point 99"),
        (lambda: QUAD.place("v0", 5), "the edge has 5 points"),
        (lambda: Patch("tri", [0, 1, 1], 1).place("u0", 0), "culled"),
        (lambda: Patch("tri", [0, 1, 1], 1).point(0), "has 0 points"),
    ],
)
def test_missing_elements(call, message) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(NoSuchElementError, match=message) as error:
        call()
    assert isinstance(error.value, (ValueError, IndexError))


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: Patch("square", [1], 1), "unknown domain `square`, expected one of: isoline, tri"),
        (lambda: Patch("quad", [1, 2, 3], [1, 1]), r"4 outer factors \(u0, v0, u1, v1\) .* not 3"),
        (lambda: Patch("quad", [1, 2, 3], [4, 1, 1]), "not 3 and 3"),
        (lambda: Patch("quad", [1, 2, 3, 4]), "2 inside factors"),
        (lambda: Patch("isoline", [1, 2], 3), "0 inside factors .* and 1"),
        (lambda: Patch("tri", [1] * 10**6, 1), "not 1000000 and 1"),
        (lambda: Patch("tri", [1, 1, 1], 1, partitioning="Integer"), "fractional_odd"),
        (lambda: Patch("tri", [1, 1, 1], 1, output="lines"), "triangle_ccw"),
        (lambda: Patch("tri", [1, 1, 1], 1, split=""), "ruler"),
        (lambda: Patch.from_case("case tri"), "a case is"),
        (lambda: QUAD.place("w0", 0), "no factor \"w0\"; there are u0"),
        (lambda: QUAD.to_svg(size=10), "64 to 8192"),
        (lambda: QUAD.to_svg(colours="red"), "plain, order or rings"),
        (lambda: Patch("isoline", [1, 2]).to_svg(colours="rings"), "rings"),
        (lambda: QUAD.explain(point=1, primitive=1), "one of them"),
        (lambda: tess_model.context(0x8000, "odd"), "0x010000..0x3f0000"),
        (lambda: tess_model.context(0x18000, "even"), "0x020000"),
        (lambda: tess_model.context(0x10000, "none"), "unknown parity"),
        (lambda: tess_model.generate(4), "levels are 1, 2 and 3"),
        (lambda: tess_model.generate(shard=(0, 3)), "from 1 to n"),
        (lambda: tess_model.Tessellator(threads=0), "threads must be 1 to 256"),
        (lambda: tess_model.Coverage().add("middle/none"), "no bin"),
        (lambda: tess_model.check_device([], order="some"), "unknown order"),
    ],
)
def test_wrong_arguments(call, message) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(ArgumentError, match=message):
        call()


@pytest.mark.parametrize("outer", [None, "abc", [None], [1, "2", 3, 4], object(), [[1, 2], [3, 4]]])
def test_arguments_of_other_types(outer: object) -> None:
    with pytest.raises((TypeError, ArgumentError)):
        Patch("quad", outer, [1, 1])  # type: ignore[arg-type]
    with pytest.raises((TypeError, OverflowError, ArgumentError)):
        Patch.from_bits("quad", [2**32, -1, 0, 0], [1, 1])


def test_pictures_are_svg() -> None:
    for patch in (QUAD, Patch("tri", [0, 1, 1], 1), Patch("isoline", [64, 64], output="point")):
        for colours in ("plain", "order"):
            root = ElementTree.fromstring(patch.to_svg(indices=True, colours=colours, size=64))
            assert root.tag == "{http://www.w3.org/2000/svg}svg" and root.get("width") == "64"
    assert QUAD.to_svg(colours="rings") != QUAD.to_svg()
