"""Coverage: counting, merging, and the file that PyUCIS reads."""

import copy
import pickle
import threading
from pathlib import Path

import pytest
from ucis import UCIS_CVGBIN
from ucis.scope_type_t import ScopeTypeT
from ucis.xml.xml_factory import XmlFactory

import tess_model
from tess_model import Coverage, FileFormatError


def of_patches(coverage: Coverage) -> "dict[str, int]":
    """The hits of single patches: parts of a stream have other sequences than the whole."""
    return {bin: hits for bin, hits in coverage.bins.items() if not bin.startswith("sequence/")}


def of(shard: "tuple[int, int]") -> Coverage:
    coverage = Coverage()
    coverage.record(tess_model.generate(3, count=300, shard=shard))
    return coverage


def test_pyucis_reads_two_merged_shards(tmp_path: Path) -> None:
    merged, second = of((1, 2)), of((2, 2))
    merged.merge(second)
    assert of_patches(merged) == of_patches(of((1, 1))) and merged != second
    file = tmp_path / "coverage.xml"
    merged.write(file)
    assert Coverage.read(file) == merged
    found = {}
    for instance in XmlFactory.read(str(file)).scopes(ScopeTypeT.INSTANCE):
        for group in instance.scopes(ScopeTypeT.COVERGROUP):
            for point in group.scopes(ScopeTypeT.COVERPOINT):
                for bin in point.coverItems(UCIS_CVGBIN):
                    name = f"{point.getScopeName()}/{bin.getName()}"
                    found[name] = bin.getCoverData().data
    assert found == merged.bins
    assert sum(hits > 0 for hits in found.values()) > 500


def test_the_report_names_what_was_missed() -> None:
    coverage = of((1, 1))
    lines = coverage.report().splitlines()
    assert [line[7:] for line in lines if line.startswith("missed ")] == coverage.missed
    hit, bins = (sum(group[i] for group in coverage.groups.values()) for i in (0, 1))
    (row,) = [line.split() for line in lines if line.startswith("all ")]
    assert row[2:5] == [str(bins), str(hit), "0"]
    assert hit + len(coverage.missed) == bins == len(coverage.bins)


def test_what_a_device_cannot_hit_is_excluded() -> None:
    coverage = Coverage()
    coverage.record(tess_model.generate(1, domain="quad", partitioning="integer"))
    excluded = tess_model.exclusions(domain="quad", partitioning="integer")
    assert len(excluded) > 300 and set(excluded) <= set(coverage.missed)
    assert set(coverage.holes(excluded)) == set(coverage.missed) - set(excluded)
    report = coverage.report(exclude=excluded)
    assert f" {len(excluded)} " in report and "missed cull/tri" not in report
    assert tess_model.exclusions(domain=["isoline", "tri", "quad"]) == []
    file = ["# a device's notes", "", "transition  # too slow", "centre/*/point"]
    assert len(coverage.bins) - len(Coverage().holes(file)) == 2 * 4032 + 2
    for wrong in (["midle"], "midle"):
        with pytest.raises(ValueError, match="no bin begins with"):
            coverage.holes(wrong)
    with pytest.raises(ValueError, match="unknown domain"):
        tess_model.exclusions(domain="cube")


def test_contexts_alone() -> None:
    coverage = Coverage()
    coverage.record_context(0x28000, "odd", "center")
    assert [bin for bin, hits in coverage.bins.items() if hits] == ["context/center/odd/2/split"]


def test_other_files_are_refused(tmp_path: Path) -> None:
    text = of((1, 1)).to_ucis()
    for wrong, message in [
        ("", "line 1"),
        (text[:1000], "line"),
        (text.replace("coverageCount=\"0\"", "coverageCount=\"x\"", 1), "expected the hits of the bin"),
        (text + "<x/>", "expected the end"),
    ]:
        with pytest.raises(FileFormatError, match=message):
            Coverage.from_ucis(wrong)
    with pytest.raises(FileNotFoundError):
        Coverage.read(tmp_path / "none.xml")


def test_threads_count_together() -> None:
    coverage, patches = Coverage(), list(tess_model.generate(3, count=100))
    threads = [threading.Thread(target=coverage.record, args=(patches,)) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    once = Coverage()
    once.record(patches)
    assert of_patches(coverage) == {bin: 4 * hits for bin, hits in of_patches(once).items()}


def test_merging_with_itself_doubles() -> None:
    coverage = of((1, 1))
    before = coverage.bins
    coverage.merge(coverage)
    assert coverage.bins == {bin: 2 * hits for bin, hits in before.items()} and coverage == coverage


def test_a_copy_counts_on_as_the_original_does() -> None:
    patches = list(tess_model.generate(3, count=40))
    coverage = Coverage()
    coverage.record(patches[:20])
    copies = [copy.copy(coverage), copy.deepcopy(coverage)]
    copies += [pickle.loads(pickle.dumps(coverage, protocol)) for protocol in range(pickle.HIGHEST_PROTOCOL + 1)]
    assert all(same == coverage for same in copies)
    coverage.record(patches[20:])
    assert all(same != coverage for same in copies), "a copy has hits of its own"
    for same in copies:
        same.record(patches[20:])
        assert same == coverage, "the patch before counts too: bins of sequences"
    first = Coverage()
    assert pickle.loads(pickle.dumps(first)) == first
    with pytest.raises(FileFormatError):
        first.__setstate__(("no coverage", None))
    with pytest.raises(tess_model.ArgumentError):
        first.__setstate__((first.to_ucis(), "no case"))
    assert first == Coverage()
