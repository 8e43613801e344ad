"""Takes the measurements of benches/records. A set is measured in one call on one machine.

    measure.py here cpu|gpu|study
    measure.py run cpu|gpu|study FOLDER [--programs FOLDER] [--only NAME...]
    measure.py take FOLDER --commit HASH [--machine TEXT]

`here`, which is `cargo xtask records` and `cargo xtask study`, builds the programs, then does `run` and `take`. `run` starts the programs, and
writes their rows to FOLDER/NAME.json and their output to FOLDER/NAME.txt. It needs neither the repository nor a
compiler, so another machine can do it. `take` makes records of the rows, and tables and charts of the records.
"""

import argparse
import datetime
import functools
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Callable, NamedTuple

from records import RECORDS, ROOT, performance, text_of

# The folder of cargo's builds.
TARGET = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))


class Code(NamedTuple):
    """The code that is measured: packages with all packages of the workspace that they depend on, and files of others."""

    packages: list
    files: list

    def paths(self):
        """The paths of the code. Which packages and folders these are is cargo's knowledge."""
        return sorted({*self.files, *(path for name in with_dependencies(self.packages) for path in folders_of(name))})


# The verification kit makes the inputs. Nothing else of it is measured.
KIT = "tess-verify"
CPU = Code(["tess-simd", "tess-workloads"], [])
GPU = Code(["tess-wgpu", "tess-workloads"], [])


@functools.cache
def workspace():
    """The packages of the workspace, by name."""
    words = ["cargo", "metadata", "--no-deps", "--offline", "--format-version", "1"]
    answer = subprocess.run(words, cwd=ROOT, check=True, stdout=subprocess.PIPE).stdout
    return {package["name"]: package for package in json.loads(answer)["packages"]}


def with_dependencies(names):
    """These packages and those of the workspace that they are built with."""
    found, rest = set(), list(names)
    while rest:
        if (name := rest.pop()) not in found | {KIT}:
            found.add(name)
            used = [one for one in workspace()[name]["dependencies"] if one["kind"] != "dev"]
            rest += [one["name"] for one in used if one["name"] in workspace()]
    return found


def folders_of(name):
    """The folders of a package, except those of its tests, benches and examples."""
    package = workspace()[name]
    folder = Path(package["manifest_path"]).parent
    first = lambda target: Path(target["src_path"]).relative_to(folder).parts[0]
    others = {"test", "bench", "example"}
    own = {first(target) for target in package["targets"] if not others & set(target["kind"])}
    apart = {first(target) for target in package["targets"]} - own
    inner = {path.relative_to(folder).parts[0] for path in folder.glob("*/**/Cargo.toml")}
    folders = (path for path in folder.iterdir() if path.is_dir() and path.name not in apart | inner)
    return [str(path.relative_to(ROOT)) for path in folders]

UNLIKE = ["terrain", "character", "mosaic", "mosaic-even"]
ALL = ["uniform", *UNLIKE, "meshes", "worst"]


class Measurement(NamedTuple):
    """Commands of one set. `rows` makes the rows of a record from their output."""

    # It needs a GPU, if its programs do.
    set: str
    code: Code
    commands: list
    rows: Callable
    # The keys of the rows in the order of the table; empty for rows of `tess bench`.
    columns: list = []
    needs_gpu: bool = False


def bench(*arguments, workloads):
    return ["tess", "bench", "--json", *arguments, *(word for name in workloads for word in ("--workload", name))]


def objects(outputs):
    """The rows of commands that print JSON arrays."""
    return [row for output in outputs for row in json.loads(output)]


def simd(*arguments, workloads, samples=21, working_set="cache"):
    options = ["--backend", "simd", *arguments, "--samples", str(samples), "--working-set", working_set]
    return Measurement("cpu", CPU, [bench(*options, workloads=workloads)], objects)


def gpu(*arguments, workloads):
    options = ["--backend", "gpu", *arguments, "--working-set", "stream", "--samples", "5"]
    return Measurement("gpu", GPU, [bench(*options, workloads=workloads)], objects)


THREADS = [1, 2, 4, 8, 16]


def of_threads(outputs):
    """GB/s and the fraction of a fill, a column for each number of threads."""
    rows = {}
    for threads, output in zip(THREADS, outputs):
        for row in json.loads(output):
            cell = f"{row['bytes_per_s'] / 1e9:.1f} / {row['fill_ratio']:.2f}"
            rows.setdefault(row["workload"], {})[str(threads)] = cell
    return [{"workload": name, **cells} for name, cells in rows.items()]


def of_probe(outputs):
    """Billions of triangles per second instead of milliseconds."""
    keys = {
        "stage_alone": "fixed",
        "compute_alone": "compute",
        "in_vertex_cache_order_alone": "ordered",
        "stage_drawn": "fixed_drawn",
        "compute_drawn": "compute_drawn",
        "in_vertex_cache_order_drawn": "ordered_drawn",
    }
    return [
        {
            "workload": row["workload"],
            "triangles": row["triangles"],
            **{key: round(row["triangles"] / row[ms] * 1e-6, 2) for key, ms in keys.items()},
        }
        for row in objects(outputs)
    ]


def ablations(output):
    """For each workload and variant of `gpu ablation`: G triangles/s, and microseconds in total, for points and for triangles."""
    workload, found = None, {}
    for line in output.splitlines()[1:]:
        if head := re.fullmatch(r"(\S+), \d+ triangles", line):
            workload = found.setdefault(head[1], {})
        elif row := re.match(r"(\S.*?) +(\d+\.\d) G/s +(\d+)((?: \w+ \d+)*)", line):
            stages = dict(re.findall(r"(\w+) (\d+)", row[4]))
            points = int(stages["expand_points"])
            workload[row[1]] = (float(row[2]), int(row[3]), points, int(stages["expand_primitives"]))
        else:
            sys.exit(f"gpu ablation: not understood: {line}")
    return found


ONE_THREAD = "one thread a patch"


def of_ablation(outputs):
    """Microseconds of each variant, a column for each workload."""
    found = ablations(outputs[0])
    variants = [name for name in next(iter(found.values())) if name != ONE_THREAD]
    cell = lambda times: "{} / {} / {}".format(*times[1:])
    return [{"shaders": name, **{workload: cell(times[name]) for workload, times in found.items()}} for name in variants]


def of_one_thread(outputs):
    """The shaders compared with those that have one thread per patch."""
    rows = []
    for workload, variants in ablations(outputs[0]).items():
        (ours, *_), (one, *_) = variants["as they are"], variants[ONE_THREAD]
        rows.append({"workload": workload, "G_triangles/s": ours, "one_thread_a_patch": one, "times_as_fast": round(ours / one, 1)})
    return rows


def of_groups(outputs):
    names = {"one batch": "one batch without groups", "one group": "one batch, one group"}
    names |= {"groups": "one batch, 256 groups", "batches": "256 batches"}
    lines = re.findall(r"^(one batch|one group|groups|batches) +([\d.]+)$", outputs[0], re.MULTILINE)
    return [{"meshes": names[name], "microseconds": float(time)} for name, time in lines]


def of_crossover(outputs):
    """Microseconds of the CPU, of the device, and of device and host; a column for each workload."""
    rows, workload = {}, None
    for line in outputs[0].splitlines()[1:]:
        if head := re.match(r"(\S+): patches, microseconds", line):
            workload = head[1]
        else:
            patches, *times = line.split()
            cell = " / ".join(f"{float(time):.1f}" if float(time) < 10 else f"{float(time):.0f}" for time in times)
            rows.setdefault(int(patches), {})[workload] = cell
    return [{"patches": patches, **rows[patches]} for patches in (1, 16, 128, 256, 1024, 4096)]


PASSES = {"1": "one pass", "2": "two passes", "4": "four passes"}


def of_evaluated(outputs):
    """Frames of evaluated points as multiples of those of stored points, at factors 4, 16 and 64; and as attributes."""
    line = r"^ *(\d+) +(4|16|64) +(\d+) +(\d+)(?: +[\d.]+){4} +([\d.]+) +([\d.]+)$"
    rows = {}
    for size, _, octaves, passes, evaluated, attributes in re.findall(line, outputs[0], re.MULTILINE):
        row = rows.setdefault((int(size), int(octaves)), {})
        for key, ratio in ((PASSES[passes], evaluated), (f"{PASSES[passes]}, attributes", attributes)):
            row.setdefault(key, []).append(f"{float(ratio):.2f}")
    cells = lambda row: {key: " / ".join(ratios) for key, ratios in row.items()}
    return [{"bytes": size, "octaves": octaves, **cells(row)} for (size, octaves), row in rows.items()]


def of_stage(outputs):
    lines = re.findall(r"^(stored|pull|none) +(\d+) +(\d+) +(\d+) +([\d.]+)$", outputs[0], re.MULTILINE)
    keys = ["points", "triangles", "prepare_us", "draw_us", "G_triangles/s"]
    return [dict(zip(keys, [points, int(drawn), int(prepare), int(draw), float(rate)])) for points, drawn, prepare, draw, rate in lines]


def of_surface(outputs):
    """Criterion's middle estimate of the throughput, as nanoseconds per vertex and as a multiple of a fill."""
    found = re.findall(r"^surface/(.+?)(?:/(\w+))?\s+time:.*?thrpt: +\[\S+ \S+ (\S+) (\S)elem/s", outputs[0], re.MULTILINE | re.DOTALL)
    scale = {"K": 1e3, "M": 1e6, "G": 1e9}
    times = {(name, level): 1e9 / (float(rate) * scale[unit]) for name, level, rate, unit in found}
    fill = times.pop(("fill", ""))
    order = ["bicubic", "PN triangle", "bicubic, displaced"]
    rows = sorted(times.items(), key=lambda row: order.index(row[0][0]))
    return [{"surface": name, "level": level, "ns a vertex": f"{time:.1f}", "fills": f"{time / fill:.0f}"} for (name, level), time in rows]


def of_first(outputs):
    """Criterion's middle estimate of the time, a column for each level."""
    found = re.findall(r"^first/(.+?)/(\w+)\s+time: +\[\S+ \S+ (\S+) (\S+) ", outputs[0], re.MULTILINE)
    scale = {"ns": 1, "µs": 1e3}
    rows = {}
    for what, level, time, unit in found:
        rows.setdefault(what, {})[level] = f"{float(time) * scale[unit]:.0f}"
    return [{"nanoseconds of": what, **times} for what, times in rows.items()]


def lines_of(outputs):
    """The rows of a program that prints a JSON object a line."""
    return [json.loads(line) for line in outputs[0].splitlines()]


def sweep(*backends, code, needs_gpu=False):
    """Comparisons of the recorded sweep in steps of 0.01, of which a row is a hundred patches."""

    def rows(outputs):
        found = [re.search(r"^(\d+) cases, (\d+) mismatches", output, re.MULTILINE) for output in outputs]
        return [{"backend": name, "rows": int(row[1]), "mismatches": int(row[2])} for name, row in zip(backends, found, strict=True)]

    commands = [["tess", "check", "golden/uniform.csv", "--backend", backend] for backend in backends]
    return Measurement("study", code, commands, rows, needs_gpu=needs_gpu)


EDITS = ["gpu", "ablation", "benches/edits"]
BATCHES = ["uniform", *UNLIKE, "meshes/triangles-at-once", "meshes/quads-at-once", "worst"]
DRAWN = ["uniform", *UNLIKE, "worst"]
FRAMES = ["uniform-16", "terrain", "character"]
WRITTEN = ["benches/src/lib.rs", "benches/src/written.rs"]


def files_of_gpu(*files):
    """Files of the program `gpu`, with that which takes its times."""
    return [f"benches/src/bin/gpu/{file}" for file in ("timing.rs", *files)]


MEASUREMENTS = {
    "simd": simd(workloads=ALL),
    "simd-avx2": simd("--cpu-level", "avx2", workloads=ALL),
    "simd-baseline": simd("--cpu-level", "baseline", workloads=ALL),
    "single": simd(workloads=["single"]),
    "single-avx2": simd("--cpu-level", "avx2", workloads=["single"]),
    "single-baseline": simd("--cpu-level", "baseline", workloads=["single"]),
    "simd-stream": simd(workloads=FRAMES, samples=5, working_set="stream"),
    "simd-cache-order": simd("--index-order", "cache", workloads=["uniform", "terrain", "character", "worst"], samples=9),
    "simd-threads": Measurement(
        "cpu",
        CPU,
        [
            bench("--backend", "simd", "--threads", str(n), "--frame", "64", "--samples", "9", "--working-set", "cache", workloads=FRAMES)
            for n in THREADS
        ],
        of_threads,
        ["workload", *map(str, THREADS)],
    ),
    "first": Measurement("cpu", CPU, [["first", "--bench"]], of_first, ["nanoseconds of", "baseline", "avx2", "avx512"]),
    "surface": Measurement("cpu", Code(["tess-surface"], []), [["surface", "--bench"]], of_surface, ["surface", "level", "ns a vertex", "fills"]),
    "gpu": gpu(workloads=ALL),
    "gpu-u16": gpu("--index-type", "u16", workloads=["uniform-1", "uniform-16", "uniform-64"]),
    "gpu-no-copies": gpu("--no-copies", workloads=["uniform"]),
    "gpu-ablation": Measurement(
        "gpu",
        GPU,
        [[*EDITS, "terrain", "character", "uniform-16"]],
        of_ablation,
        ["shaders", "terrain", "character", "uniform-16"],
    ),
    "gpu-one-thread": Measurement(
        "gpu", GPU, [[*EDITS, *BATCHES]], of_one_thread, ["workload", "G_triangles/s", "one_thread_a_patch", "times_as_fast"]
    ),
    "gpu-groups": Measurement("gpu", GPU, [["gpu", "groups"]], of_groups, ["meshes", "microseconds"]),
    "gpu-evaluated": Measurement(
        "gpu",
        Code(GPU.packages, files_of_gpu("evaluated.rs", "evaluated")),
        [["gpu", "evaluated"]],
        of_evaluated,
        ["bytes", "octaves", *PASSES.values(), "one pass, attributes", "four passes, attributes"],
    ),
    "gpu-crossover": Measurement(
        "gpu",
        Code([*GPU.packages, *CPU.packages], []),
        [["gpu", "crossover"]],
        of_crossover,
        ["patches", "uniform-1", "uniform-4", "uniform-16", "uniform-64", "character"],
    ),
    "drawn": Measurement(
        "gpu",
        Code([*GPU.packages, "tess-probe"], []),
        [["tess", "probe", "--bench", "--json", *(word for name in DRAWN for word in ("--workload", name))]],
        of_probe,
        [
            "workload",
            "triangles",
            "stage_alone",
            "compute_alone",
            "in_vertex_cache_order_alone",
            "stage_drawn",
            "compute_drawn",
            "in_vertex_cache_order_drawn",
        ],
    ),
    "stage": Measurement(
        "gpu",
        Code(GPU.packages, ["tess-wgpu/examples"]),
        [["tess-examples", "terrain", "--bench", "50", "--triangles", "1000000,10000000,50000000", "--points", "stored,pull,none"]],
        of_stage,
        ["points", "triangles", "prepare_us", "draw_us", "G_triangles/s"],
    ),
    "study-cpu": Measurement("study", Code(CPU.packages, [*WRITTEN, "benches/src/bin/study.rs"]), [["study"]], lines_of),
    "study-gpu": Measurement("study", Code(GPU.packages, files_of_gpu("study.rs", "groups.rs")), [["gpu", "study"]], lines_of, needs_gpu=True),
    "study-sweep": sweep("core", "simd", code=CPU),
    "study-sweep-gpu": sweep("gpu", code=GPU, needs_gpu=True),
}


# The arguments of cargo that build the programs of a set.
BUILDS = {
    "cpu": ["build --release -p tess-program", "bench --no-run -p tess-benches --bench first --bench surface"],
    "gpu": [
        "build --release -p tess-program",
        "build --release -p tess-benches --features gpu --bin gpu",
        "build --release --manifest-path tess-wgpu/examples/Cargo.toml --target-dir target",
    ],
    "study": ["build --release -p tess-program", "build --release -p tess-benches --features gpu --bin gpu --bin study"],
}


def here(arguments):
    """Measures a set on this machine and makes records of it."""
    if changed := output("git", "status", "--porcelain", "--", ".", ":!benches/records", ":!docs"):
        sys.exit(f"a record names a commit; commit these first:\n{changed}")
    for build in BUILDS[arguments.set]:
        subprocess.run(["cargo", *build.split()], cwd=ROOT, check=True)
    with tempfile.TemporaryDirectory() as folder:
        run(argparse.Namespace(set=arguments.set, folder=folder, programs=TARGET / "release", only=None))
        commit = output("git", "rev-parse", "--short=10", "HEAD").strip()
        take(argparse.Namespace(folders=[folder], commit=commit, machine=None))


def output(*words):
    return subprocess.run(words, cwd=ROOT, check=True, text=True, stdout=subprocess.PIPE).stdout


def program(folder, name):
    """The file of a program in cargo's output, or in a folder of programs."""
    built = sorted(folder.glob(f"deps/{name}-*"), key=lambda path: path.stat().st_mtime, reverse=True)
    files = [folder / name, folder / "examples" / name, *(path for path in built if path.suffix == "")]
    return next((path for path in files if path.exists()), folder / name)


def run(arguments):
    """Runs the commands of a set. Writes the rows of each measurement to a folder as soon as it is done."""
    into, programs = Path(arguments.folder).resolve(), Path(arguments.programs).resolve()
    into.mkdir(parents=True, exist_ok=True)
    failed = []
    for name, measurement in MEASUREMENTS.items():
        if measurement.set != arguments.set or arguments.only and name not in arguments.only:
            continue
        if measurement.needs_gpu and card() is None:
            print(f"{name}: left out, because `nvidia-smi` names no GPU; its record stays", flush=True)
            continue
        try:
            outputs = []
            for command, *words in measurement.commands:
                print(f"{name}: {command} {' '.join(words)}", flush=True)
                done = subprocess.run([program(programs, command), *words], cwd=ROOT, check=True, text=True, stdout=subprocess.PIPE)
                outputs.append(done.stdout)
            (into / f"{name}.txt").write_text("\n".join(outputs))
            measured = {"machine": machine(), "date": f"{datetime.datetime.now(datetime.timezone.utc):%Y-%m-%d}"}
            (into / f"{name}.json").write_text(json.dumps({**measured, "rows": measurement.rows(outputs)}))
        except (OSError, subprocess.CalledProcessError, ValueError, LookupError) as error:
            print(f"{name}: {error!r}", flush=True)
            failed.append(name)
    if failed:
        sys.exit(f"not measured: {' '.join(failed)}")


def machine():
    """The processor, and the first GPU of NVIDIA's driver, if there is one."""
    found = re.search(r"^model name\s*: (.*)", Path("/proc/cpuinfo").read_text(), re.MULTILINE)
    cores = len(re.findall(r"^processor\s*:", Path("/proc/cpuinfo").read_text(), re.MULTILINE))
    processor = f"{found[1] if found else 'unknown processor'}, {cores} cores"
    return "; ".join(filter(None, [card(), processor]))


def card():
    """The first GPU of NVIDIA's driver, and the driver's version; None if there is none."""
    query = ["nvidia-smi", "--query-gpu=name,driver_version", "--format=csv,noheader"]
    try:
        return subprocess.run(query, check=True, text=True, stdout=subprocess.PIPE).stdout.splitlines()[0].replace(", ", ", driver ")
    except (OSError, subprocess.CalledProcessError, IndexError):
        return None


def command_of(measurement):
    """The commands as one line, to be typed in the folder of the workspace."""
    in_workspace = {
        "tess": "cargo run --release --",
        "gpu": "cargo run --release -p tess-benches --features gpu --bin gpu --",
        "tess-examples": "cargo example --release",
        "first": "cargo bench -p tess-benches --bench first",
        "surface": "cargo bench -p tess-benches --bench surface",
        "study": "cargo run --release -p tess-benches --bin study --",
    }
    command, *words = measurement.commands[0]
    if len(measurement.commands) > 1:
        words = ["BACKEND" if word == "core" else "N" if word == str(THREADS[0]) else word for word in words]
    return f"{in_workspace[command]} {' '.join(word for word in words if command not in ('first', 'surface'))}".strip().removesuffix(" --")


def record_of(name, measured, commit):
    """The record of a measurement from the rows that `run` wrote."""
    measurement = MEASUREMENTS[name]
    head = {"command": command_of(measurement), "machine": measured["machine"], "date": measured["date"], "commit": commit}
    columns = {"columns": measurement.columns} if measurement.columns else {}
    return {**head, **columns, "rows": measured["rows"]}


def speed(row):
    return row["patches_per_s"] if "patches_per_s" in row else 1 / float(row["ns a vertex"])


def fastest(runs):
    """Of several runs, each row from the one in which it was fastest, as other work on a machine only slows. Tables of several speeds a row
    are the first run's."""
    try:
        return [max(rows, key=speed) for rows in zip(*runs, strict=True)]
    except KeyError:
        return runs[0]


def take(arguments):
    """Makes records of the rows that `run` wrote to folders."""
    for name in sorted({path.name for folder in arguments.folders for path in Path(folder).glob("*.json")}):
        paths = [path for folder in arguments.folders if (path := Path(folder) / name).exists()]
        runs = [json.loads(path.read_text()) for path in paths]
        if len(machines := {run["machine"] for run in runs}) > 1 and not arguments.machine:
            sys.exit(f"{name}: runs of one record are of one machine, not of {sorted(machines)}")
        measured = {**runs[0], "rows": fastest([run["rows"] for run in runs])}
        measured["machine"] = arguments.machine or measured["machine"]
        (RECORDS / name).write_text(text_of(record_of(Path(name).stem, measured, arguments.commit)))
    performance()


def main(words):
    parser = argparse.ArgumentParser(prog="measure.py")
    commands = parser.add_subparsers(required=True)
    whole = commands.add_parser("here", help="build the programs, run a set on this machine, and make its records")
    running = commands.add_parser("run", help="run a set of measurements on this machine")
    for one in (whole, running):
        one.add_argument("set", choices=sorted(BUILDS))
    running.add_argument("folder", help="folder to write NAME.json and NAME.txt to")
    running.add_argument("--programs", default=TARGET / "release", help="folder of tess, gpu, tess-examples, first, surface, study")
    running.add_argument("--only", nargs="+", choices=sorted(MEASUREMENTS), help="run only these measurements of the set")
    taking = commands.add_parser("take", help="make records of the rows that `run` wrote")
    taking.add_argument("folders", nargs="+", metavar="folder", help="of one run, or of several: each row is then the fastest")
    taking.add_argument("--commit", required=True, help="the commit from which the programs were built")
    taking.add_argument("--machine", help="the machine, instead of the one that `run` found")
    for one, does in ((whole, here), (running, run), (taking, take)):
        one.set_defaults(does=does)
    arguments = parser.parse_args(words)
    arguments.does(arguments)


if __name__ == "__main__":
    main(sys.argv[1:])
