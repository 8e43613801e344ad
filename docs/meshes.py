#!/usr/bin/env python3
"""Writes the inputs of the section "Meshes" of performance.md: million.obj and million.bpt."""

import math

SIDE = 1000


def height(i, j, a, b, scale):
    return scale * math.sin(i * a) * math.cos(j * b)


def write_obj(path):
    """A hilly grid of quads."""
    row = SIDE + 1
    with open(path, "w", encoding="ascii") as out:
        for j in range(row):
            for i in range(row):
                z = height(i, j, 0.31, 0.17, 0.02)
                out.write(f"v {i * 0.01:.6g} {j * 0.01:.6g} {z:.6g}\n")
        for j in range(SIDE):
            for k in range(j * row + 1, j * row + SIDE + 1):
                out.write(f"f {k} {k + 1} {k + row + 1} {k + row}\n")


def write_bpt(path):
    """As many bicubic patches, whose control points are a grid three times as fine."""
    with open(path, "w", encoding="ascii") as out:
        out.write(f"{SIDE * SIDE}\n")
        for b in range(SIDE):
            for a in range(SIDE):
                out.write("3 3\n")
                for j in range(3 * b, 3 * b + 4):
                    for i in range(3 * a, 3 * a + 4):
                        z = height(i, j, 0.11, 0.07, 0.03)
                        out.write(f"{i * 0.01:.6g} {j * 0.01:.6g} {z:.6g}\n")


write_obj("million.obj")
write_bpt("million.bpt")
