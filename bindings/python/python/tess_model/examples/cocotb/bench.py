"""A bench of tess_placer in Python, as a pattern for a bench of your own design.

A stimulus is a factor and a point of its edge. Three clocks later the design outputs the location, with
every signal of its three stages. `tess_model` is the reference. `run.py` runs this in a simulator.
"""

import os
import random
from collections import deque
from functools import lru_cache
from pathlib import Path
from typing import Any, Iterable, Iterator, NamedTuple

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import FallingEdge

import tess_model

ONE = 0x10000


class Factor(NamedTuple):
    """A 15.16 factor with its parity (`even`, `odd`) and split order (`ruler`, `center`)."""

    fixed: int
    parity: str
    split_order: str


class Stimulus(NamedTuple):
    factor: Factor
    p: int


# ---- stimuli ----------------------------------------------------------------------------------------


def in_range(fixed: int, parity: str) -> bool:
    if parity == "odd":
        return ONE <= fixed <= 63 * ONE
    return fixed == ONE or 2 * ONE <= fixed <= 64 * ONE


def level_1() -> Iterator[Factor]:
    """Every integer and half with its neighbours at one unit, both parities, both split orders."""
    for split_order in ("ruler", "center"):
        for parity in ("even", "odd"):
            for fixed in (half + offset for half in range(ONE, 65 * ONE, ONE // 2) for offset in (-1, 0, 1)):
                if in_range(fixed, parity):
                    yield Factor(fixed, parity, split_order)


def constrained_random(seed: int, count: int) -> Iterator[Factor]:
    """Factors in range; every third is within 16 units of an integer, where designs tend to fail."""
    source = random.Random(seed)
    for i in range(count):
        parity, split_order = source.choice(("even", "odd")), source.choice(("ruler", "center"))
        fixed = 0
        while not in_range(fixed, parity):
            near = source.randint(1, 64) * ONE + source.randint(-16, 16)
            fixed = near if i % 3 == 0 else source.randint(ONE, 64 * ONE)
        yield Factor(fixed, parity, split_order)


# ---- reference --------------------------------------------------------------------------------------

context = lru_cache(maxsize=None)(tess_model.context)


def expected(stimulus: Stimulus) -> "dict[tuple[str, str], int]":
    """The model's value of each signal, by stage and signal, in the order of the data flow."""
    factor, p = stimulus
    c, placed = context(*factor), tess_model.place(factor.fixed, factor.parity, p, factor.split_order)
    values = {
        ("factor_context", name): getattr(c, name)
        for name in ("fraction", "half_points", "points", "split", "inv_floor", "inv_ceil")
    }
    blend = placed.blend or tess_model.Blend(coarse=0, fine=0, fraction=0)
    values["place_position", "flip"] = int(placed.flip)
    values["place_position", "position"] = placed.position
    values["place_position", "coarse"] = blend.coarse
    values["place_position", "fine"] = blend.fine
    values["place_blend", "half_location"] = placed.half_location
    values["place_blend", "location"] = placed.location
    return values


# ---- driver, monitor, scoreboard --------------------------------------------------------------------


class Bench:
    """Drives the inputs and reads the outputs at falling edges."""

    def __init__(self, dut: Any) -> None:
        self.dut = dut
        self.in_flight: "deque[Stimulus]" = deque()
        self.checked = 0
        self.wrong: "list[str]" = []
        self.coverage = tess_model.Coverage()

    async def reset(self) -> None:
        self.dut.in_valid.value = 0
        self.dut.rst.value = 1
        cocotb.start_soon(Clock(self.dut.clk, 10, units="ns").start())
        for _ in range(3):
            await FallingEdge(self.dut.clk)
        self.dut.rst.value = 0
        cocotb.start_soon(self.monitor())

    async def drive(self, factors: Iterable[Factor]) -> None:
        dut = self.dut
        for factor in factors:
            self.coverage.record_context(*factor)
            dut.in_factor.value = factor.fixed
            dut.in_odd.value = factor.parity == "odd"
            dut.in_center.value = factor.split_order == "center"
            for p in range(context(*factor).points):
                dut.in_valid.value = 1
                dut.in_p.value = p
                self.in_flight.append(Stimulus(factor, p))
                await FallingEdge(dut.clk)
        dut.in_valid.value = 0
        for _ in range(8):
            await FallingEdge(dut.clk)

    async def monitor(self) -> None:
        while True:
            await FallingEdge(self.dut.clk)
            if self.dut.out_valid.value == 1:
                assert self.in_flight, "a location came that nobody asked for"
                self.check(self.in_flight.popleft())

    def check(self, stimulus: Stimulus) -> None:
        self.checked += 1
        for (stage, signal), value in expected(stimulus).items():
            observed = int(getattr(self.dut, f"out_{signal}").value)
            if observed != value:
                wrong = f"stage={stage} signal={signal} observed={observed:#x} expected={value:#x} {stimulus}"
                self.wrong.append(wrong)
                return  # later signals follow from it

    def add_coverage(self, file: Path) -> None:
        """Adds the bins to a file. All stimuli count, whatever the design answered."""
        if file.exists():
            self.coverage.merge(tess_model.Coverage.read(file))
        self.coverage.write(file)

    def verdict(self) -> None:
        self.dut._log.info(f"{self.checked} vectors, {len(self.wrong)} mismatches")
        assert self.checked > 0 and not self.in_flight, f"{len(self.in_flight)} locations never came"
        assert not self.wrong, "\n".join([f"{len(self.wrong)} mismatches", *self.wrong[:20]])


async def run(dut: Any, factors: Iterable[Factor]) -> None:
    bench = Bench(dut)
    await bench.reset()
    await bench.drive(factors)
    bench.add_coverage(Path(os.environ["TESS_COVERAGE"]))
    bench.verdict()


@cocotb.test()
async def level_1_stimuli(dut: Any) -> None:
    await run(dut, level_1())


@cocotb.test()
async def random_stimuli(dut: Any) -> None:
    await run(dut, constrained_random(int(os.environ["TESS_SEED"]), int(os.environ["TESS_RANDOM"])))
