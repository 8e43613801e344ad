"""The golden model of the Direct3D 11 class fixed-function tessellator.

>>> import tess_model
>>> patch = tess_model.Patch("quad", outer=[3, 4, 5, 6], inner=[4, 7])
>>> patch.counts
Counts(points=36, primitives=52, indices=156)
>>> patch.points[0], patch.indices[0]
(array([    0, 65536], dtype=uint32), array([ 0,  1, 18], dtype=uint32))

:class:`Patch` is a single patch, and :func:`tessellate` does many at once. For test vectors,
comparison and coverage see :func:`generate`, :func:`check` and :class:`Coverage`.
"""

from functools import lru_cache as _lru_cache
from typing import Any, Optional

import numpy.typing as _npt

from ._native import *
from .errors import *
from .scoreboard import Scoreboard
from .values import *

# The public names. The imports above import whole modules.
__all__ = [
    "ArgumentError",
    "Batch",
    "BatchCounts",
    "Blend",
    "Cases",
    "Counts",
    "Coverage",
    "Difference",
    "FactorContext",
    "FileFormatError",
    "Group",
    "NoSuchElementError",
    "OutputError",
    "Patch",
    "Placement",
    "PointOrigin",
    "PrimitiveOrigin",
    "ProcessedFactor",
    "Record",
    "Report",
    "RuleExample",
    "RuleRow",
    "RulesReport",
    "Scoreboard",
    "SignalDifference",
    "TessError",
    "Tessellator",
    "VectorFile",
    "__version__",
    "check",
    "check_device",
    "check_rules",
    "context",
    "exclusions",
    "generate",
    "place",
    "process_factor",
    "tessellate",
    "write_vectors",
]

_tessellator = _lru_cache(maxsize=4)(Tessellator)


def tessellate(
    domain: str,
    factors: "_npt.ArrayLike",
    *,
    partitioning: str = "integer",
    output: str = "triangle_cw",
    split: str = "ruler",
    threads: int = 1,
    points: str = "float32",
    indices: str = "uint32",
    base_vertex: Optional[int] = None,
    out: "Optional[tuple[_npt.NDArray[Any], ...]]" = None,
) -> Batch:
    """Tessellates a batch: :meth:`Tessellator.tessellate` with a tessellator that is kept for the
    next call.

    ``factors`` is a float32 array of shape (patches, k), where k is 2 (isoline), 4 (tri) or 6 (quad).

    >>> import numpy as np
    >>> factors = np.full((100, 4), 5.0, dtype=np.float32)
    >>> batch = tessellate("tri", factors)
    >>> batch.points.shape, batch.indices.shape, batch.ranges.shape
    ((2700, 2), (11100,), (100, 4))
    """
    tessellator = _tessellator(partitioning, output, split, threads)
    return tessellator.tessellate(
        domain, factors, points=points, indices=indices, base_vertex=base_vertex, out=out
    )
