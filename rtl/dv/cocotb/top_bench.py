"""The bench of tess_axis, and of tess_top in it, in Python: driver, monitors, scoreboard, coverage.

`tess_model` is the reference. `run_top.py` runs this in a simulator and judges its coverage.
"""

import os
import random
from itertools import chain
from pathlib import Path
from typing import Any, Iterable, Iterator

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import FallingEdge, RisingEdge

from tess_model import Coverage, Patch, Scoreboard, generate

DOMAINS = ("isoline", "tri", "quad")
PARTITIONINGS = ("integer", "pow2", "fractional_odd", "fractional_even")
OUTPUTS = ("point", "line", "triangle_cw", "triangle_ccw")
SPLITS = ("ruler", "center")
PATIENCE = 20_000
"""Clocks without an element after which the output is considered to have ended."""


# ---- stimuli ----------------------------------------------------------------------------------------


def covering(elements: int) -> "Iterator[Patch]":
    """Patches of level 1 that each hit a new bin of the functional coverage, small ones first; together they have
    about this number of points and primitives."""
    size = {patch: patch.counts.points + patch.counts.primitives for patch in generate(level=1)}
    coverage = Coverage()
    for patch in sorted(size, key=lambda patch: size[patch]):
        if elements <= 0:
            return
        if coverage.record(patch) > 0:
            elements -= size[patch]
            yield patch


def extremes() -> "Iterator[Patch]":
    """Patches with the largest numbers, and with every half edge: they reach every bit and branch of the circuit."""
    yield Patch("quad", [64.0] * 4, [64.0] * 2, output="point", split="center")
    yield Patch("quad", [64.0] * 4, [64.0] * 2, output="triangle_ccw")
    yield Patch("quad", [1.0] * 4, [64.0, 63.0])
    yield Patch("quad", [1.0] * 4, [64.0, 2.0])
    yield Patch("isoline", [64.0] * 2, output="line")
    yield Patch("tri", [64.0] * 3, [64.0])
    for first in range(1, 65, 8):
        yield Patch("quad", [float(first + offset) for offset in (0, 2, 4, 6)], [2.0, 2.0])


def constrained_random(source: random.Random, count: int) -> Iterator[Patch]:
    """Every configuration; most factors are small, every fourth is near an integer, and some are any bits."""

    def factor() -> float:
        kind = source.randrange(16)
        if kind == 0:
            return -source.random() if source.randrange(8) == 0 else source.choice((float("nan"), float("inf"), 0.0))
        whole = source.randint(1, 1 << source.randrange(7))
        return whole + (source.choice((0, 2.0**-16, -(2.0**-16))) if kind < 4 else source.random())

    for _ in range(count):
        domain = source.choice(DOMAINS)
        outer, inner = {"isoline": (2, 0), "tri": (3, 1), "quad": (4, 2)}[domain]
        yield Patch(
            domain,
            [factor() for _ in range(outer)],
            [factor() for _ in range(inner)],
            partitioning=source.choice(PARTITIONINGS),
            output=source.choice(OUTPUTS),
            split=source.choice(SPLITS),
        )


def packed(patch: Patch) -> int:
    """The patch in the form of `s_axis_patch_tdata` (rtl/tess_axis.sv)."""
    word = DOMAINS.index(patch.domain) | PARTITIONINGS.index(patch.partitioning) << 2
    word |= OUTPUTS.index(patch.output) << 4 | SPLITS.index(patch.split) << 6
    for number, bits in enumerate(patch.factor_bits):
        word |= bits << 8 + 32 * number
    return word


# ---- driver, monitors -------------------------------------------------------------------------------


class Stream:
    """The signals of an AXI4-Stream port."""

    def __init__(self, dut: Any, name: str) -> None:
        self.valid, self.ready = getattr(dut, f"{name}_tvalid"), getattr(dut, f"{name}_tready")
        self.data, self.last = getattr(dut, f"{name}_tdata"), getattr(dut, f"{name}_tlast", None)

    def passes(self) -> bool:
        return bool(self.valid.value == 1 and self.ready.value == 1)


class Bench:
    """Drives at falling edges; the monitors sample at rising edges."""

    def __init__(self, dut: Any, gaps: "random.Random | None") -> None:
        self.dut, self.gaps = dut, gaps
        self.patches = Stream(dut, "s_axis_patch")
        self.counts = Stream(dut, "m_axis_counts")
        self.points = Stream(dut, "m_axis_point")
        self.primitives = Stream(dut, "m_axis_primitive")
        self.board = Scoreboard()
        self.idle = 0

    async def start(self) -> None:
        self.patches.valid.value = 0
        for stream in (self.counts, self.points, self.primitives):
            stream.ready.value = 1
        cocotb.start_soon(Clock(self.dut.aclk, 10, units="ns").start())
        await self.reset()
        cocotb.start_soon(self.watch(self.counts, self.see_counts))
        cocotb.start_soon(self.watch(self.points, self.see_point))
        cocotb.start_soon(self.watch(self.primitives, self.see_primitive))
        if self.gaps:
            cocotb.start_soon(self.press_back(self.gaps))

    async def reset(self) -> None:
        self.patches.valid.value = 0
        self.dut.aresetn.value = 0
        self.board.reset()
        for _ in range(2):
            await FallingEdge(self.dut.aclk)
        self.board.reset()
        self.dut.aresetn.value = 1

    async def press_back(self, source: random.Random) -> None:
        """Stalls each stream in every fourth clock."""
        while True:
            await FallingEdge(self.dut.aclk)
            for stream in (self.counts, self.points, self.primitives):
                stream.ready.value = source.randrange(4) != 0

    async def send(self, patch: Patch) -> None:
        """Offers a patch until the circuit accepts it."""
        if self.gaps and self.gaps.randrange(8) == 0:
            for _ in range(self.gaps.randrange(24)):
                await FallingEdge(self.dut.aclk)
        self.patches.data.value = packed(patch)
        self.patches.valid.value = 1
        while True:
            await RisingEdge(self.dut.aclk)
            if self.patches.passes():
                break
        self.board.accept(patch)
        await FallingEdge(self.dut.aclk)
        self.patches.valid.value = 0

    async def watch(self, stream: Stream, see: Any) -> None:
        while True:
            await RisingEdge(self.dut.aclk)
            if self.dut.aresetn.value == 1 and stream.passes():
                self.idle = 0
                see(int(stream.data.value), stream.last is not None and stream.last.value == 1)

    def see_counts(self, data: int, _: bool) -> None:
        self.board.counts(data & 0x1FFF, data >> 16 & 0x3FFF)

    def see_point(self, data: int, last: bool) -> None:
        self.board.point(data & 0x1FFFF, data >> 24 & 0x1FFFF, last)

    def see_primitive(self, data: int, last: bool) -> None:
        indices = [data & 0x1FFF, data >> 16 & 0x1FFF, data >> 32 & 0x1FFF]
        self.board.primitive(indices, last, size=data >> 48)

    async def drain(self) -> None:
        """Waits until the output is complete or has stopped."""
        while self.board.due and self.idle < PATIENCE:
            self.idle += 1
            await FallingEdge(self.dut.aclk)
        for _ in range(32):  # nothing may follow
            await FallingEdge(self.dut.aclk)

    def verdict(self) -> None:
        board = self.board
        file = Path(os.environ["TESS_COVERAGE"])
        if file.exists():
            board.coverage.merge(Coverage.read(file))
        board.coverage.write(file)
        tally = ", ".join(f"{number} {name}" for name, number in board.checked.items())
        self.dut._log.info(f"{tally}, {board.wrong} mismatches")
        assert not board.mismatches, "\n".join(map(str, board.mismatches))
        assert not board.due, "never came: " + "; ".join(board.missing())
        assert min(board.checked.values()) > 0, "nothing was compared"


async def run(dut: Any, patches: Iterable[Patch], gaps: "random.Random | None") -> None:
    bench = Bench(dut, gaps)
    await bench.start()
    for patch in patches:
        if bench.board.wrong:
            break  # later differences follow from it
        await bench.send(patch)
    await bench.drain()
    bench.verdict()


@cocotb.test()
async def covering_patches(dut: Any) -> None:
    await run(dut, chain(extremes(), covering(int(os.environ["TESS_ELEMENTS"]))), None)


@cocotb.test()
async def random_patches(dut: Any) -> None:
    source = random.Random(int(os.environ["TESS_SEED"]))
    await run(dut, constrained_random(source, int(os.environ["TESS_RANDOM"])), source)


@cocotb.test()
async def resets_within_patches(dut: Any) -> None:
    source = random.Random(int(os.environ["TESS_SEED"]))
    bench = Bench(dut, source)
    await bench.start()
    for patch in constrained_random(source, 20):
        await bench.send(patch)
        for _ in range(source.randrange(40)):
            await FallingEdge(dut.aclk)
        await bench.reset()
    for patch in constrained_random(source, 20):
        await bench.send(patch)
    await bench.drain()
    bench.verdict()
