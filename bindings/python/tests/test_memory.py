"""Nothing grows: 10000 calls of everything, after a few to warm up."""

import gc
from pathlib import Path
from typing import Callable

import numpy as np
import pytest

from tess_model import Coverage, Patch, TessError, Tessellator, check_device, tessellate

PATCH = Patch("quad", [3, 4.5, 5, 6], [4, 7], partitioning="fractional_even")
FACTORS = np.full((20, 6), 5, np.float32)
TESSELLATOR = Tessellator()
COVERAGE = Coverage()
OUT = (np.zeros((2000, 2), np.float32), np.zeros(4000, np.uint16))


def refused() -> None:
    try:
        tessellate("quad", FACTORS, out=(OUT[0][:1], OUT[1]))
    except TessError:
        return
    raise AssertionError("an output of one point is refused")


def resident() -> int:
    """Bytes of memory that the process has in use."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * 4096


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="needs Linux's /proc")
@pytest.mark.parametrize(
    "call",
    [
        lambda: (PATCH.points, PATCH.indices, PATCH.points_f32),
        lambda: PATCH.processed,
        lambda: (PATCH.locate_point(3), PATCH.place("u0", 1), PATCH.point(2)),
        lambda: PATCH.explain(point=3),
        lambda: PATCH.explanation(primitive=3),
        lambda: tessellate("quad", FACTORS),
        lambda: TESSELLATOR.tessellate("quad", FACTORS, out=OUT),
        lambda: COVERAGE.record(PATCH),
        lambda: check_device([(PATCH, PATCH.points, PATCH.indices)]),
        refused,
    ],
    ids=["arrays", "processed", "elements", "explain", "explanation", "batch", "out", "coverage", "check", "refused"],
)
def test_no_growth(call: "Callable[[], object]") -> None:
    for _ in range(500):
        call()
    gc.collect()
    before = resident()
    for _ in range(10_000):
        call()
    gc.collect()
    # A leak of 100 bytes a call is a megabyte.
    assert resident() - before < 1_000_000
