"""bindings/uvm in slang, which knows the covergroups that Verilator does not, with the UVM in the folder `UVM_HOME`."""

import os
import shutil
import subprocess
from pathlib import Path

import pyslang
import pytest

UVM = Path(__file__).resolve().parents[2] / "uvm"
TREE = UVM.parents[1]
HOME = os.environ.get("UVM_HOME", "")
pytestmark = pytest.mark.skipif(not HOME, reason="not run: UVM_HOME does not name the folder of a UVM")


def errors(tree: Path, top: str, *further: str) -> int:
    """The errors of the package and further files or options in a tree."""
    uvm = tree / "bindings" / "uvm"
    home = Path(HOME) / "src"
    files = [home / "uvm_pkg.sv", UVM.parent / "c" / "verilog" / "tess_dpi.sv", uvm / "src" / "tess_uvm.sv"]
    driver = pyslang.driver.Driver()
    driver.addStandardArgs()
    words = ["slang", "--single-unit", "--timescale", "1ns/1ps", "--top", top, "-I", str(uvm / "src"), "-I", str(home)]
    assert driver.parseCommandLine(" ".join([*words, *map(str, files), *further]))
    assert driver.processOptions() and driver.parseAllSources()
    diagnostics = driver.createCompilation().getAllDiagnostics()
    return sum(diagnostic.isError() for diagnostic in diagnostics)


def example(tree: Path, *further: str) -> int:
    """The errors of the example around the circuit, with further files."""
    return errors(tree, "tb_example", "-F", str(tree / "bindings/uvm/example/files.f"), *further)


@pytest.fixture
def tree(tmp_path: Path, program: Path) -> Path:
    """A tree with bindings/uvm and the covergroups that the program writes."""
    copy = tmp_path / "bindings" / "uvm"
    for folder in ("src", "example"):
        shutil.copytree(UVM / folder, copy / folder)
    (tmp_path / "rtl").symlink_to(TREE / "rtl")
    subprocess.run([program, "coverage", "--covergroups", copy / "src" / "tess_covergroups.svh"], check=True)
    return tmp_path


def plant(tree: Path, name: str, right: str, wrong: str) -> None:
    """Plants a fault in a file of bindings/uvm."""
    file = tree / "bindings" / "uvm" / name
    text = file.read_text()
    assert right in text, f"{name} has {right}"
    file.write_text(text.replace(right, wrong, 1))


def test_the_package_elaborates_with_its_covergroups(tree: Path) -> None:
    assert example(tree, str(UVM / "tests" / "tess_tests.sv")) == 0
    plant(tree, "src/tess_covergroups.svh", "coverpoint bin ", "coverpoint other ")
    assert example(tree) > 0, "an unknown name in a covergroup is seen"


def test_the_example_elaborates_around_the_circuit(tree: Path) -> None:
    assert example(tree) == 0


@pytest.mark.parametrize(
    "name, right, wrong",
    [
        ("example/tb_example.sv", ".point_last ", ".points_last "),
        ("example/tess_if.sv", "primitive_i2;", "primitive_i3;"),
        ("example/tess_env.svh", "scoreboard.observed.analysis_export", "scoreboard.seen.analysis_export"),
        ("example/tess_env.svh", "agent.monitor.results", "agent.monitor.patches"),
        ("example/tess_agent.svh", "driver.seq_item_port", "driver.item_port"),
        ("example/files.f", "-F ../../../rtl/tess.f\n", ""),
    ],
)
def test_faults_of_the_example_are_seen(tree: Path, name: str, right: str, wrong: str) -> None:
    plant(tree, name, right, wrong)
    assert example(tree) > 0, f"{wrong} in {name}"
