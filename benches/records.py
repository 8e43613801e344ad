"""Makes the tables of docs/performance.md and docs/study.md, and the charts, from the records of measurements, `records/NAME.json`.

    records.py performance    write tables and charts
    records.py check          check that tables and charts agree with the records

measure.py takes the measurements; fresh.py checks that they are of the present code.
"""

import json
import math
import re
import sys
from pathlib import Path

import study

ROOT = Path(__file__).resolve().parent.parent
RECORDS = ROOT / "benches/records"
RESULTS = ROOT / "docs/performance.md"
EXPERIMENTS = ROOT / "docs/experiments.md"
STUDY = ROOT / "docs/study.md"
CIRCUIT = ROOT / "docs/rtl.md"

# Columns of rows of `tess bench --json`: key, title, and divisor of the values. Rows of a CPU have times instead of the first.
TIME = "ns a patch"
RATES = {
    "patches_per_s": ("M patches/s", 1e6),
    "triangles_per_s": ("G triangles/s", 1e9),
    "bytes_per_s": ("GB/s", 1e9),
    "fill_ratio": ("of fill", 1.0),
    "core_ratio": ("of core", 1.0),
}


def read(name):
    record = json.loads((RECORDS / f"{name}.json").read_text())
    assert record["rows"], f"{name}: no rows"
    return record


def compact(value):
    return json.dumps(value, separators=(",", ":"), ensure_ascii=False, sort_keys=True)


def text_of(record):
    """The text of a record's file: a line for each key and for each row."""
    lines = [f'  "{key}": {compact(value)}' for key, value in record.items() if key != "rows"]
    rows = ",\n".join(f"    {compact(row)}" for row in record["rows"])
    return "{\n" + ",\n".join([*lines, f'  "rows": [\n{rows}\n  ]']) + "\n}\n"


def digits(value):
    """The value with three significant digits, with all digits before the point, without trailing zeros."""
    decimals = next((count for least, count in ((100, 0), (10, 1), (1, 2), (0.1, 3), (0.01, 4)) if value >= least), 5)
    text = f"{value:.{decimals}f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def shown(value):
    return "" if value is None else value if isinstance(value, str) else compact(value)


# Tables


def table(record, targets):
    """The command, the machine and date of the measurement, and the rows."""
    head = "    {command}\n\n{machine}; {date}, commit {commit}.\n\n".format(**record)
    if columns := record.get("columns"):
        titles = [column.replace("_", " ") for column in columns]
        cells = [[shown(row.get(column)) for column in columns] for row in record["rows"]]
    else:
        titles, cells = bench_table(record["rows"], targets)
    return head + "".join(f"| {' | '.join(line)} |\n" for line in [titles, ["---"] * len(titles), *cells])


def bench_table(rows, targets):
    """The titles and cells of rows of `tess bench`. Settings that differ follow the workload; targets are last."""
    rows = [without_fill(row) for row in rows]
    columns = [key for key in RATES if any(row.get(key) is not None for row in rows)]
    is_timed = all(row["backend"] != "gpu" for row in rows)
    titles_of = {key: title for key, (title, _) in RATES.items()} | ({"patches_per_s": TIME} if is_timed else {})
    has_target = any(targets_of(row, targets) for row in rows)
    titles = ["workload", *(titles_of[key] for key in columns), *["target"] * has_target]
    settings = ("working_set", "threads", "index_type", "level")
    varying = [key for key in settings if any(row.get(key) != rows[0].get(key) for row in rows)]

    def cells(row):
        of_settings = (shown(row.get(key)) + " threads" * (key == "threads") for key in varying)
        yield ", ".join([row["workload"], *of_settings])
        for key in columns:
            value = row.get(key)
            is_time = titles_of[key] == TIME
            yield "" if value is None else digits(1e9 / value if is_time else value / RATES[key][1])
        if has_target:
            yield "; ".join(verdict(row, target) for target in targets_of(row, targets))

    return titles, [list(cells(row)) for row in rows]


def without_fill(row):
    """The row; with one patch per call without a comparison with a fill, which takes less time than a call."""
    return {**row, "fill_ratio": None} if row["workload"].startswith("single/") else row


def targets_of(row, targets):
    """The targets of this row; they hold for 32-bit indices on one thread."""
    is_plain = row.get("index_type") != "u16" and row.get("threads", 1) == 1
    keys = ("backend", "workload", "working_set")
    return [target for target in targets if is_plain and all(row.get(key) == target[key] for key in keys)]


def verdict(row, target):
    (title, unit), value = RATES[target["key"]], row.get(target["key"])
    words = "not recorded" if value is None else "reached" if value >= target["at_least"] else "missed"
    return f"{digits(target['at_least'] / unit)} {title}: {words}"


def with_tables(text, table_of):
    """`text` with a table after each marker `<!-- table: NAME -->`, up to `<!-- end -->`; and the tables' names."""
    used = re.findall(r"<!-- table: (\S+) -->\n", text)
    marked = r"(<!-- table: (\S+) -->\n)(?:(?!<!-- table: ).)*?(?=<!-- end -->)"
    text, count = re.subn(marked, lambda found: found[1] + table_of(found[2]), text, flags=re.DOTALL)
    assert count == len(used), f"a table of {used} has no `<!-- end -->`"
    return text, used


# Charts

# Colours of the series, which are distinct in any order, also for colour-blind readers and in grey.
COLOURS = ["#4477aa", "#ee8866", "#44aa77", "#aa3377", "#999999"]
# Lengths in pixels. LEFT has room for the labels; the value of the longest bar is to its right.
LEFT, LONGEST, WIDTH, BAR, GAP, HEAD = 180, 500, 760, 13, 9, 62


def card_of(name):
    """The GPU that a record was measured on, as its machine names it: `NVIDIA H100` of `NVIDIA H100 80GB HBM3, driver ...`."""
    return " ".join(read(name)["machine"].split(",")[0].split()[:2])


def charts():
    """The file, title, scale and series of each chart, and for each label the values of the series; None if missing."""
    cpu = {row["workload"]: row for row in read("simd")["rows"]}
    gpu = {row["workload"]: row for row in read("gpu")["rows"]}
    of_both = lambda key: {name: [cpu[name].get(key), gpu.get(name, {}).get(key)] for name in cpu}
    series = ["CPU: tess-simd, one thread, AVX-512, cache", f"GPU: tess-gpu, {card_of('gpu')}, stream"]
    title = "Speed of writing the output, as a fraction of a fill of as many bytes"
    yield "fill", title, False, series, of_both("fill_ratio")
    yield "core", "Patches per second, as a multiple of the model's on one thread", True, series, of_both("core_ratio")

    keys = ["stage_drawn", "compute_drawn", "in_vertex_cache_order_drawn"]
    bars = {row["workload"]: [float(row[key]) for key in keys] for row in read("drawn")["rows"]}
    title = f"Factors to pixels on an {card_of('drawn')}, billions of triangles per second"
    yield "drawn", title, False, ["fixed-function stage", "compute", "compute, vertex-cache order"], bars

    bars = {}
    for row in read("stage")["rows"]:
        bars.setdefault(f"{digits(row['triangles'] / 1e6)} M triangles", []).append(row["G_triangles/s"])
    title = f"Terrain by the stage of tess-wgpu on an {card_of('stage')}, billions of triangles per second"
    yield "pixels", title, False, ["points stored", "points pulled", "pulled without indices"], bars

    title = "The study's inputs: nanoseconds per patch"
    yield "study", title, True, *study.chart(read("study-cpu"), read("study-gpu"))


def svg(title, is_logarithmic, series, bars):
    """The picture of a chart; logarithmic bars begin at 1."""
    for number, name in enumerate(series):
        assert any(values[number] is not None for values in bars.values()), f"no record has a value of `{name}`"
    most = max(value for values in bars.values() for value in values if value is not None)
    row = len(series) * BAR + GAP
    height = HEAD + len(bars) * row + GAP

    def line(x, y, anchor, text):
        return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{text}</text>'

    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" font-family="sans-serif" font-size="12">',
        "<!-- Written by `cargo xtask performance` from benches/records. Do not edit. -->",
        f'<rect width="{WIDTH}" height="{height}" fill="#ffffff"/>',
        f'<text x="12" y="22" font-size="14" font-weight="bold">{title}</text>',
    ]
    x = 12
    for name, colour in zip(series, COLOURS):
        left = str(x).removesuffix(".0")
        lines += [f'<rect x="{left}" y="36" width="11" height="11" fill="{colour}"/>', line(x + 16, 46, "start", name)]
        x += 36.0 + 6.6 * len(name)
    if is_logarithmic:
        lines.append(line(WIDTH - 12, 46, "end", "logarithmic"))
    for number, (label, values) in enumerate(bars.items()):
        top = HEAD + number * row
        lines.append(line(LEFT - 8, top + len(series) * BAR / 2 + 4, "end", label))
        for own, (value, colour) in enumerate(zip(values, COLOURS)):
            if value is None:
                continue
            length = LONGEST * (math.log(max(value, 1)) / math.log(most) if is_logarithmic else value / most)
            y = top + own * BAR
            lines.append(f'<rect x="{LEFT}" y="{y}" width="{length:.1f}" height="{BAR - 1}" fill="{colour}"/>')
            lines.append(line(LEFT + length + 5, y + 10.5, "start", digits(value)))
    return "\n".join([*lines, "</svg>\n"])


# Commands


def made():
    """The text of every document and chart, made from the records."""
    targets = json.loads((ROOT / "benches/targets.json").read_text())
    assert all(target["key"] in RATES for target in targets), "targets.json: a key that no row has"
    text, used = with_tables(RESULTS.read_text(), lambda name: table(read(name), targets))
    of_study = study.tables(read, CIRCUIT.read_text())
    studied, used_there = with_tables(STUDY.read_text(), of_study.__getitem__)
    assert set(used_there) == of_study.keys(), f"{STUDY} has the tables {used_there}, not {sorted(of_study)}"
    used += used_there
    files, experiments = {RESULTS: text, STUDY: studied}, EXPERIMENTS.read_text()
    for name in sorted(path.stem for path in RECORDS.glob("*.json")):
        is_named = name in used or f"](../benches/records/{name}.json)" in experiments
        assert is_named, f"{RESULTS} and {STUDY} have no table of {name}, {EXPERIMENTS} no link to it"
    for name, *chart in charts():
        assert f"](images/{name}.svg)" in text + studied, f"neither {RESULTS} nor {STUDY} shows the chart {name}"
        files[ROOT / f"docs/images/{name}.svg"] = svg(*chart)
    return files


def performance():
    for path, text in made().items():
        if not path.exists() or path.read_text() != text:
            path.write_text(text)
            print(f"{path} is new")


def check():
    """Checks that documents and charts agree with the records."""
    for path in RECORDS.glob("*.json"):
        assert path.read_text() == text_of(json.loads(path.read_text())), f"{path}: another layout"
    for path, text in made().items():
        assert path.read_text() == text, f"{path}: cargo xtask performance"


if __name__ == "__main__":
    commands = {"performance": performance, "check": check}
    if len(sys.argv) != 2 or sys.argv[1] not in commands:
        sys.exit(__doc__)
    commands[sys.argv[1]]()
