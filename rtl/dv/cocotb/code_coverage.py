"""Judges code coverage: everything that was not reached according to Verilator must be named in a list, with its reason.

A line of the list is `MODULE: WHAT # reason`. WHAT is the name that `read` gives a point: for toggles `toggle SIGNAL`, with bits
as in `toggle data[15:13]`; for lines `if`, `else`, `elsif`, `case` or `block` and the text of the source line. The list is wrong
if it names a point that was reached or does not exist, or if it lacks a hole. Instances of a module count together.
"""

import re
from collections import defaultdict
from pathlib import Path
from typing import Iterator, NamedTuple

SHOWN = 60
"""The number of errors that are printed."""


class Point(NamedTuple):
    """Something that a run may reach."""

    module: str
    what: str


def read(file: Path) -> "dict[Point, int]":
    """The number of times that each point was reached, from the file that Verilator wrote."""
    hits: "dict[Point, int]" = defaultdict(int)
    sources: "dict[str, list[str]]" = {}
    for line in file.read_text().splitlines():
        found = re.fullmatch(r"C '(.*)' (\d+)", line)
        if found is None:
            continue
        fields = dict(part.split("\x02", 1) for part in found[1].split("\x01") if part)
        kind, module = fields["page"].split("/")
        module = module.split("__")[0]  # Verilator appends the parameters
        what = f"toggle {fields['o']}"
        if kind != "v_toggle":
            source = sources.setdefault(fields["f"], Path(fields["f"]).read_text().splitlines())
            what = f"{fields['o']} {source[int(fields['l']) - 1].split('//')[0].strip()}"
        hits[Point(module, what)] += int(found[2])
    return dict(hits)


def bits(what: str) -> "Iterator[str]":
    """The name of each bit of `data[15:13]`; other names unchanged."""
    found = re.fullmatch(r"(toggle .*)\[(\d+):(\d+)\]", what)
    if found is None:
        yield what
    else:
        yield from (f"{found[1]}[{bit}]" for bit in range(int(found[3]), int(found[2]) + 1))


def named(file: Path) -> "tuple[set[Point], list[str]]":
    """The holes that a list names, and its malformed lines."""
    holes: "set[Point]" = set()
    wrong = []
    for number, line in enumerate(file.read_text().splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        found = re.fullmatch(r"(\w+): (.*?) +# +(.*\S.*)", line)
        if found is None:
            wrong.append(f"{file.name}:{number}: not `MODULE: WHAT # reason`: {line}")
        else:
            holes.update(Point(found[1], what) for what in bits(found[2]))
    return holes, wrong


def judge(data: Path, names: Path) -> bool:
    """Prints the coverage of each module; returns whether the holes are exactly the named ones."""
    hits = read(data)
    holes, wrong = named(names)
    for module in sorted({point.module for point in hits}):
        counts = []
        for kind in ("line", "toggle"):
            points = [p for p in hits if p.module == module and p.what.startswith("toggle ") == (kind == "toggle")]
            reached = sum(hits[point] > 0 for point in points)
            counts.append(f"{reached:4} of {len(points):4} {kind}s, {sum(p in holes for p in points):3} named holes")
        print(f"{module:20} {counts[0]}; {counts[1]}")
    missed = {point for point, number in hits.items() if number == 0}
    wrong += [f"not reached, without a name: {p.module}: {p.what}" for p in sorted(missed - holes)]
    wrong += [f"named, but reached: {p.module}: {p.what}" for p in sorted(holes & set(hits) - missed)]
    wrong += [f"named, but not there: {p.module}: {p.what}" for p in sorted(holes - set(hits))]
    print("\n".join(wrong[:SHOWN]) or f"every hole has its name: {len(holes)}")
    return not wrong
