"""Compares the Python call with the Rust call: 10000 quads of factor 8 into existing arrays.

    python benches/speed.py

The two alternate; each figure is the best of 5 turns of 30 calls each. It needs cargo.
"""

import subprocess
import time
from pathlib import Path

import numpy as np

from tess_model import Tessellator

PACKAGE = Path(__file__).resolve().parents[1]
RATE = PACKAGE / "target" / "release" / "examples" / "rate"
PATCHES = 10_000


def rust() -> float:
    return float(subprocess.run([RATE], check=True, capture_output=True, text=True).stdout)


def python() -> float:
    factors = np.full((PATCHES, 6), 8, np.float32)
    tessellator = Tessellator()
    counts = tessellator.count("quad", factors)
    out = (
        np.zeros((counts.points, 2), np.float32),
        np.zeros(counts.indices, np.uint32),
        np.zeros((PATCHES, 4), np.uint32),
    )
    best = float("inf")
    for _ in range(30):
        start = time.perf_counter()
        tessellator.tessellate("quad", factors, out=out)
        best = min(best, time.perf_counter() - start)
    return best


def main() -> None:
    subprocess.run(["cargo", "build", "--release", "--example", "rate"], cwd=PACKAGE, check=True)
    turns = [(rust(), python()) for _ in range(5)]
    in_rust, in_python = min(turn[0] for turn in turns), min(turn[1] for turn in turns)
    for name, seconds in (("Rust", in_rust), ("Python", in_python)):
        print(f"{name:<7} {seconds * 1e3:6.2f} ms, {PATCHES / seconds / 1e6:5.2f} million patches a second")
    print(f"Python has {in_rust / in_python:.2f} of the speed of Rust")


if __name__ == "__main__":
    main()
