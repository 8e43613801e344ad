"""Batches: equal to single patches, in every format, into given arrays, from any thread."""

import sys
import threading
import time
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from tess_model import ArgumentError, OutputError, Patch, Tessellator, TessError, tessellate

FACTORS = {"isoline": 2, "tri": 4, "quad": 6}
PARTITIONINGS = ["integer", "pow2", "fractional_odd", "fractional_even"]
OUTPUTS = ["point", "line", "triangle_cw", "triangle_ccw"]

any_bits = st.one_of(
    st.floats(width=32).map(lambda x: int(np.array(x, np.float32).view(np.uint32))),
    st.floats(1, 8, width=32).map(lambda x: int(np.array(x, np.float32).view(np.uint32))),
    st.integers(0, 2**32 - 1),
)


def equals_single_patches(domain: str, bits: "np.ndarray[Any, Any]", batch: Any, **config: str) -> None:
    assert batch.ranges.shape == (len(bits), 4)
    first_point = first_index = 0
    for row, found in zip(bits, batch.ranges):
        outer = FACTORS[domain] - {"isoline": 0, "tri": 1, "quad": 2}[domain]
        patch = Patch.from_bits(domain, row[:outer], row[outer:], **config)
        points, indices = patch.points, patch.indices.ravel()
        assert tuple(found) == (first_point, len(points), first_index, len(indices)), patch.case
        first_point, first_index = first_point + len(points), first_index + len(indices)
        here = batch.points[found[0] : first_point]
        exact = here if here.dtype == np.uint32 else here * 65536
        np.testing.assert_array_equal(exact, points, err_msg=patch.case)
        np.testing.assert_array_equal(batch.indices[found[2] : first_index], indices, err_msg=patch.case)
    assert (len(batch.points), len(batch.indices)) == (first_point, first_index)


@settings(deadline=None, max_examples=60)
@given(data=st.data())
def test_any_bits_in_any_configuration(data: st.DataObject) -> None:
    domain = data.draw(st.sampled_from(sorted(FACTORS)))
    config = {
        "partitioning": data.draw(st.sampled_from(PARTITIONINGS)),
        "output": data.draw(st.sampled_from(OUTPUTS)),
        "split": data.draw(st.sampled_from(["ruler", "center"])),
    }
    shape = (data.draw(st.integers(0, 5)), FACTORS[domain])
    bits = data.draw(arrays.arrays(np.uint32, shape, elements=any_bits))
    batch = tessellate(
        domain,
        bits,
        points=data.draw(st.sampled_from(["float32", "fixed"])),
        indices=data.draw(st.sampled_from(["uint32", "uint16"])),
        threads=data.draw(st.sampled_from([1, 2])),
        **config,  # type: ignore[arg-type]
    )
    equals_single_patches(domain, bits, batch, **config)
    # The bits, whatever numpy does to signalling NaNs when it computes.
    same = tessellate(domain, bits.view(np.float32), **config)  # type: ignore[arg-type]
    np.testing.assert_array_equal(same.ranges, batch.ranges)


def quads(count: int = 50) -> "np.ndarray[Any, Any]":
    return np.random.default_rng(1).uniform(0.5, 9, (count, 6)).astype(np.float32)


def test_any_strides() -> None:
    factors = quads()
    expected = tessellate("quad", factors)
    wide = np.zeros((100, 12), np.float32)
    wide[::2, ::2] = factors
    turned = np.asfortranarray(factors)
    backwards = factors[::-1].copy()[::-1]
    read_only = factors.copy()
    read_only.flags.writeable = False
    for same in (wide[::2, ::2], turned, backwards, read_only):
        for one, other in zip(tessellate("quad", same), expected):
            np.testing.assert_array_equal(one, other)
    assert not np.array_equal(tessellate("quad", factors[::-1]).points, expected.points)


def test_numbering_through_the_batch() -> None:
    factors = quads()
    per_patch, batch = tessellate("quad", factors), tessellate("quad", factors, base_vertex=7)
    for first_point, _, first_index, indices in batch.ranges.astype(int):
        here = slice(first_index, first_index + indices)
        np.testing.assert_array_equal(batch.indices[here], per_patch.indices[here] + first_point + 7)
    from_0 = tessellate("quad", factors, base_vertex=0)
    np.testing.assert_array_equal(from_0.indices + np.uint32(7), batch.indices)
    with pytest.raises(ArgumentError, match="indices end at 65535"):
        tessellate("quad", factors, base_vertex=65535, indices="uint16")


def test_given_arrays_are_written_in_place() -> None:
    factors = quads()
    tessellator = Tessellator()
    counts = tessellator.count("quad", factors)
    expected = tessellator.tessellate("quad", factors, points="fixed", indices="uint16")
    points = np.full((counts.points + 3, 2), 0xDEAD, np.uint32)
    indices = np.full(counts.indices + 5, 0xDEAD, np.uint16)
    ranges = np.full((counts.patches + 1, 4), 0xDEAD, np.uint32)
    for out in [(points, indices), (points, indices, ranges)]:
        batch = tessellator.tessellate("quad", factors, out=out)
        for one, other in zip(batch, expected):
            np.testing.assert_array_equal(one, other)
        assert np.shares_memory(batch.points, points) and np.shares_memory(batch.indices, indices)
    assert np.shares_memory(batch.ranges, ranges) and ranges[-1, 0] == 0xDEAD
    assert (points[counts.points :] == 0xDEAD).all() and (indices[counts.indices :] == 0xDEAD).all()
    exact = (points[: counts.points], indices[: counts.indices], ranges[:-1])
    assert tessellator.tessellate("quad", factors, out=exact).points.base is points


def out_arrays(factors: "np.ndarray[Any, Any]") -> "list[np.ndarray[Any, Any]]":
    counts = Tessellator().count("quad", factors)
    return [
        np.zeros((counts.points, 2), np.float32),
        np.zeros(counts.indices, np.uint32),
        np.zeros((counts.patches, 4), np.uint32),
    ]


def read_only(array: "np.ndarray[Any, Any]") -> "np.ndarray[Any, Any]":
    array.flags.writeable = False
    return array


def misaligned(array: "np.ndarray[Any, Any]") -> Any:
    raw = np.zeros(array.nbytes + 1, np.uint8)[1:]
    return raw.view(array.dtype).reshape(array.shape)


@pytest.mark.parametrize("which", [0, 1, 2])
@pytest.mark.parametrize(
    "change, message",
    [
        (lambda a: a[:-1], "holds|elements"),
        (read_only, "read-only"),
        (lambda a: np.asfortranarray(np.repeat(a, 2, axis=0))[::2], "C-contiguous"),
        (lambda a: a[::-1], "C-contiguous"),
        (lambda a: np.repeat(a, 2, axis=0)[::2], "C-contiguous"),
        (lambda a: a.astype(np.float64), "must be a numpy array of shape"),
        (lambda a: a.astype(np.int32), "must be a numpy array of shape"),
        (lambda a: a.astype(a.dtype.newbyteorder()), "must be a numpy array of shape"),
        (lambda a: a[..., None], "must be a numpy array of shape"),
        (lambda a: list(a), "must be a numpy array of shape"),
        (lambda a: None, "must be a numpy array of shape"),
        (misaligned, "aligned"),
    ],
)
def test_arrays_that_cannot_be_written(which: int, change, message: str) -> None:  # type: ignore[no-untyped-def]
    factors = quads()
    out = out_arrays(factors)
    out[which] = change(out[which])
    with pytest.raises(OutputError, match=message):
        tessellate("quad", factors, out=tuple(out))
    assert all(not np.asarray(array, dtype=object).any() for array in out), "nothing is written"


@pytest.mark.parametrize("pair", [(0, 1), (0, 2), (1, 2)])
def test_arrays_that_share_memory(pair: "tuple[int, int]") -> None:
    factors = quads()
    out = out_arrays(factors)
    memory = bytearray(sum(out[i].nbytes for i in pair))
    one, other = (np.frombuffer(memory, out[i].dtype)[: out[i].size].reshape(out[i].shape) for i in pair)
    out[pair[0]], out[pair[1]] = one, other
    with pytest.raises(OutputError, match="share memory"):
        tessellate("quad", factors, out=tuple(out))
    assert not any(memory), "nothing is written"
    apart = np.frombuffer(memory, np.uint8)
    split = out[pair[0]].nbytes
    out[pair[0]] = apart[:split].view(one.dtype).reshape(one.shape)
    out[pair[1]] = apart[split : split + other.nbytes].view(other.dtype).reshape(other.shape)
    assert len(tessellate("quad", factors, out=tuple(out)).points) > 0, "neighbours are fine"


def test_arrays_backwards_share_nothing_with_what_follows_them() -> None:
    factors = quads()
    points, indices, ranges = out_arrays(factors)
    memory = np.zeros(indices.size + ranges.size, np.uint32)
    backwards = memory[: indices.size][::-1]
    behind = memory[indices.size :].reshape(ranges.shape)
    with pytest.raises(OutputError, match="indices: the array is not C-contiguous"):
        tessellate("quad", factors, out=(points, backwards, behind))
    assert not memory.any(), "nothing is written"


def test_factors_and_output_in_one_memory() -> None:
    factors = quads()
    expected = tessellate("quad", factors)
    points, indices, ranges = out_arrays(factors)
    points.ravel()[: factors.size] = factors.ravel()
    shared = points.ravel()[: factors.size].reshape(factors.shape)
    np.testing.assert_array_equal(tessellate("quad", shared, out=(points, indices, ranges)).points, expected.points)


@pytest.mark.parametrize(
    "factors",
    [
        None, 1.0, "x", [[1] * 6], np.ones(6, np.float32), np.ones((1, 5), np.float32),
        np.ones((1, 6), np.int32), np.ones((1, 6), ">f4"), np.ones((1, 6), object),
        np.ones((1, 1, 6), np.float32), np.ones((0, 0), np.float32), np.float32(1),
        np.zeros((1, 6), [("x", np.float32)]),
    ],
    ids=lambda value: f"{type(value).__name__} {getattr(value, 'dtype', '')} {getattr(value, 'shape', '')}",
)
def test_factors_of_other_types(factors: object) -> None:
    with pytest.raises(ArgumentError, match=r"shape \(patches, 6\) for the domain quad"):
        tessellate("quad", factors)  # type: ignore[arg-type]


def test_other_wrong_arguments() -> None:
    for arguments, message in [
        ({"points": "float64"}, "float32 or fixed"),
        ({"indices": "uint8"}, "uint32 or uint16"),
        ({"out": ()}, "not 0 arrays"),
        ({"partitioning": "even"}, "unknown partitioning"),
        ({"threads": 257}, "1 to 256"),
    ]:
        with pytest.raises(TessError, match=message):
            tessellate("quad", quads(1), **arguments)  # type: ignore[arg-type]


def test_a_batch_that_32_bits_cannot_count() -> None:
    # 2^32 points and more, without the memory for them: strides of zero.
    huge = np.broadcast_to(np.float32(64), (1_100_000, 6))
    with pytest.raises(ArgumentError, match="at most 4294967295"):
        Tessellator().count("quad", huge)


def test_empty_batches() -> None:
    for domain, factors in FACTORS.items():
        batch = tessellate(domain, np.zeros((0, factors), np.float32))
        assert [array.shape for array in batch] == [(0, 2), (0,), (0, 4)]


def test_many_threads_with_one_tessellator() -> None:
    factors = quads(500)
    tessellator = Tessellator("fractional_odd", threads=2)
    expected = tessellator.tessellate("quad", factors)
    wrong: "list[str]" = []

    def work(seed: int) -> None:
        mine = np.roll(factors, seed, axis=0)
        for _ in range(5):
            batch = tessellator.tessellate("quad", mine)
            first = batch.ranges[seed, 0]
            if not np.array_equal(batch.points[first:], expected.points[: len(batch.points) - first]):
                wrong.append(f"thread {seed}")

    threads = [threading.Thread(target=work, args=(seed,)) for seed in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert wrong == []


def test_the_interpreter_goes_on_meanwhile() -> None:
    """Another thread runs while a batch is written: with the lock held, it could not."""
    factors = np.full((200_000, 6), 8, np.float32)
    tessellator = Tessellator()
    counts = tessellator.count("quad", factors)
    out = (np.zeros((counts.points, 2), np.float32), np.zeros(counts.indices, np.uint16))
    running, seen, longest = threading.Event(), 0, 0.0
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1000)  # no thread gives the lock away by itself

    def batch() -> None:
        running.set()
        tessellator.tessellate("quad", factors, out=out)
        running.clear()

    thread = threading.Thread(target=batch)
    try:
        thread.start()
        running.wait()
        began = last = time.perf_counter()
        while running.is_set():
            seen += 1
            if seen % 1000 == 0:
                time.sleep(0)  # gives it away here
            last, before = time.perf_counter(), last
            longest = max(longest, last - before)
    finally:
        sys.setswitchinterval(interval)
    ended = time.perf_counter()
    thread.join()
    longest, whole = max(longest, ended - last), ended - began
    assert longest < whole / 2, f"{seen} rounds; nothing ran for {longest:.3f} of {whole:.3f} s"
