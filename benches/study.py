"""The tables and the chart of docs/study.md: what the study of 2015 measured, beside the records `study-*`."""

import re

# Its inputs: their names here and there, and the milliseconds that it took on its CPU and on its GPU.
INPUTS = {
    "seed-table/quad-16": ("16^6", 0.00718, 0.31857),
    "seed-table/quad-32": ("32^6", 0.02932, 0.76839),
    "seed-table/quad-48": ("48^6", 0.06026, 1.47739),
    "seed-table/quad-64": ("64^6", 0.11265, 2.36981),
    "seed-table/quad-32-16-8-6-4-2": ("32 16 8 6 4 2", 0.00156, 0.13351),
    "seed-table/quad-64-15-23-14-13-46": ("64 15 23 14 13 46", 0.01564, 0.46012),
}
ISOLINES = "seed-table/isolines"

# Keys of the records' rows, with their titles and the unit in microseconds.
CPU = {"call_ns": ("one call", 1e-3), "batch_ns": ("one of 4096", 1e-3), "model_ns": ("the model", 1e-3)}
GPU = {
    "device_us": ("dispatch to end", 1.0),
    "host_us": ("with the host", 1.0),
    "frame_us": ("inside a frame", 1.0),
    "batch_ns": ("one of 4096", 1e-3),
}


def digits(value):
    """Three significant digits, and all before the point, without an exponent."""
    decimals = next((count for count in range(9) if value >= 10.0 ** (2 - count)), 8)
    return f"{value:.{decimals}f}"


def rows_of(record):
    return {row["workload"]: row for row in record["rows"]}


def card_of(record):
    """The GPU of a record's machine: `NVIDIA H200` of `NVIDIA H200, driver ...`."""
    return " ".join(record["machine"].split(",")[0].split()[:2])


def table(titles, rows):
    return "".join(f"| {' | '.join(line)} |\n" for line in [titles, ["---"] * len(titles), *rows])


def quotients(record, own, key, unit):
    """How many times as fast ours is as the study's, for each input: `own` is 0 for its CPU, 1 for its GPU."""
    rows = rows_of(record)
    return [theirs[own] * 1e3 / (rows[name][key] * unit) for name, (_, *theirs) in INPUTS.items()]


def inputs(record, own, keys):
    """The six inputs in microseconds: the study's, ours, and the quotient with the first of ours."""
    rows, first = rows_of(record), next(iter(keys))
    titles = ["input", "triangles", "the study, us", *(f"{title}, us" for title, _ in keys.values()), "times as fast"]
    cells = []
    for (name, (title, *theirs)), quotient in zip(INPUTS.items(), quotients(record, own, first, keys[first][1])):
        times = [digits(rows[name][key] * unit) for key, (_, unit) in keys.items()]
        cells.append([title, str(rows[name]["triangles"]), f"{theirs[own] * 1e3:.2f}", *times, f"{quotient:.0f}"])
    return table(titles, cells)


def isolines(cpu, gpu):
    """Milliseconds for all 4096 isolines, which the GPU's program measures twice."""
    cpu, gpu = rows_of(cpu)[ISOLINES], rows_of(gpu)[ISOLINES]
    rows = [
        ("the model, one by one", digits(cpu["model_ns"] * 1e-6)),
        ("`tess-simd`, one thread, 4096 calls", digits(cpu["call_ns"] * 1e-6)),
        ("`tess-simd`, one thread, one batch", digits(cpu["batch_ns"] * 1e-6)),
        (f"`tess-gpu`, one batch, dispatch to end, first at {gpu['mhz']} MHz", digits(gpu["batch_ns"] * 1e-6)),
        ("the same again", digits(gpu["device_us"] * 1e-3)),
        ("`tess-gpu`, one batch, with the host", digits(gpu["host_us"] * 1e-3)),
    ]
    return table(["all 4096 isolines", "ms"], [["the study, seven ways to divide the work", "tens to hundreds"], *rows])


def sweep(*records):
    """The backends that were compared; a row of the file is a hundred patches."""
    names = {"core": "the model", "simd": "`tess-simd`", "gpu": "`tess-gpu`"}
    rows = [[names[row["backend"]], str(row["rows"]), str(row["mismatches"])] for record in records for row in record["rows"]]
    return table(["output of", "rows compared", "rows that differ"], rows)


LARGEST = "seed-table/quad-64"


def circuit_pace(circuit):
    """Triangles per clock of the circuit, from the text of docs/rtl.md."""
    (per_clock,) = re.findall(r"^\| `uniform-64` \|(?: [^|]+\|){5} ([\d.]+) \|", circuit, re.MULTILINE)
    return per_clock


def clocks(cpu, gpu, batches, drawn, circuit):
    """Triangles per second and per clock. `circuit` is the text of docs/rtl.md."""
    on_cpu, on_gpu = rows_of(cpu)[LARGEST], rows_of(gpu)[LARGEST]
    title, *theirs = INPUTS[LARGEST]
    shaders = max(batches["rows"], key=lambda row: row["triangles_per_s"])
    stage = max(drawn["rows"], key=lambda row: row["stage_alone"])
    per_clock = circuit_pace(circuit)
    (at,) = re.findall(r"^\| clock with seeds 1, 2, 3 \|.*\| ([\d.]+), [\d.]+, [\d.]+ MHz \|$", circuit, re.MULTILINE)

    def row(name, rate, clock, of):
        """`rate` in billions of triangles per second, `clock` in GHz."""
        return [name, digits(rate * 1e3), f"{clock:.2f} GHz, {of}", digits(rate / clock)]

    calls = {"call_ns": "`tess-simd`, one call", "batch_ns": "`tess-simd`, one of 4096", "model_ns": "the model"}
    busy = on_gpu["mhz"] * 1e-3
    of_gpu = lambda record: "read from its driver" if card_of(record) == card_of(gpu) else f"as the {card_of(gpu)}"
    rows = [
        *([f"the study, {where}, {title}", digits(on_cpu["triangles"] / ms * 1e-3), "", ""] for where, ms in zip(["CPU", "GPU"], theirs)),
        *(row(f"{name}, {title}, one thread", on_cpu["triangles"] / on_cpu[key], on_cpu["ghz"], "measured") for key, name in calls.items()),
        row(f"compute shaders on an {card_of(gpu)}, {title}, one of 4096", on_gpu["triangles"] / on_gpu["batch_ns"], busy, of_gpu(gpu)),
        row(f"compute shaders on an {card_of(batches)}, `{shaders['workload']}`", shaders["triangles_per_s"] * 1e-9, busy, of_gpu(batches)),
        row(f"fixed-function stage of an {card_of(drawn)}, `{stage['workload']}`", stage["stage_alone"], busy, of_gpu(drawn)),
        ["[our circuit](rtl.md#what-it-reaches), `uniform-64`", digits(float(at) * float(per_clock)), f"{float(at):.0f} MHz on an ECP5", per_clock],
        ["the circuit of [Chung et al.](https://doi.org/10.1109/CICC.2008.4672098), 2008; vertices, not triangles", "120", "100 MHz", "1.2"],
    ]
    return table(["", "million triangles/s", "clock", "triangles per clock"], rows)


def span(values, form="{:.0f}"):
    """The least and the largest of some values: `14 to 35`."""
    return f"{form.format(min(values))} to {form.format(max(values))}"


def answers(cpu, gpu, swept, drawn, circuit_per_clock):
    """The study's questions, each with the number that answers it."""
    compared = [row for record in swept for row in record["rows"]]
    rows, differ = (sum(row[key] for row in compared) for key in ("rows", "mismatches"))
    lines = rows_of(gpu)[ISOLINES]["host_us"] * 1e-3
    frame = [100 * row["in_vertex_cache_order_drawn"] / row["in_vertex_cache_order_alone"] for row in drawn["rows"]]
    drawing = [row["in_vertex_cache_order_drawn"] / row["stage_drawn"] for row in drawn["rows"]]
    alone = [row["in_vertex_cache_order_alone"] / row["stage_alone"] for row in drawn["rows"]]
    per_clock = rows_of(gpu)[LARGEST]["triangles"] / rows_of(gpu)[LARGEST]["batch_ns"] / rows_of(gpu)[LARGEST]["mhz"] * 1e3
    return table(
        ["question", "answer"],
        [
            ["Are the bits the reference's?", f"{differ} of {rows} [rows of its sweep](#its-sweep-bit-for-bit) differ"],
            ["How fast is one thread of a CPU?", f"one call is {span(quotients(cpu, 0, 'call_ns', 1e-3))} times as fast as [the study's](#its-six-inputs)"],
            [
                "How fast is a GPU?",
                f"one patch is {span(quotients(gpu, 1, 'device_us', 1.0))} times as fast as the study's; one of 4096, "
                f"{span([times * 1e-3 for times in quotients(gpu, 1, 'batch_ns', 1e-3)])} thousand times",
            ],
            ["How long do all isolines take?", f"{digits(lines)} ms [with the host](#every-integer-isoline), instead of tens to hundreds"],
            ["How many triangles per clock?", f"{per_clock:.0f} [by compute shaders](#triangles-per-clock), {circuit_per_clock} by our circuit"],
            [
                "Faster than the hardware?",
                f"making triangles, {span(alone)} times as fast; with drawing, {span(drawing, '{:.2f}')} times, "
                "and [the hardware wins](#where-the-hardware-wins) where that is below 1",
            ],
            ["How much of the GPU is tied up?", f"{span(frame, '{:.1f}')} % of a frame that draws its triangles"],
        ],
    )


def tables(read, circuit):
    """The text of each table of the page, by its name."""
    head = "    {command}\n\n{machine}; {date}, commit {commit}.\n\n".format
    cpu, gpu, swept, swept_gpu = map(read, ("study-cpu", "study-gpu", "study-sweep", "study-sweep-gpu"))
    return {
        "study-answers": answers(cpu, gpu, [swept, swept_gpu], read("drawn"), circuit_pace(circuit)),
        "study-cpu": head(**cpu) + inputs(cpu, 0, CPU),
        "study-gpu": head(**gpu) + inputs(gpu, 1, GPU),
        "study-isolines": isolines(cpu, gpu),
        "study-sweep": head(**swept) + sweep(swept),
        "study-sweep-gpu": head(**swept_gpu) + sweep(swept_gpu),
        "study-clocks": clocks(cpu, gpu, read("gpu"), read("drawn"), circuit),
    }


def chart(cpu, gpu):
    """The series and bars: nanoseconds per patch of each input."""
    series = ["CPU, the study", "CPU, ours", "GPU, the study", "GPU, ours", "GPU, ours, of 4096"]
    cpu, gpu = rows_of(cpu), rows_of(gpu)
    bars = {
        title: [on_cpu * 1e6, cpu[name]["call_ns"], on_gpu * 1e6, gpu[name]["device_us"] * 1e3, gpu[name]["batch_ns"]]
        for name, (title, on_cpu, on_gpu) in INPUTS.items()
    }
    return series, bars
