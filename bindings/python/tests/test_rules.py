"""Rules of the standards give the program's verdicts in Python."""

from pathlib import Path

import numpy as np
import pytest

import tess_model
from tess_model import ArgumentError, FileFormatError, Patch, check_rules, generate

ABOVE_3 = Patch.from_bits(
    "isoline", [0x3F800000, 0x40400001], partitioning="fractional_odd", output="line"
)


def test_the_model_breaks_what_vulkan_asks_and_direct3d_does_not() -> None:
    answer = (ABOVE_3, ABOVE_3.points, ABOVE_3.indices)
    report = check_rules([answer], "vulkan")
    segments = report.rule("segments")
    assert (segments.verdict, segments.judged, segments.broken) == ("broken", 1, 1)
    assert segments.example is not None and segments.example.cases == (ABOVE_3.case,)
    assert "3 segments, its level 3.0000002 asks for 5" in segments.example.what
    assert "22.3 Tessellator Spacing" == segments.source and segments.source in report.text
    assert not report.holds and report.patches == 1
    assert report.rule("cover").verdict == "not exercised" and report.rule("cover").example is None
    assert segments.not_asked[:2] == ("tri", "quad"), segments.not_asked
    exact = check_rules([answer], "d3d11")
    assert exact.holds and exact.rule("segments").verdict == "held as far as asked"
    with pytest.raises(KeyError):
        report.rule("segment")


def test_a_fault_is_found() -> None:
    patch = Patch("quad", [4, 4, 4, 4], [4, 4])
    assert check_rules([(patch, patch.points, patch.indices)], "opengl").holds
    report = check_rules([(patch, patch.points, patch.indices[:-1])], "opengl")
    broken = [row.rule for row in report.rows if row.verdict == "broken"]
    assert broken == ["cover"], report.text


def test_the_population_exercises_rules_and_files_do_as_answers_do(tmp_path: Path) -> None:
    patches = list(generate(rules=True, count=20, split="ruler", domain="isoline"))
    assert len(patches) > len(list(generate(rules=True, count=0, split="ruler", domain="isoline")))
    path = tmp_path / "listings.txt"
    tess_model.write_vectors(path, patches, form="listings")
    of_file = check_rules(path, "d3d11")
    assert of_file == check_rules(((p, p.points, p.indices) for p in patches), "d3d11")
    isolines = of_file.rule("isolines")
    assert isolines.verdict == "held" and isolines.not_asked == ()
    assert of_file.patches == len(patches)


def test_what_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "patches.csv"
    tess_model.write_vectors(path, [ABOVE_3])
    for wrong in (
        lambda: check_rules([], "vulkan"),
        lambda: check_rules(path, "vulkan"),
        lambda: check_rules([(ABOVE_3, ABOVE_3.points, ABOVE_3.indices)], "metal"),
        lambda: generate(2, rules=True),
    ):
        with pytest.raises(ArgumentError):
            wrong()
    path.write_text("")
    with pytest.raises(FileFormatError):
        check_rules(path, "vulkan")


def test_integers_of_any_type_are_answers_if_nothing_is_lost() -> None:
    patch = Patch("tri", [2, 3, 4], 5)
    for points, indices in (
        (patch.points.astype(np.int64), patch.indices.astype(np.uint16)),
        (patch.points.tolist(), patch.indices.tolist()),
    ):
        assert tess_model.check_device([(patch, points, indices)]).equal
    culled = Patch("tri", [0, 3, 4], 5)
    assert tess_model.check_device([(culled, [], [])]).equal
    negative = patch.points.astype(np.int64) - 1
    above = patch.points.astype(np.int64) + 2**32
    for wrong in (negative, above, patch.points.astype(np.float64), patch.points > 0):
        with pytest.raises(ArgumentError):
            tess_model.check_device([(patch, wrong, patch.indices)])  # type: ignore[list-item]


def test_factors_of_any_float_type_if_nothing_is_lost() -> None:
    factors = np.full((3, 4), 2.5, np.float32)
    right = tess_model.tessellate("tri", factors)
    for same in (factors.astype(np.float64), factors.tolist()):
        assert np.array_equal(tess_model.tessellate("tri", same).points, right.points)
    for wrong in ([[0.1, 1.0, 1.0, 1.0]], np.full((3, 4), 2), [[1.0], [1.0, 2.0]]):
        with pytest.raises(ArgumentError):
            tess_model.tessellate("tri", wrong)


def test_one_factor() -> None:
    patch = Patch("tri", [2.5, 3, 3], 3.7, partitioning="fractional_odd")
    outer = tess_model.process_factor(2.5, "fractional_odd")
    assert outer == patch.processed[0]
    inside = tess_model.process_factor(3.7, "fractional_odd", role="inside")
    assert inside is not None and inside[1:] == patch.processed[3][1:]
    assert tess_model.process_factor(float("nan")) is None
    assert tess_model.process_factor(0.0) is None
    unculled = tess_model.process_factor(float("nan"), role="inside")
    assert unculled is not None and unculled.fixed == 0x10000
    with pytest.raises(ArgumentError):
        tess_model.process_factor(1.0, role="inner")
