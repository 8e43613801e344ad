"""Sequences of calls on several tessellators, from threads and forked children, with refused calls between.

Every result is compared with single patches of the core, and of given arrays also what lies behind the output. Hypothesis
shrinks a sequence that fails and prints it as a program. ``TESS_LONG_SECONDS`` draws sequences for that long.
"""

import hashlib
import os
import sys
import threading
import time
from functools import lru_cache
from typing import Any, Callable, Dict, Iterator, List, Optional, Tuple

import numpy as np
import pytest
from hypothesis import HealthCheck, seed, settings
from hypothesis import strategies as st
from hypothesis.stateful import (
    Bundle, RuleBasedStateMachine, initialize, invariant, rule, run_state_machine_as_test,
)

from child import in_a_child
from tess_model import ArgumentError, Coverage, OutputError, Patch, Tessellator, TessError

Array = Any
Made = Tuple[Tessellator, Dict[str, str]]
Runs = List[Tuple[int, List[int]]]

DOMAINS = {"isoline": (2, 0), "tri": (3, 1), "quad": (4, 2)}
CANARY = 0x7FC0DEAD

floats = st.one_of(st.integers(1, 6).map(float), st.floats(0.25, 9, width=32), st.sampled_from([0.0, 1.0, 33.5, float("nan")]))
bits = st.one_of(floats.map(lambda x: int(np.float32(x).view(np.uint32))), st.integers(0, 2**32 - 1))
rows = st.one_of(bits.map(lambda one: [one] * 6), st.lists(bits, min_size=6, max_size=6))
# With more than a thousand patches several threads count and write.
times = st.one_of(st.integers(1, 3), st.integers(1, 40), st.integers(1025, 1500))
batches = st.one_of(*[st.lists(st.tuples(times, rows), min_size=1, max_size=3)] * 3, st.just([]))
rooms = st.sampled_from(["exact", "larger", "larger", "exact", "short"])
names = st.fixed_dictionaries(
    {
        "partitioning": st.sampled_from(["integer", "pow2", "fractional_odd", "fractional_even"]),
        "output": st.sampled_from(["point", "line", "triangle_cw", "triangle_ccw"]),
        "split": st.sampled_from(["ruler", "center"]),
    }
)
formats = st.fixed_dictionaries(
    {
        "points": st.sampled_from(["float32", "fixed"]),
        "indices": st.sampled_from(["uint32", "uint16"]),
        "base_vertex": st.one_of(st.none(), st.integers(0, 70_000), st.sampled_from([0, 2**32 - 1])),
    }
)
tried = {"sequences": 0, "calls": 0}


@lru_cache(maxsize=4000)
def of_core(domain: str, row: "tuple[int, ...]", config: "tuple[str, str, str]") -> "tuple[Array, Array]":
    """Points in 16.16 and indices of one patch."""
    outer, inner = DOMAINS[domain]
    partitioning, output, split = config
    patch = Patch.from_bits(
        domain, row[:outer], row[outer : outer + inner] or None, partitioning=partitioning, output=output, split=split
    )
    return patch.points, patch.indices.ravel()


class Expected:
    """A batch's output by the core."""

    def __init__(self, domain: str, runs: "Runs", config: "dict[str, str]") -> None:
        count = sum(DOMAINS[domain])
        names = (config["partitioning"], config["output"], config["split"])
        patches, room = [], 150_000
        for number, row in runs:
            one = of_core(domain, tuple(row[:count]), names)
            number = min(number, room // max(len(one[0]), 1))
            room -= number * len(one[0])
            patches += [(row[:count], one)] * number
        self.factors = np.array([row for row, _ in patches], np.uint32).reshape(len(patches), count)
        sizes = np.array([(len(p), len(i)) for _, (p, i) in patches], np.int64).reshape(-1, 2)
        firsts = np.cumsum(sizes, axis=0) - sizes
        self.ranges = np.stack([firsts[:, 0], sizes[:, 0], firsts[:, 1], sizes[:, 1]], axis=1)
        none = np.zeros((0, 2), np.uint32)
        self.points = np.concatenate([none, *(points for _, (points, _) in patches)])
        self.own = np.concatenate([none[:, 0], *(indices for _, (_, indices) in patches)]).astype(np.int64)
        self.through = self.own + np.repeat(firsts[:, 0], sizes[:, 1])

    def indices(self, base_vertex: Optional[int]) -> Array:
        return self.own if base_vertex is None else self.through + base_vertex

    def is_too_large(self, indices: str, base_vertex: Optional[int]) -> bool:
        """Whether the number of a point is no index of the type."""
        last = (base_vertex or 0) + len(self.points) - 1
        return base_vertex is not None and len(self.points) > 0 and last > np.iinfo(indices).max

    def equals(self, batch: Any, base_vertex: Optional[int]) -> None:
        exact = batch.points if batch.points.dtype == np.uint32 else batch.points.astype(np.float64) * 65536
        self.same("range", batch.ranges, self.ranges, np.arange(len(self.ranges)))
        self.same("point", exact, self.points, self.ranges[:, 0])
        self.same("index", batch.indices, self.indices(base_vertex), self.ranges[:, 2])

    def same(self, what: str, observed: Array, expected: Array, firsts: Array) -> None:
        """Names the first element that differs, and its patch by the bits of its factors."""
        assert observed.shape == expected.shape, f"{what}: {observed.shape}, expected {expected.shape}"
        differs = (observed != expected).any(axis=1) if expected.ndim > 1 else observed != expected
        if differs.any():
            at = int(differs.argmax())
            patch = int(np.searchsorted(firsts, at, "right")) - 1
            factors = " ".join(f"{bits:08x}" for bits in self.factors[patch])
            raise AssertionError(
                f"patch {patch} of {len(firsts)} ({factors}), {what} {at - firsts[patch]}: "
                f"observed {observed[at]}, expected {expected[at]}"
            )

    def arrays(self, points: str, indices: str, rooms: "list[str]") -> "list[Array]":
        """Arrays to write, full of canaries."""
        more = {"exact": 0, "larger": 70, "short": -1}
        sizes = [len(self.points), len(self.own), len(self.factors)]
        lengths = [max(size + more[room], 0) for size, room in zip(sizes, rooms)]
        kinds = [(2, "uint32" if points == "fixed" else points), (0, indices), (4, "uint32")]
        made = [np.zeros((n, k) if k else n, kind) for n, (k, kind) in zip(lengths, kinds)]
        for array in made:
            array.view(np.uint16)[...] = CANARY & 0xFFFF
        return made


def digest(batch: Any) -> bytes:
    return hashlib.sha256(b"".join(array.tobytes() for array in batch)).digest()


def failing(patches: "list[Patch]") -> "Iterator[Patch]":
    yield from patches
    raise KeyError("between two patches")


class Calls(RuleBasedStateMachine):
    tessellators = Bundle("tessellators")

    def __init__(self) -> None:
        super().__init__()
        tried["sequences"] += 1
        self.coverage, self.counted = Coverage(), Coverage()

    @initialize(target=tessellators, config=names, threads=st.sampled_from([1, 2]))
    def begin(self, config: "dict[str, str]", threads: int) -> Made:
        return Tessellator(threads=threads, **config), config

    @rule(target=tessellators, config=names, threads=st.sampled_from([1, 2, 2, 3]))
    def make(self, config: "dict[str, str]", threads: int) -> "Made":
        return Tessellator(threads=threads, **config), config

    @rule(made=tessellators, domain=st.sampled_from(sorted(DOMAINS)), runs=batches)
    def count(self, made: "Made", domain: str, runs: "Runs") -> None:
        expected = Expected(domain, runs, made[1])
        counts = made[0].count(domain, expected.factors)
        assert tuple(counts) == (len(expected.factors), len(expected.points), len(expected.own))

    @rule(made=tessellators, domain=st.sampled_from(sorted(DOMAINS)), runs=batches, form=formats)
    def tessellate(self, made: "Made", domain: str, runs: "Runs", form: "dict[str, Any]") -> None:
        self.compare(made, domain, runs, form, "here")

    @rule(
        made=tessellators, domain=st.sampled_from(sorted(DOMAINS)), runs=batches, form=formats,
        where=st.sampled_from(["threads", "threads", "thread"]),
    )
    def tessellate_on_threads(
        self, made: "Made", domain: str, runs: "Runs", form: "dict[str, Any]", where: str
    ) -> None:
        self.compare(made, domain, runs, form, where)

    @rule(
        made=tessellators, domain=st.sampled_from(sorted(DOMAINS)), runs=batches, form=formats,
        where=st.sampled_from(["child", "grandchild"]),
    )
    def tessellate_in_a_child(
        self, made: "Made", domain: str, runs: "Runs", form: "dict[str, Any]", where: str
    ) -> None:
        self.compare(made, domain, runs, form, where)

    def compare(self, made: "Made", domain: str, runs: "Runs", form: "dict[str, Any]", where: str) -> None:
        expected = Expected(domain, runs, made[1])

        def call() -> Any:
            return made[0].tessellate(domain, expected.factors, **form)

        if expected.is_too_large(form["indices"], form["base_vertex"]):
            with pytest.raises(ArgumentError, match="indices end at"):
                call()
        elif where in ("child", "grandchild"):
            told = in_a_child(lambda: digest(call()) if where == "child" else in_a_child(lambda: digest(call())))
            batch = call()
            expected.equals(batch, form["base_vertex"])
            assert told == digest(batch), f"the batch of a {where}"
        elif where == "here":
            expected.equals(call(), form["base_vertex"])
        else:
            results = on_threads(call, 1 if where == "thread" else 3)
            for batch in results:
                expected.equals(batch, form["base_vertex"])

    @rule(
        made=tessellators,
        domain=st.sampled_from(sorted(DOMAINS)),
        runs=batches,
        form=formats,
        room=st.lists(rooms, min_size=3, max_size=3),
        has_ranges=st.booleans(),
    )
    def write(
        self,
        made: "Made",
        domain: str,
        runs: "Runs",
        form: "dict[str, Any]",
        room: "list[str]",
        has_ranges: bool,
    ) -> None:
        expected = Expected(domain, runs, made[1])
        out = expected.arrays(form["points"], form["indices"], room)
        before = [array.copy() for array in out]
        given = tuple(out if has_ranges else out[:2])
        sizes = [len(expected.points), len(expected.own), len(expected.factors)]
        is_short = any(len(array) < size for array, size in zip(given, sizes))
        is_too_large = expected.is_too_large(form["indices"], form["base_vertex"])

        def call() -> Any:
            return made[0].tessellate(domain, expected.factors, base_vertex=form["base_vertex"], out=given)

        if is_short or is_too_large:
            with pytest.raises((OutputError,) * is_short + (ArgumentError,) * is_too_large):
                call()
            sizes = [0, 0, 0]
        else:
            batch = call()
            expected.equals(batch, form["base_vertex"])
            assert all(np.shares_memory(one, array) for one, array in zip(batch, given) if one.size)
            sizes = sizes if has_ranges else [*sizes[:2], 0]
        for array, old, size in zip(out, before, sizes):
            np.testing.assert_array_equal(array[size:].view(np.uint16), old[size:].view(np.uint16))

    @rule(
        made=tessellators,
        change=st.sampled_from(
            [
                {"points": "float16"}, {"indices": "int8"}, {"base_vertex": -1}, {"domain": "hexagon"}, {"out": ()},
                {"out": (None, None)}, {"factors": np.zeros((1, 5), np.float32)}, {"factors": "quads"},
            ]
        ),
    )
    def refused(self, made: "Made", change: "dict[str, Any]") -> None:
        arguments: "dict[str, Any]" = {"domain": "quad", "factors": np.full((3, 6), 2, np.float32), **change}
        with pytest.raises(TessError):
            made[0].tessellate(**arguments)

    @rule(row=rows, times=st.integers(0, 3), fails=st.booleans())
    def cover(self, row: "list[int]", times: int, fails: bool) -> None:
        """An exception of the caller's iterator comes out; nothing that waited for it is counted."""
        patch = Patch.from_bits("tri", row[:3], row[3])
        if fails:
            with pytest.raises(KeyError, match="between two patches"):
                self.coverage.record(failing([patch] * times))
        else:
            self.coverage.record([patch] * times)
            for _ in range(times):
                self.counted.record(patch)

    @invariant()
    def coverage_is_counted(self) -> None:
        tried["calls"] += 1
        assert self.coverage == self.counted


def on_threads(call: "Callable[[], Any]", count: int) -> "list[Any]":
    """Results of a call in ``count`` threads that begin together, each a few times."""
    results: "list[Any]" = []
    begin = threading.Barrier(count)

    def work() -> None:
        begin.wait()
        results.extend(call() for _ in range(3))

    threads = [threading.Thread(target=work) for _ in range(count)]
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)  # another thread takes the lock wherever one lets it go
    try:
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    finally:
        sys.setswitchinterval(interval)
    assert len(results) == 3 * count, "a thread raised"
    return results


SHORT = settings(
    max_examples=120, stateful_step_count=20, deadline=None, database=None, derandomize=True,
    suppress_health_check=list(HealthCheck), print_blob=False,
)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="children are forked")
def test_any_sequence_of_calls() -> None:
    long = os.environ.get("TESS_LONG_SECONDS")
    if long is None:
        run_state_machine_as_test(Calls, settings=SHORT)
    end, number = time.monotonic() + float(long or 0), 0
    while time.monotonic() < end:
        number += 1
        run_state_machine_as_test(seed(number)(Calls), settings=settings(SHORT, derandomize=False))
    print(f"{tried['sequences']} sequences, {tried['calls']} calls")
    assert tried["calls"] > 1000
