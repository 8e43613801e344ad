"""Plants faults of `circuit.faults` in a copy of the design, which has none of its own.

    python3 plant.py FOLDER              every fault, behind a switch: `+fault=N` of a simulation plants the Nth of the list
    python3 plant.py FOLDER --fault N    the Nth alone; 0 none
    python3 plant.py --list              number, kind, module, who sees it, name: a line each, between tabs

The list has the form of the project's other lists of faults: `in FILE` and `seen by WHO` hold until they are said again,
`kind WORD` too; then `fault NAME := TEXT ==> WRONG TEXT`, or for several lines `fault NAME`, `<<<`, the text, `===`, the wrong
text, `>>>`. The text stands in its file once. It is an
expression, `assign` with one (declarations may stand before a wrong one), or whole statements of a procedure, so that a switch
can choose between it and the wrong one.
"""

import argparse
import re
from pathlib import Path
from typing import NamedTuple

DV = Path(__file__).resolve().parent
RTL = DV.parent
SWITCH = """// Which fault is planted: +fault=N, 0 none.
package tess_fault_pkg;
    function automatic int chosen();
        chosen = 0;
        void'($value$plusargs("fault=%d", chosen));
    endfunction
    int number = chosen();
endpackage
"""


class Fault(NamedTuple):
    """One change of a source file."""

    number: int
    file: str
    kind: str
    seen_by: str
    name: str
    right: str
    wrong: str

    def place(self, text: str) -> int:
        """Where the text of the file has it."""
        assert text.count(self.right) == 1, f"{self.file} has `{self.right}` {text.count(self.right)} times"
        return text.index(self.right)


def faults(file: Path = DV / "circuit.faults") -> "list[Fault]":
    """The list."""
    found: "list[Fault]" = []
    said: "dict[str, str]" = {}
    lines = iter(file.read_text().splitlines())
    for line in lines:
        word = next((word for word in ("in ", "seen by ", "kind ", "fault ") if line.startswith(word)), "")
        if word == "fault ":
            name, is_line, change = line[6:].partition(" := ")
            if is_line:
                right, arrow, wrong = change.partition(" ==>")
                assert arrow, f"{line}: no ` ==> `"
            else:
                assert next(lines) == "<<<", f"{line}: `<<<` follows"
                right, wrong = "\n".join(iter(lambda: next(lines), ">>>")).split("\n===", 1)
            wrong = wrong.removeprefix(" ").lstrip("\n")
            found.append(Fault(len(found) + 1, said["in "], said["kind "], said["seen by "], name, right, wrong))
        elif word:
            said[word] = line[len(word) :]
        else:
            assert not line or line.startswith("#"), f"{file.name}: `{line}`"
    return found


def chosen(right: str, others: "list[tuple[int, str]]") -> str:
    """The text, or one of the others by number."""
    if not right.rstrip().endswith(";"):
        return "(" + "".join(f"tess_fault_pkg::number == {n} ? ({wrong}) : " for n, wrong in others) + f"({right}))"
    head = re.match(r"\s*assign [^=]*= ", right)
    if head is None:
        tests = "".join(f"if (tess_fault_pkg::number == {n}) begin {wrong} end else " for n, wrong in others)
        return f"{tests}begin {right} end"
    # What stands before a wrong `assign` declares what it needs.
    parts = [(number, *wrong.rpartition(head[0].lstrip())) for number, wrong in others]
    assert all(found for _, _, found, _ in parts), f"other signals than {head[0]}"
    values = chosen(right[head.end() : -1], [(number, value[:-1]) for number, _, _, value in parts])
    return "".join(before for _, before, _, _ in parts) + head[0] + values + ";"


def switched(text: str, planted: "list[Fault]") -> str:
    """The text with all these faults behind switches; a fault's text may lie within another's."""
    places: "dict[tuple[int, int], list[Fault]]" = {}
    for fault in planted:
        start = fault.place(text)
        places.setdefault((start, -start - len(fault.right)), []).append(fault)
    made, at = "", 0
    for (start, end), here in sorted(places.items()):
        if start >= at:
            made += text[at:start]
            at = -end
            within = [f for (a, b), fs in places.items() if (a, b) > (start, end) and -b <= at for f in fs]
            made += chosen(switched(text[start:at], within), [(fault.number, fault.wrong) for fault in here])
        else:
            assert -end <= at, f"{here[0].name}: overlaps another fault"
    return made + text[at:]


def copy(folder: Path, number: "int | None") -> None:
    """Writes the design with one fault, or with all behind switches."""
    folder.mkdir(parents=True, exist_ok=True)
    files = {file.name: file.read_text() for file in RTL.glob("tess*.*") if file.suffix in (".sv", ".svh", ".f")}
    for name, text in files.items():
        here = [fault for fault in faults() if fault.file == name and number in (None, fault.number)]
        if number is None:
            text = switched(text, here)
        elif here:
            assert here[0].place(text) >= 0
            text = text.replace(here[0].right, here[0].wrong)
        if name == "tess.f" and number is None:
            text = text.replace("\ntess_pkg.sv", "\ntess_fault_pkg.sv\ntess_pkg.sv")
        if not (folder / name).exists() or (folder / name).read_text() != text:
            (folder / name).write_text(text)
    if number is None:
        (folder / "tess_fault_pkg.sv").write_text(SWITCH)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, nargs="?")
    parser.add_argument("--fault", type=int)
    parser.add_argument("--list", action="store_true")
    options = parser.parse_args()
    if options.folder:
        copy(options.folder, options.fault)
    if options.list:
        for fault in faults():
            print(fault.number, fault.kind, Path(fault.file).stem, fault.seen_by, fault.name, sep="\t")
