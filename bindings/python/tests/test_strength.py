"""How strictly a device is judged: what each freedom accepts, and that it is not given unasked."""

import numpy as np

from tess_model import Patch, check_device


def test_denormals_may_be_flushed() -> None:
    # The smallest binary32 number as an outer factor: a device that flushes it culls the patch.
    patch = Patch.from_bits("tri", [1, 0x40400000, 0x40400000], 0x40400000)
    assert patch.kind != "culled"
    culled = [(patch, np.zeros((0, 2), np.uint32), np.zeros(0, np.uint32))]
    assert not check_device(culled).equal
    assert check_device(culled, denormals="flush").equal


def test_a_conversion_may_take_the_other_neighbour() -> None:
    # 29/64 of a unit in the last place beyond a 15.16 number: 0.6 of a unit reaches the next one too.
    def patch(below: int, number: int) -> Patch:
        factor = 3 + number / 2**16 + below / 2**22
        return Patch("isoline", [1, factor], partitioning="fractional_odd", output="line")

    def differ(number: int) -> bool:
        return not np.array_equal(patch(29, number).points, patch(0, number + 1).points)

    number = next(filter(differ, range(1000)))
    asked, given = patch(29, number), patch(0, number + 1)
    answer = [(asked, given.points, given.indices)]
    assert not check_device(answer).equal
    assert check_device(answer, conversion="0.6ulp").equal
    far = patch(0, number + 100)
    assert not check_device([(asked, far.points, far.indices)], conversion="0.6ulp").equal


def test_points_alone() -> None:
    patch = Patch("tri", [3, 4, 5], 6)
    turned = [(patch, patch.points, patch.indices[::-1].copy())]
    assert not check_device(turned).equal
    assert check_device(turned, elements="points").equal
