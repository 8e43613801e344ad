"""Runs the circuit's cocotb bench in a simulator, and judges its coverage.

    python run_top.py [--sim verilator|icarus] [--fault N] [--elements N] [--random N] [--seed N]
                      [--testcase NAME] [--build FOLDER] [--coverage FILE] [--foreign | --uvm]

Exit status: 0 equal, and every hole in the code coverage is named in holes.txt; 1 otherwise. `--fault` takes a design
with a planted fault of rtl/dv/circuit.faults. `--elements` bounds the systematic part, 0 leaves it out: 10 million have all
of it, and then the functional coverage must be whole. Only Verilator covers code. `--foreign` runs foreign_bench.py instead: the
padded ports with register stages, between the source and the sinks of cocotbext-axi; `--uvm` runs uvm_bench.py, a test of
pyuvm. Neither judges coverage.
"""

import argparse
import subprocess
import sys
from pathlib import Path

import code_coverage  # next to this file
from tess_model import Coverage
from tess_model.examples.cocotb import run

HERE = Path(__file__).resolve().parent
RTL = HERE.parents[1]
WHOLE = 10_000_000
FILES = [line for line in (RTL / "tess.f").read_text().splitlines() if line.endswith(".sv")]


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sim", choices=["verilator", "icarus"], default="verilator")
    parser.add_argument("--fault", type=int, default=0)
    parser.add_argument("--elements", type=int, default=20_000, help="of the systematic patches")
    parser.add_argument("--random", type=int, default=60, help="random patches")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--testcase", help="only this test")
    parser.add_argument("--foreign", action="store_true", help="padded ports, with source and sinks of cocotbext-axi")
    parser.add_argument("--uvm", action="store_true", help="a test of pyuvm")
    parser.add_argument("--build", type=Path, default=Path("sim_build"), help="folder to build in")
    parser.add_argument("--coverage", type=Path, default=Path("coverage.xml"), help="functional coverage, written anew")
    return parser.parse_args()


def simulate(options: argparse.Namespace, build: Path) -> bool:
    """Whether all tests pass."""
    design = RTL
    if options.fault:
        design = build / "design"
        subprocess.run([RTL / "dv/rig/run", "--plant", design, str(options.fault)], check=True)
    sources = [design / file for file in FILES]
    verilator = options.sim == "verilator"
    if options.foreign:
        more = {"parameters": {"PADDED": 1, "BUFFERED": 1}, "build_args": ["-Wno-fatal"] if verilator else []}
        return run.simulate(options, "tess_axis", HERE / "foreign_bench.py", sources, build, 1, includes=[design], **more)
    if options.uvm:
        more = {"build_args": ["-Wno-fatal"] if verilator else []}
        return run.simulate(options, "tess_axis", HERE / "uvm_bench.py", sources, build, 1, includes=[design], **more)
    covers = ["--coverage-line", "--coverage-toggle", "-Wno-fatal"] if verilator else []
    return run.simulate(
        options, "tess_axis", HERE / "top_bench.py", sources, build, 3, includes=[design], build_args=covers
    )


def main() -> int:
    options = arguments()
    bench = "-foreign" if options.foreign else "-uvm" if options.uvm else ""
    build = (options.build / f"{options.sim}-{options.fault}{bench}").resolve()
    options.coverage.unlink(missing_ok=True)
    if not simulate(options, build):
        return 1
    if options.foreign or options.uvm:
        return 0
    functional = Coverage.read(options.coverage)
    print("\nfunctional coverage, by the model:")
    print("\n".join(line for line in functional.report().splitlines() if not line.startswith("missed ")))
    is_covered = not (options.elements >= WHOLE and functional.missed)
    if options.sim == "verilator" and not options.testcase:
        print("\ncode coverage, by Verilator:")
        is_covered &= code_coverage.judge(build / "coverage.dat", HERE / "holes.txt")
    return 0 if is_covered else 1


if __name__ == "__main__":
    sys.exit(main())
