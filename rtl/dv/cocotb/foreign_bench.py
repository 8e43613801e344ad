"""Tests the ports of tess_axis with the source and sinks of an independent library, `cocotbext-axi`, under random stalls.

The words are those that DMA engines take, in bytes: 32 for a patch, 4 for counts, 8 for a point or a primitive. A frame of points
or of primitives ends with `tlast`, so it must be exactly a patch's.
"""

import os
import random
from typing import Any, Iterator

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import FallingEdge, with_timeout
from cocotbext.axi import AxiStreamBus, AxiStreamFrame, AxiStreamSink, AxiStreamSource

from tess_model import Patch, Scoreboard
from top_bench import constrained_random, packed


def stalls(seed: int, share: float) -> "Iterator[bool]":
    """For each clock whether to pause; true in this share of the clocks."""
    source = random.Random(seed)
    while True:
        yield source.random() < share


def words(frame: AxiStreamFrame, size: int) -> "list[int]":
    """The words of a frame, each of this number of bytes."""
    data = bytes(frame.tdata)
    return [int.from_bytes(data[at : at + size], "little") for at in range(0, len(data), size)]


async def next_frame(sink: AxiStreamSink) -> AxiStreamFrame:
    return await with_timeout(sink.recv(), 1, "ms")


async def compare(board: Scoreboard, patch: Patch, sinks: "list[AxiStreamSink]") -> None:
    """Receives a word of counts and, unless the patch is culled, a frame of points and one of primitives."""
    counts, points, primitives = sinks
    board.accept(patch)
    (word,) = words(await next_frame(counts), 4)
    board.counts(word & 0x1FFF, word >> 16 & 0x3FFF)
    if patch.counts.points == 0:
        return
    all_points = words(await next_frame(points), 8)
    for number, word in enumerate(all_points):
        board.point(word & 0x1FFFF, word >> 24 & 0x1FFFF, number + 1 == len(all_points))
        assert word >> 41 == 0, "padding"
    all_primitives = words(await next_frame(primitives), 8)
    for number, word in enumerate(all_primitives):
        indices = [word >> shift & 0x1FFF for shift in (0, 16, 32)]
        board.primitive(indices, number + 1 == len(all_primitives), size=word >> 48 & 3)
        assert word >> 50 == 0, "padding"


@cocotb.test()
async def foreign_source_and_sinks(dut: Any) -> None:
    seed = int(os.environ["TESS_SEED"])
    dut.aresetn.value = 0
    cocotb.start_soon(Clock(dut.aclk, 10, units="ns").start())
    port = {"clock": dut.aclk, "reset": dut.aresetn, "reset_active_level": False}
    source = AxiStreamSource(AxiStreamBus.from_prefix(dut, "s_axis_patch"), **port)
    names = ("m_axis_counts", "m_axis_point", "m_axis_primitive")
    sinks = [AxiStreamSink(AxiStreamBus.from_prefix(dut, name), **port) for name in names]
    for number, end in enumerate([source, *sinks]):
        end.set_pause_generator(stalls(seed + number, 0.3))
        assert (end.byte_size, end.byte_lanes) == (8, [32, 4, 8, 8][number]), "bytes of a word"
    for _ in range(3):
        await FallingEdge(dut.aclk)
    dut.aresetn.value = 1
    board = Scoreboard()
    patches = list(constrained_random(random.Random(seed), int(os.environ["TESS_RANDOM"])))
    for patch in patches:
        await source.send(AxiStreamFrame(packed(patch).to_bytes(32, "little")))
    for patch in patches:
        await compare(board, patch, sinks)
    for _ in range(64):
        await FallingEdge(dut.aclk)
    assert all(sink.empty() for sink in sinks), "elements that no patch has"
    dut._log.info(", ".join(f"{number} {name}" for name, number in board.checked.items()))
    assert not board.mismatches, "\n".join(map(str, board.mismatches))
    assert not board.due and min(board.checked.values()) > 0, "not everything came"
