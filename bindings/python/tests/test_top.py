"""The circuit's cocotb bench, in rtl/dv/cocotb: it passes in both simulators, finds faults and holes in its coverage."""

import importlib.util
import os
import subprocess
import textwrap
from pathlib import Path
from typing import Any

import pytest

from child import simulated

BENCH = Path(__file__).resolve().parents[3] / "rtl" / "dv" / "cocotb"
BUILD = Path(os.environ.get("TESS_COCOTB_BUILD", "target/cocotb")) / "top"
FAULTS = {
    "a carry is lost where half a ring's distance is rounded": "stage=points signal=v point ",
    "the next inner ring closes one index late": "stage=connect signal=i2 primitive ",
    "a stall loses the last point": "stage=points signal=u point ",
    "the unused index of a line is not 0": "stage=connect signal=i2 primitive ",
}
LIST = [line for line in (BENCH.parent / "circuit.faults").read_text().splitlines() if line.startswith("fault ")]
NUMBERS = {line.removeprefix("fault "): str(number) for number, line in enumerate(LIST, 1)}


def bench(tmp_path: Path, *options: str) -> "subprocess.CompletedProcess[str]":
    files = ["--build", str(BUILD), "--coverage", str(tmp_path / "coverage.xml")]
    return simulated(BENCH / "run_top.py", *files, *options)


def test_verilator_with_code_coverage(tmp_path: Path) -> None:
    run = bench(tmp_path)
    assert run.returncode == 0 and "3 tests, 0 failed" in run.stdout, run.stdout + run.stderr
    assert run.stdout.count(" 0 mismatches") == 3 and "every hole has its name: " in run.stdout, run.stdout


def test_icarus(tmp_path: Path) -> None:
    run = bench(tmp_path, "--sim", "icarus", "--elements", "500", "--random", "30", "--testcase", "random_patches")
    assert run.returncode == 0 and "1 tests, 0 failed" in run.stdout, run.stdout + run.stderr
    assert "30 counts, " in run.stdout and ", 0 mismatches" in run.stdout, run.stdout


@pytest.mark.parametrize("fault", sorted(FAULTS))
def test_planted_faults_are_named(tmp_path: Path, fault: str) -> None:
    options = ("--sim", "icarus", "--fault", NUMBERS[fault], "--random", "200", "--testcase", "random_patches")
    run = bench(tmp_path, *options)
    assert run.returncode == 1 and "1 tests, 1 failed" in run.stdout, run.stdout + run.stderr
    assert f"MISMATCH {FAULTS[fault]}" in run.stdout and "tess explain " in run.stdout, run.stdout


def test_foreign_source_and_sinks(tmp_path: Path) -> None:
    options = ("--sim", "icarus", "--foreign", "--random", "60")
    run = bench(tmp_path, *options)
    assert run.returncode == 0 and "1 tests, 0 failed" in run.stdout, run.stdout + run.stderr
    assert "60 counts, " in run.stdout, run.stdout
    fault = NUMBERS["the spare entry is overwritten"]
    run = bench(tmp_path, *options, "--fault", fault)
    assert run.returncode == 1 and "1 tests, 1 failed" in run.stdout, run.stdout + run.stderr


def test_pyuvm(tmp_path: Path) -> None:
    options = ("--sim", "icarus", "--uvm", "--random", "60")
    run = bench(tmp_path, *options)
    assert run.returncode == 0 and "1 tests, 0 failed" in run.stdout, run.stdout + run.stderr
    assert "60 counts, " in run.stdout and ", 0 mismatches" in run.stdout, run.stdout
    run = bench(tmp_path, *options, "--fault", NUMBERS["the blend is cut off, not rounded"])
    assert run.returncode == 1 and "1 tests, 1 failed" in run.stdout, run.stdout + run.stderr
    assert "MISMATCH stage=points signal=" in run.stdout and "tess explain " in run.stdout, run.stdout


def test_the_readme_has_the_component() -> None:
    source = (BENCH / "uvm_bench.py").read_text()
    component = source[source.index("class TessScoreboard") : source.index("class Monitors")].strip()
    readme = (Path(__file__).resolve().parents[1] / "README.md").read_text()
    assert textwrap.indent(component, "  ", lambda line: line.strip() != "") in readme


# ---- what is not reached ----------------------------------------------------------------------------


def judge(tmp_path: Path, holes: str, capsys: Any) -> "tuple[bool, str]":
    """The verdict on a file of two reached bits, one bit that is not, and a branch that is not."""
    source = tmp_path / "x.sv"
    source.write_text("if (a) b = 1; // never\n")
    lines = [(f"toggle/x\x01o\x02d[{bit}]", hits) for bit, hits in ((0, 3), (1, 1), (2, 0))]
    lines.append(("branch/x\x01o\x02if", 0))
    data = [f"C '\x01f\x02{source}\x01l\x021\x01page\x02v_{line}' {hits}\n" for line, hits in lines]
    # A second instance of the module.
    data.append(f"C '\x01f\x02{source}\x01l\x021\x01page\x02v_toggle/x\x01o\x02d[1]\x01h\x02other' 0\n")
    (tmp_path / "coverage.dat").write_text("# SystemC::Coverage-3\n" + "".join(data))
    (tmp_path / "holes.txt").write_text(holes)
    spec = importlib.util.spec_from_file_location("code_coverage", BENCH / "code_coverage.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    verdict = module.judge(tmp_path / "coverage.dat", tmp_path / "holes.txt")
    return verdict, capsys.readouterr().out


BRANCH = "x: if if (a) b = 1; # a is 0\n"
BIT = "x: toggle d[2] # padding\n"


@pytest.mark.parametrize(
    "holes, expected",
    [
        (BRANCH + BIT, "every hole has its name: 2"),
        (BRANCH, "not reached, without a name: x: toggle d[2]"),
        (BIT, "not reached, without a name: x: if if (a) b = 1;"),
        (BRANCH + BIT.replace("[2]", "[2:1]"), "named, but reached: x: toggle d[1]"),
        (BRANCH + BIT.replace("[2]", "[3:2]"), "named, but not there: x: toggle d[3]"),
        (BRANCH + BIT + "x: toggle e\n", "holes.txt:3: not `MODULE: WHAT # reason`"),
    ],
)
def test_holes_have_names(tmp_path: Path, capsys: Any, holes: str, expected: str) -> None:
    verdict, said = judge(tmp_path, holes, capsys)
    assert verdict == (holes == BRANCH + BIT) and expected in said, said
