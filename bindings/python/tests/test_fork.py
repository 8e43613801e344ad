"""Batches on several threads in forked children, as ``multiprocessing`` makes them on Linux."""

import multiprocessing
import os

import numpy as np
import pytest

from child import in_a_child
from tess_model import Tessellator, tessellate
from test_sequences import digest

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="children are forked")

# More patches and output than one thread takes.
FACTORS = np.random.default_rng(1).uniform(0.5, 9, (3000, 6)).astype(np.float32)
PATIENCE = 30


def output(tessellator: Tessellator) -> bytes:
    return digest(tessellator.tessellate("quad", FACTORS, points="fixed"))


def of_a_process(threads: int) -> bytes:
    return output(Tessellator(threads=threads))


def test_children_after_threads_have_run() -> None:
    tessellator = Tessellator(threads=2)
    expected = output(tessellator)
    assert expected == of_a_process(1)
    assert in_a_child(lambda: output(tessellator), PATIENCE) == expected, "a tessellator of the parent"
    assert in_a_child(lambda: of_a_process(2), PATIENCE) == expected, "one of the child"
    assert in_a_child(lambda: of_a_process(3) and output(tessellator), PATIENCE) == expected, "both"
    told = in_a_child(lambda: output(tessellator) and in_a_child(lambda: output(tessellator), PATIENCE), 2 * PATIENCE)
    assert told == expected, "a child of the child"
    assert output(tessellator) == expected, "the parent goes on"


def test_pools_of_processes() -> None:
    expected = of_a_process(2)
    with multiprocessing.get_context("fork").Pool(2) as pool:
        found = pool.map_async(of_a_process, [2, 1, 2, 3]).get(timeout=2 * PATIENCE)
    assert found == [expected] * 4


def test_the_kept_tessellator_of_the_module() -> None:
    expected = digest(tessellate("quad", FACTORS, threads=2))
    assert in_a_child(lambda: digest(tessellate("quad", FACTORS, threads=2)), PATIENCE) == expected


def test_a_child_before_any_thread() -> None:
    """In a new interpreter: the child is the first to use threads, and its parent comes after it."""
    context = multiprocessing.get_context("spawn")
    with context.Pool(1) as pool:
        assert pool.apply_async(child_first).get(timeout=4 * PATIENCE)


def child_first() -> bool:
    made_before = Tessellator(threads=2)
    told = [in_a_child(lambda: output(made_before), PATIENCE), in_a_child(lambda: of_a_process(2), PATIENCE)]
    return told == [output(made_before)] * 2
