"""The placer's bench in both simulators: it passes, and finds planted faults."""

import os
import shutil
import subprocess
from pathlib import Path
from typing import Optional

import pytest

import tess_model.examples.cocotb
from child import simulated
from tess_model import Coverage

EXAMPLE = Path(tess_model.examples.cocotb.__file__).parent
BUILD = Path(os.environ.get("TESS_COCOTB_BUILD", "target/cocotb"))
DESIGN = Path(__file__).resolve().parents[3] / "rtl"
FAULTS = [
    ("factor_context", "(factor + 23'd1) >> 1", "factor >> 1", "factor_context signal=fraction"),
    ("place_position", "{6'd0, odd}", "7'd0", "place_position signal=position"),
    ("place_blend", "coarse + HALF", "coarse", "place_blend signal=half_location"),
]


def bench(
    tmp_path: Path, sim: str, *options: str, script: Optional[Path] = None
) -> "subprocess.CompletedProcess[str]":
    """Runs the example as it is installed, or a copy of its script."""
    arguments = ["--sim", sim, "--random", "50", "--build", str(BUILD), *options]
    program = [str(script)] if script else ["-m", "tess_model.examples.cocotb"]
    return simulated(*program, *arguments, "--coverage", tmp_path / "coverage.xml")


@pytest.mark.parametrize("sim", ["verilator", "icarus"])
def test_the_design_equals_the_model(tmp_path: Path, sim: str) -> None:
    run = bench(tmp_path, sim)
    assert run.returncode == 0 and "2 tests, 0 failed" in run.stdout, run.stdout + run.stderr
    assert "51352 vectors, 0 mismatches" in run.stdout, "all of level 1"
    coverage = Coverage.read(tmp_path / "coverage.xml")
    assert coverage.groups["context"].hit == coverage.groups["context"].bins
    assert coverage.groups["cull"].hit == 0, "the placer sees no patch"
    hits = sum(coverage.bins.values())
    random_alone = bench(tmp_path, sim, "--testcase", "random_stimuli")
    assert random_alone.returncode == 0, random_alone.stdout + random_alone.stderr
    merged = Coverage.read(tmp_path / "coverage.xml")
    assert sum(merged.bins.values()) > hits, "a second run is merged into the file of the first"


@pytest.mark.parametrize("module, right, wrong, named", FAULTS)
def test_planted_faults_are_found(tmp_path: Path, module: str, right: str, wrong: str, named: str) -> None:
    design = Path(shutil.copytree(DESIGN, tmp_path / "rtl", ignore=shutil.ignore_patterns("dv")))
    text = (design / f"tess_{module}.sv").read_text()
    assert text.count(right) == 1, f"{module} has {right}"
    (design / f"tess_{module}.sv").write_text(text.replace(right, wrong))
    sim = "icarus"  # which builds in a moment
    run = bench(tmp_path, sim, "--rtl", str(design), "--testcase", "random_stimuli")
    assert run.returncode == 1 and "1 tests, 1 failed" in run.stdout, run.stdout + run.stderr
    assert f"stage={named} observed=0x" in run.stdout, run.stdout
    coverage = Coverage.read(tmp_path / "coverage.xml")
    assert coverage.groups["context"].hit > 0, "what a failing run drove counts"


def test_the_wheel_has_the_example() -> None:
    """The installed example runs, not the one in the repository."""
    repository = Path(__file__).resolve().parents[1] / "python" / "tess_model" / "examples" / "cocotb"
    assert EXAMPLE != repository
    for file in sorted(repository.rglob("*.*")):
        if file.is_file() and "__pycache__" not in file.parts:
            assert (EXAMPLE / file.relative_to(repository)).read_bytes() == file.read_bytes(), file


def test_a_copy_elsewhere(tmp_path: Path) -> None:
    copy = tmp_path / "copy"
    shutil.copytree(EXAMPLE, copy, ignore=shutil.ignore_patterns("__pycache__", "sim_build"))
    options = ("--testcase", "random_stimuli")
    run = bench(tmp_path, "icarus", *options, script=copy / "run.py")
    assert run.returncode == 0 and "1 tests, 0 failed" in run.stdout, run.stdout + run.stderr
    design = (copy / "design").rename(tmp_path / "moved")
    run = bench(tmp_path, "icarus", *options, script=copy / "run.py")
    assert run.returncode == 2 and "--rtl names its folder" in run.stderr, run.stdout + run.stderr
    run = bench(tmp_path, "icarus", *options, "--rtl", str(design), script=copy / "run.py")
    assert run.returncode == 0 and "1 tests, 0 failed" in run.stdout, run.stdout + run.stderr
