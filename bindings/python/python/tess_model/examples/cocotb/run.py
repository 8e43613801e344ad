"""Runs the placer's bench in a simulator.

    python -m tess_model.examples.cocotb, or in a copy of this folder python run.py
                  [--sim verilator|icarus] [--random N] [--seed N] [--coverage FILE]
                  [--testcase level_1_stimuli|random_stimuli] [--rtl FOLDER]

The design is in the folder `design`, or in the folder of `--rtl`. It is built in ./sim_build. Exit status: 0
equal, 1 different, 2 no design.
"""

import argparse
import sys
from pathlib import Path
from typing import Any, Iterable

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


def simulate(
    options: argparse.Namespace, toplevel: str, bench: Path, design: Iterable[Path], build: Path, tests: int, **more: Any
) -> bool:
    """Builds a design, with more arguments of cocotb's `build`, and runs a bench; whether `tests` tests pass."""
    sys.path.insert(0, str(bench.parent))  # the simulator's interpreter gets this path, to find the bench
    common: "dict[str, Any]" = {"hdl_toplevel": toplevel, "build_dir": build, "timescale": ("1ns", "1ps")}
    runner = get_runner(options.sim)
    # Always: the files of another design may be older than the last build.
    runner.build(verilog_sources=list(design), always=True, **common, **more)
    environment = {f"TESS_{name.upper()}": str(value) for name, value in vars(options).items()}
    results = runner.test(
        test_module=bench.stem,
        testcase=options.testcase,
        test_dir=build,
        extra_env={**environment, "TESS_COVERAGE": str(options.coverage.resolve())},
        **common,
    )
    ran, failed = get_results(results)
    print(f"{ran} tests, {failed} failed")
    return bool(failed == 0 and ran == (1 if options.testcase else tests))


def main() -> int:
    options = arguments()
    build = (options.build / options.sim).resolve()
    return 0 if simulate(options, "tess_placer", HERE / "bench.py", sources(options.rtl), build, 2) else 1


if __name__ == "__main__":
    sys.exit(main())
