"""The recorded results of golden/, through the package."""

import csv
from pathlib import Path

import numpy as np
import pytest

import tess_model
from tess_model import Coverage, Patch, VectorFile, check, check_device, tessellate

WHOLE = ["cases.txt", "corners.csv", "factor.csv", "hlsl.csv", "patches.csv", "sweep.csv", "uniform.csv"]


def test_every_recorded_point_and_index(golden: Path) -> None:
    records = list(VectorFile(golden / "cases.txt"))
    assert len(records) == 51
    for record in records:
        patch = record.patch
        assert patch is not None and record.points is not None and record.indices is not None
        np.testing.assert_array_equal(patch.points, record.points, err_msg=patch.case)
        np.testing.assert_array_equal(patch.indices.ravel(), record.indices, err_msg=patch.case)
        counts = patch.counts
        assert (counts.points, counts.indices) == (len(record.points), len(record.indices))
        assert counts.primitives == len(patch.indices)
        assert [patch.point(i) for i in range(counts.points)] == list(map(tuple, record.points))
        flat = [index for t in range(counts.primitives) for index in patch.primitive(t)]
        assert flat == list(record.indices)
        np.testing.assert_array_equal(patch.points_f32 * 65536, record.points)


@pytest.mark.parametrize("name", WHOLE)
def test_files_check(golden: Path, name: str) -> None:
    report = check(golden / name, tested="model")
    assert report.equal and report.cases > 0, report.differences


def digest(words: "np.ndarray") -> str:
    """FNV-1a 64 over little-endian 32-bit words, as golden/README.md describes it."""
    state = 0xCBF29CE484222325
    for byte in words.astype("<u4").tobytes():
        state = (state ^ byte) * 0x100000001B3 & 0xFFFFFFFFFFFFFFFF
    return f"{state:016x}"


def test_batches_have_the_recorded_digests(golden: Path) -> None:
    """Every row of corners.csv, in batches of one configuration each; read without the package."""
    with (golden / "corners.csv").open() as file:
        file.readline()
        rows = list(csv.DictReader(file))
    groups: "dict[tuple[str, ...], list[dict[str, str]]]" = {}
    for row in rows:
        key = tuple(row[name] for name in ("domain", "partitioning", "output", "split"))
        groups.setdefault(key, []).append(row)
    for (domain, partitioning, output, split), members in groups.items():
        bits = [[int(word, 16) for word in row["factors_f32_hex"].split()] for row in members]
        batch = tessellate(
            domain,
            np.array(bits, dtype=np.uint32),
            partitioning=partitioning,
            output=output,
            split=split,
            points="fixed",
            indices="uint16",
        )
        for i, row in enumerate(members):
            points, indices = batch.patch(i)
            found = (str(len(points)), str(len(indices)), digest(points), digest(indices))
            expected = tuple(
                row[name] for name in ("points", "indices", "points_fnv1a64", "indices_fnv1a64")
            )
            assert found == expected, row
    assert len(rows) == 1552


def test_a_wrong_number_is_found(golden: Path, tmp_path: Path) -> None:
    text = (golden / "cases.txt").read_text()
    wrong = tmp_path / "wrong.txt"
    wrong.write_text(text.replace("\n02aab 06aaa\n", "\n02aab 06aab\n", 1))
    report = check(wrong)
    assert (report.cases, report.mismatches, report.equal) == (51, 1, False)
    difference = report.differences[0]
    assert (difference.element, difference.observed, difference.expected, difference.stage) == (
        "point 11 v", "0x06aab", "0x06aaa", "location",
    )
    assert difference.case is not None and Patch.from_case(difference.case).point(11)[1] == 0x6AAA
    assert check(wrong, elements="points").mismatches == 1


def test_devices(golden: Path) -> None:
    records = list(VectorFile(golden / "cases.txt"))
    answers = [(r.patch, r.points, r.indices) for r in records]
    assert check_device(answers).equal  # type: ignore[arg-type]
    patch, points, indices = answers[0]
    assert patch is not None and points is not None and indices is not None
    turned = indices.reshape(-1, 3)[::-1][:, [1, 2, 0]]
    assert not check_device([(patch, points, turned)]).equal
    assert check_device([(patch, points, turned)], order="any").equal
    flipped = indices.reshape(-1, 3)[:, [1, 0, 2]]
    found = check_device([(patch, points, flipped)], order="any")
    assert found.mismatches == 1 and found.differences[0].stage == "stitch"


def test_vector_files_round_trip(tmp_path: Path) -> None:
    patches = list(tess_model.generate(level=3, count=40, seed=7))
    for form in ("patches", "listings"):
        file = tmp_path / form
        tess_model.write_vectors(file, patches, form=form)
        coverage = Coverage()
        assert check(file, tested="model", coverage=coverage).cases == 40
        again = VectorFile(file)
        assert (again.kind, again.count, again.source) == (form, 40, "tess-core")
        assert [record.patch for record in again] == patches
        recorded = Coverage()
        recorded.record(patches)
        assert coverage == recorded


@pytest.mark.parametrize(
    "change, message",
    [
        (lambda text: "", "empty"),
        (lambda text: text[: len(text) // 2], r"vectors.txt:\d+: "),
        (lambda text: text + "x\n", "goes on"),
        (lambda text: text.replace("triangle_cw", "triangles", 1), "unknown output primitive"),
    ],
)
def test_malformed_files(golden: Path, tmp_path: Path, change, message) -> None:  # type: ignore[no-untyped-def]
    file = tmp_path / "vectors.txt"
    file.write_text(change((golden / "cases.txt").read_text()))
    with pytest.raises(tess_model.FileFormatError, match=message):
        check(file)
    with pytest.raises(FileNotFoundError):
        check(tmp_path / "none")
