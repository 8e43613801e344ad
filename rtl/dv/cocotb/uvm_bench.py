"""The bench of tess_axis as a pyuvm test: monitors with analysis ports, and `tess_model.Scoreboard` as a component.

`TessScoreboard` is the part to copy. It has an analysis export for each method of the scoreboard: what a monitor writes to
`accept` is a patch, to the others the method's arguments.
"""

import os
import random
from typing import Any

import cocotb
import pyuvm
from cocotb.triggers import FallingEdge
from pyuvm import uvm_analysis_port, uvm_component, uvm_env, uvm_subscriber, uvm_test

from tess_model import Patch, Scoreboard
from top_bench import PATIENCE, Bench, constrained_random


class TessScoreboard(uvm_component):
    def build_phase(self) -> None:
        self.board, self.exports = Scoreboard(), {}
        for name in ("accept", "counts", "point", "primitive"):
            take = getattr(self.board, name)
            self.exports[name] = uvm_subscriber.uvm_AnalysisImp(name, self, lambda given, take=take: take(*given))

    def check_phase(self) -> None:
        assert not self.board.mismatches, str(self.board.mismatches[0])
        assert not self.board.due and min(self.board.checked.values()) > 0, list(self.board.missing())


class Monitors(uvm_component):
    """Writes what passes the ports to an analysis port for each stream. It stands in for the scoreboard of `Bench`."""

    def build_phase(self) -> None:
        self.ports = {name: uvm_analysis_port(name, self) for name in ("accept", "counts", "point", "primitive")}

    def accept(self, patch: Patch) -> None:
        self.ports["accept"].write((patch,))

    def counts(self, points: int, primitives: int) -> None:
        self.ports["counts"].write((points, primitives))

    def point(self, u: int, v: int, last: bool) -> None:
        self.ports["point"].write((u, v, last))

    def primitive(self, indices: "list[int]", last: bool, size: int) -> None:
        self.ports["primitive"].write((indices, last, size))

    def reset(self) -> None:
        """Nothing is under way before the first patch, and nothing resets later."""


class Environment(uvm_env):
    def build_phase(self) -> None:
        self.monitors = Monitors("monitors", self)
        self.scoreboard = TessScoreboard("scoreboard", self)

    def connect_phase(self) -> None:
        for name, port in self.monitors.ports.items():
            port.connect(self.scoreboard.exports[name])


@pyuvm.test()
class RandomPatches(uvm_test):
    """Random patches under gaps and back-pressure."""

    def build_phase(self) -> None:
        self.environment = Environment("environment", self)

    async def run_phase(self) -> None:
        self.raise_objection()
        source = random.Random(int(os.environ["TESS_SEED"]))
        board = self.environment.scoreboard.board
        bench: Any = Bench(cocotb.top, source)
        bench.board = self.environment.monitors
        await bench.start()
        for patch in constrained_random(source, int(os.environ["TESS_RANDOM"])):
            await bench.send(patch)
        for _ in range(PATIENCE):
            if board.due:
                await FallingEdge(cocotb.top.aclk)
        tally = ", ".join(f"{number} {name}" for name, number in board.checked.items())
        cocotb.top._log.info(f"{tally}, {board.wrong} mismatches")
        self.drop_objection()
