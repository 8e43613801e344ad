#!/usr/bin/env python3
"""Times one patch per call from each language: nanoseconds, and the ratio to the Rust call.

    python3 bindings/c/examples/calls/run.py [--target-dir DIR]

Builds tess-capi for release, main.rs, calls.c with cc, and calls.sv with Verilator if it is installed. The Python
package (bindings/python) is timed if it can be imported. A patch is a quad of factor K with integer partitioning.
Points are 16.16 numbers, and indices have 32 bits. All calls write to the same memory, except that Python makes new
arrays. The programs run in five turns; a figure is the smallest of all turns.
"""

import argparse
import shutil
import subprocess
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
WORKSPACE = HERE.parents[3]
FACTORS = [1, 2, 4, 8, 64]
LIBRARIES = ["-lpthread", "-ldl", "-lm"]


def build(target):
    """Builds the programs; returns their commands by language."""
    subprocess.run(
        ["cargo", "build", "--release", "-p", "tess-capi", "--lib", "--example", "calls", "--target-dir", target],
        cwd=WORKSPACE,
        check=True,
    )
    folder = target / "calls"
    folder.mkdir(exist_ok=True)
    archive = target / "release" / "libtess_capi.a"
    include = HERE.parents[1] / "include"
    command = ["cc", "-std=c99", "-O2", "-I", include, HERE / "calls.c", HERE / "clock.c", archive]
    subprocess.run(command + LIBRARIES + ["-o", folder / "calls"], check=True)
    programs = {"Rust": [target / "release" / "examples" / "calls"], "C": [folder / "calls"]}
    if shutil.which("verilator"):
        sources = [HERE.parents[1] / "verilog" / "tess_dpi.sv", HERE / "calls.sv", HERE / "clock.c", archive]
        options = ["--binary", "-O3", "-CFLAGS", "-O2", "--top-module", "calls", "--Mdir", folder / "dpi"]
        said = subprocess.run(
            ["verilator"] + options + sources + ["-LDFLAGS", " ".join(LIBRARIES)], capture_output=True, text=True
        )
        if said.returncode:
            raise SystemExit(said.stdout + said.stderr)
        programs["DPI-C"] = [folder / "dpi" / "Vcalls"]
    return programs


def timed(command):
    """The times of each factor, as a program prints them."""
    said = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    rows = [line.split() for line in said.splitlines() if line[:1].isdigit()]
    return {int(row[0]): [float(figure) for figure in row[1:]] for row in rows}


def python():
    """For each factor the time to make a patch, and to make it and both arrays; None without the package."""
    try:
        from tess_model import Patch
    except ImportError:
        return None

    def least(call):
        best = float("inf")
        for _ in range(30):
            start = time.perf_counter()
            for _ in range(200):
                call()
            best = min(best, time.perf_counter() - start)
        return best / 200 * 1e9

    def arrays(factor):
        patch = Patch("quad", outer=[factor] * 4, inner=[factor] * 2)
        return patch.points, patch.indices

    return {
        k: [least(lambda: Patch("quad", outer=[k] * 4, inner=[k] * 2)), least(lambda: arrays(k))] for k in FACTORS
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--target-dir", type=Path, default=WORKSPACE / "target")
    programs = build(parser.parse_args().target_dir.resolve())
    turns = [{name: timed(command) for name, command in programs.items()} for _ in range(5)]
    times = {name: [[turn[name][k] for turn in turns] for k in FACTORS] for name in programs}
    rows = {"Rust": 0, "C": 0, "DPI-C": 0, "DPI-C, every element read": 1}
    table = {
        row: [min(figures[column] for figures in each) for each in times[row.split(",")[0]]]
        for row, column in rows.items()
        if row.split(",")[0] in times
    }
    if found := python():
        table["Python, Patch(...)"] = [found[k][0] for k in FACTORS]
        table["Python, Patch(...) and its arrays"] = [found[k][1] for k in FACTORS]
    print("| call | " + " | ".join(f"factor {k}" for k in FACTORS) + " |")
    print("| --- |" + " --- |" * len(FACTORS))
    for row, figures in table.items():
        cells = [f"{ns:.0f} / {ns / rust:.2f}" for ns, rust in zip(figures, table["Rust"])]
        print(f"| {row} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
