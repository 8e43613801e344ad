"""Runs the placer's bench in a simulator.

    python -m tess_model.examples.cocotb, or in a copy of this folder python run.py
                  [--sim verilator|icarus] [--random N] [--seed N] [--coverage FILE]
                  [--testcase level_1_stimuli|random_stimuli] [--rtl FOLDER]

The design is that of the folder `design`, or of `--rtl`; what is built goes to ./sim_build. Exit status: 0
equal, 1 different, 2 no design.
"""

import argparse
import sys
from pathlib import Path

from cocotb.runner import get_results, get_runner

HERE = Path(__file__).resolve().parent
RTL = HERE / "design"
PLACER = ["delay", "factor_context", "place_blend", "place_position", "placer", "reciprocal"]


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Runs the placer's bench in a simulator.")
    parser.add_argument("--sim", choices=["verilator", "icarus"], default="verilator")
    parser.add_argument("--random", type=int, default=500, help="random factors, every point of each")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--coverage", type=Path, default=Path("coverage.xml"), help="file to add to")
    parser.add_argument("--build", type=Path, default=Path("sim_build"), help="folder to build in")
    parser.add_argument("--testcase", help="one test alone")
    parser.add_argument("--rtl", type=Path, default=RTL, help="folder of the design")
    options = parser.parse_args()
    missing = [name for name in sources(options.rtl) if not name.is_file()]
    if missing:
        parser.error(f"no design: {missing[0]} is no file; --rtl names its folder")
    return options


def sources(rtl: Path) -> "list[Path]":
    return [rtl.resolve() / f"tess_{module}.sv" for module in PLACER]


def main() -> int:
    options = arguments()
    sys.path.insert(0, str(HERE))  # the simulator's interpreter gets this path, and looks for the bench
    build = (options.build / options.sim).resolve()
    runner = get_runner(options.sim)
    runner.build(
        verilog_sources=sources(options.rtl),
        hdl_toplevel="tess_placer",
        build_dir=build,
        timescale=("1ns", "1ps"),
        always=True,  # another design may have older files
    )
    results = runner.test(
        test_module="bench",
        testcase=options.testcase,
        hdl_toplevel="tess_placer",
        build_dir=build,
        test_dir=build,
        timescale=("1ns", "1ps"),
        extra_env={
            "TESS_COVERAGE": str(options.coverage.resolve()),
            "TESS_RANDOM": str(options.random),
            "TESS_SEED": str(options.seed),
        },
    )
    tests, failed = get_results(results)
    print(f"{tests} tests, {failed} failed")
    return 1 if failed or tests != (1 if options.testcase else 2) else 0


if __name__ == "__main__":
    sys.exit(main())
