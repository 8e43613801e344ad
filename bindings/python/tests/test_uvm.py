"""bindings/uvm in slang, which knows the covergroups that Verilator does not."""

import shutil
from pathlib import Path

import pyslang

BINDINGS = Path(__file__).resolve().parents[2]
UVM = BINDINGS / "uvm"


def errors(sources: Path) -> int:
    """The errors of the package in this folder, with the stub of UVM."""
    files = [
        UVM / "tests" / "stub" / "uvm_pkg.sv",
        BINDINGS / "c" / "verilog" / "tess_dpi.sv",
        sources / "tess_uvm.sv",
        UVM / "tests" / "tb_uvm.sv",
    ]
    driver = pyslang.driver.Driver()
    driver.addStandardArgs()
    folders = f"-I {sources} -I {UVM / 'tests' / 'stub'}"
    words = ["slang", "--single-unit", "--top tb_uvm", folders, *map(str, files)]
    assert driver.parseCommandLine(" ".join(words))
    assert driver.processOptions() and driver.parseAllSources()
    diagnostics = driver.createCompilation().getAllDiagnostics()
    return sum(diagnostic.isError() for diagnostic in diagnostics)


def test_the_package_elaborates_with_its_covergroups(tmp_path: Path) -> None:
    assert errors(UVM / "src") == 0
    faulty = tmp_path / "src"
    shutil.copytree(UVM / "src", faulty)
    covergroups = faulty / "tess_covergroups.svh"
    text = covergroups.read_text()
    covergroups.write_text(text.replace("coverpoint bin ", "coverpoint other ", 1))
    assert errors(faulty) > 0, "an unknown name in a covergroup is seen"
