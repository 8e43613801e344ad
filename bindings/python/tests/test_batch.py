"""Batches of factors in any strides, what they refuse, and threads meanwhile; test_sequences.py compares their output."""

import copy
import os
import pickle
import subprocess
import sys
import threading
import time
from typing import Any

import numpy as np
import pytest

from tess_model import ArgumentError, OutputError, Tessellator, TessError, tessellate


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


@pytest.mark.parametrize("dtype", [np.float32, np.float64, np.uint32])
def test_factors_that_are_not_aligned(dtype: Any) -> None:
    """As numpy.frombuffer takes them from the middle of a buffer."""
    factors = quads().astype(np.float32)
    factors = factors.view(np.uint32) if dtype is np.uint32 else factors.astype(dtype)
    apart = misaligned(factors)
    apart[:] = factors
    assert not apart.flags.aligned
    for one, other in zip(tessellate("quad", apart), tessellate("quad", factors)):
        np.testing.assert_array_equal(one, other)


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


def test_tessellators_are_pickled_and_copied() -> None:
    tessellator = Tessellator("fractional_odd", "triangle_ccw", "center", threads=2)
    expected = tessellator.tessellate("quad", quads())
    copies = [copy.copy(tessellator), copy.deepcopy(tessellator)]
    copies += [pickle.loads(pickle.dumps(tessellator, protocol)) for protocol in range(pickle.HIGHEST_PROTOCOL + 1)]
    for same in copies:
        assert repr(same) == repr(tessellator) and same is not tessellator
        for one, other in zip(same.tessellate("quad", quads()), expected):
            np.testing.assert_array_equal(one, other)


NO_THREADS = """
import sys, numpy, tess_model
from tess_model import TessError, Tessellator
def refused(call):
    try:
        call()
    except TessError as error:
        print(error, file=sys.stderr)
        return type(error) is TessError and "cannot be started" in str(error)
    return False
patch = tess_model.Patch("tri", [3, 4, 5], 6)
assert refused(lambda: Tessellator(threads=2))
assert refused(lambda: tess_model.tessellate("tri", numpy.ones((2, 4), "f4"), threads=2))
assert refused(lambda: tess_model.write_vectors("/dev/null", [patch]))
assert Tessellator().tessellate("tri", numpy.full((2000, 4), 9, "f4")).points.shape[0] > 0
assert tess_model.check_device([(patch, patch.points, patch.indices)]).equal
"""


def test_where_no_thread_can_be_started() -> None:
    """No memory holds a stack of 64 TiB."""
    environment = {**os.environ, "RUST_MIN_STACK": str(1 << 46)}
    run = subprocess.run([sys.executable, "-c", NO_THREADS], env=environment, capture_output=True, text=True)
    assert run.returncode == 0 and "panicked" not in run.stderr, run.stderr
