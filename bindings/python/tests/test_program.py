"""The package against the program `tess`."""

import json
import subprocess
from pathlib import Path

import pytest

from tess_model import Coverage, Patch, exclusions, generate

PATCHES = [
    Patch("quad", [3, 4, 5, 6], [4, 7]),
    Patch("tri", [2.5, 3, 1], 3.25, partitioning="fractional_odd"),
    Patch("tri", [1, float("nan"), 1], 1),
    Patch("isoline", [3, 4.5], partitioning="fractional_even", output="line"),
    Patch("quad", [1, 1, 1, 1], [1, 1], split="center", output="point"),
    Patch("quad", [8, 0.5, 100, float("inf")], [-3, float("nan")], output="triangle_ccw"),
]


def tess(program: Path, *arguments: str) -> str:
    run = subprocess.run([program, *arguments], check=True, capture_output=True, text=True)
    return run.stdout


def options(patch: Patch) -> "list[str]":
    """The arguments of the patch, without `tess patch`."""
    return patch.command.split()[2:]


@pytest.mark.parametrize("patch", PATCHES, ids=lambda patch: patch.case)
def test_everything_that_explain_says(program: Path, patch: Patch) -> None:
    def same(extra: "list[str]", **element: int) -> None:
        text = tess(program, "explain", *options(patch), *extra)
        assert patch.explain(**element) == text
        values = tess(program, "explain", *options(patch), *extra, "--json")
        assert patch.explanation(**element) == json.loads(values)

    same([])
    for i in range(0, patch.counts.points, 5):
        same(["--point", str(i)], point=i)
    for t in range(0, patch.counts.primitives, 7):
        same(["--primitive", str(t)], primitive=t)


@pytest.mark.parametrize("patch", PATCHES, ids=lambda patch: patch.case)
def test_values_are_those_of_the_explanation(patch: Patch) -> None:
    explanation = patch.explanation()
    assert [explanation[key] for key in ("domain", "partitioning", "output", "split", "kind")] == [
        patch.domain, patch.partitioning, patch.output, patch.split, patch.kind,
    ]
    assert [explanation[key] for key in ("points", "primitives", "indices")] == list(patch.counts)
    if patch.kind == "culled":
        assert patch.processed == ()
        return
    assert len(explanation["factors"]) == len(patch.processed) > 0
    for told, factor in zip(explanation["factors"], patch.processed):
        assert told["raw"]["bits"] == factor.raw
        assert told["clamped"]["bits"] == factor.clamped
        assert told["rounded"]["bits"] == factor.rounded
        assert told["fixed"]["bits"] == factor.fixed
        assert told["parity"] == factor.parity
        context = {**told["context"]}
        del context["half_steps"]
        assert context == {key: value for key, value in factor.context._asdict().items() if key != "parity"}


@pytest.mark.parametrize("patch", PATCHES, ids=lambda patch: patch.case)
def test_pictures_and_listings(program: Path, patch: Patch) -> None:
    assert patch.to_svg(indices=True) == tess(program, "draw", *options(patch), "--number-points")
    assert patch._repr_svg_() == tess(program, "draw", *options(patch), "--size", "400")
    listing = tess(program, "patch", *options(patch))
    assert patch.listing() == listing.split("\n", 1)[1]


def test_generated_patches_and_coverage(program: Path, tmp_path: Path) -> None:
    selection = "--level 3 --seed 5 --count 200 --domain tri --partitioning fractional_odd".split()
    rows = tess(program, "gen", *selection, "--shard", "2/3").splitlines()[2:]
    patches = list(
        generate(3, seed=5, count=200, domain="tri", partitioning="fractional_odd", shard=(2, 3))
    )
    assert len(patches) == 67
    assert [" ".join(f"{bits:08x}" for bits in patch.factor_bits) for patch in patches] == [
        row.split(",")[4] for row in rows
    ]
    file = tmp_path / "coverage.xml"
    report = tess(program, "gen", *selection, "--shard", "2/3", "--coverage", str(file))
    coverage = Coverage()
    coverage.record(patches)
    assert coverage == Coverage.read(file)
    outside = exclusions(domain="tri", partitioning="fractional_odd")
    assert coverage.report(outside) == report
    assert coverage.to_ucis() == file.read_text()


def test_level_1_hits_every_bin() -> None:
    coverage = Coverage()
    coverage.record(generate(1))
    assert coverage.missed == [] and len(coverage.bins) > 4000
