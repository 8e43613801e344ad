"""The findings of `tess probe` and Debian's piglit on each driver, and how long a frame takes."""

import json
import os
import subprocess
import sys
from collections import Counter
from pathlib import Path

# What is asked of each driver: a name for the table, and arguments of `tess probe`. The draws of the last one are too long for
# Mesa as it is.
QUESTIONS = {
    "level 1": "--level 1",
    "level 3, 60000 patches": "--level 3 --count 60000",
    "level 1, draws of 200000 vertices": "--level 1 --draw-vertices 200000",
}
SHORT, _, LONG = QUESTIONS

# What `tess probe` says of a driver that mixes the vertices of different patches, as one does whose numbers wrap.
NO_SENSE = "the capture makes no sense"

# Patches of one configuration: each in one column. All but the first two are differences.
COLUMNS = ["patches", "sequence", "leading", "order", "connectivity", "coordinates", "culling"]

# The workloads whose frames are timed: those of `tess bench` whose frames an unpatched driver draws in seconds.
WORKLOADS = "uniform-1 uniform-2 uniform-4 uniform-8 uniform-16 terrain character mosaic mosaic-even".split()

# How often each driver draws them, in turn; a run's time is that of its fastest frame.
ROUNDS = 2

# piglit and what it runs on, save what every Debian with OpenGL has. Without `wflinfo`, of waffle-utils, it skips most tests.
PIGLIT = ["piglit", "libwaffle-1-0", "waffle-utils", "python3-six"]

# The tests that are run, and those of them that are not: 1481 that compute built-in functions in both stages, each with the
# same patch.
TESTS = ["-t", "arb_tessellation_shader", "-x", "built-in-functions"]


def probe(program, place, variant, words):
    """The report of `tess probe --json` on a driver. It ends with 1 where patches differ, which is an answer."""
    print(f"\n$ tess probe --json {words}, on {variant}", flush=True)
    command = [program, "probe", "--json", *words.split()]
    environment = {**os.environ, **place.environment(variant)}
    return subprocess.run(command, env=environment, capture_output=True, text=True)


def answer(probe, result):
    if result.returncode not in (0, 1):
        sys.exit(f"`tess probe` ended with {result.returncode}: {result.stderr}")
    return json.loads(result.stdout)


def ask(program, place, variant):
    """The sums of the columns, for each question."""
    answers = {}
    for question, words in QUESTIONS.items():
        result = probe(program, place, variant, words)
        if question == LONG and result.returncode not in (0, 1) and NO_SENSE in result.stderr:
            patches = answers[SHORT]["patches"]
            answers[question] = {**dict.fromkeys(COLUMNS, 0), "patches": patches, "connectivity": patches}
            continue
        rows = answer(probe, result)["rows"]
        answers[question] = {column: sum(row[column] for row in rows) for column in COLUMNS}
    return answers


def frames(program, place, variants):
    """The fastest frames of each driver, which take turns: what else the machine does falls on all of them."""
    fastest = {variant: {} for variant in variants}
    words = "--bench" + "".join(f" --workload {workload}" for workload in WORKLOADS)
    for variant in list(variants) * ROUNDS:
        for row in answer(probe, probe(program, place, variant, words)):
            best = fastest[variant].setdefault(row["workload"], row)
            best.update({key: min(best[key], row[key]) for key in ("fixed", "fixed_drawn")})
    return fastest


def piglit(place, variant):
    """The result of each test on a variant's llvmpipe, without a window system: `pass`, `fail`, `crash`, `skip`, ..."""
    root = place.folder.parent / "piglit"
    if not root.exists():
        place.unpack(PIGLIT, root)
    given = place.folder / "piglit-results" / variant
    libraries = root / "usr/lib/x86_64-linux-gnu"
    environment = {
        **os.environ,
        **place.environment(variant),
        "LD_LIBRARY_PATH": f"{libraries}:{libraries}/piglit/lib",
        "PYTHONPATH": f"{root}/usr/lib/python3/dist-packages",
        "PATH": f"{root}/usr/bin:{os.environ['PATH']}",
        "PYTHONDONTWRITEBYTECODE": "1",
        "PIGLIT_COMPRESSION": "none",
    }
    # The system's interpreter has Mako, which Mesa's build needs too.
    command = ["/usr/bin/python3", root / "usr/bin/piglit", "run", "--overwrite", "-l", "dummy", "-p", "surfaceless_egl"]
    print(f"\n$ piglit, on {variant}", flush=True)
    subprocess.run([*command, "-b", "json", *TESTS, "quick", given], env=environment, check=True)
    tests = json.loads((given / "results.json").read_text())["tests"]
    results = {name: test["result"] for name, test in tests.items()}
    if 2 * Counter(results.values())["skip"] > len(results):
        sys.exit(f"{given}: piglit skipped most tests, so it found no driver")
    return results


def table(version, found):
    """The table, in Markdown: three parts, each with a row for each driver."""

    def part(*heads):
        print("\n|", " | ".join(heads), "|\n|", " | ".join("---" for _ in heads), "|")

    print(f"\nMesa {version}; patches by how they compare with the model:")
    part("driver", "asked", "patches", "in order", "leading", "reorder", "connected", "points", "culling")
    for question in QUESTIONS:
        for variant, one in found.items():
            print("|", " | ".join([variant, question, *map(str, one["answers"][question].values())]), "|")
    given = ["pass", "fail", "crash", "skip"]
    part("driver", "piglit's tests", *given)
    for variant, one in found.items():
        counts = Counter(one["piglit"].values())
        print("|", variant, "|", len(one["piglit"]), "|", " | ".join(str(counts[result]) for result in given), "|")
    part("workload", "triangles", "driver", "discarded, ms", "drawn, ms")
    for variant, one in found.items():
        for workload, row in one["frames"].items():
            print(f"| {workload} | {row['triangles']} | {variant} | {row['fixed']:.2f} | {row['fixed_drawn']:.2f} |")


def judge(found):
    """Why a patched driver is not as good as the unpatched one, or draws long draws otherwise than short ones."""
    (_, unpatched), *patched = found.items()
    for variant, one in patched:
        if one["piglit"] != unpatched["piglit"]:
            differing = one["piglit"].items() ^ unpatched["piglit"].items()
            return f"{variant}: tests of piglit give something else than unpatched: {min(differing)}"
        for question in QUESTIONS:
            own, other = one["answers"][question], unpatched["answers"][question]
            if own["patches"] != other["patches"] or any(own[column] > other[column] for column in COLUMNS[2:]):
                return f"{question}: {variant} is worse than unpatched"
    whole_draws = patched[-1][1]["answers"]
    if whole_draws[LONG] != whole_draws[SHORT]:
        return "long draws with all patches differ from short ones"
    if unpatched["answers"][LONG] == unpatched["answers"][SHORT]:
        return "long draws are right without patches: the question shows nothing"
    return None


def run(place, variants):
    """Asks every driver, prints the table, and judges it."""
    for variant in variants:
        manifest = Path(place.environment(variant)["VK_DRIVER_FILES"])
        if not manifest.exists():
            sys.exit(f"{manifest} is missing: `cargo xtask mesa build` makes it")
    workspace = Path(__file__).resolve().parent.parent.parent
    subprocess.run(["cargo", "build", "--package", "tess-program"], cwd=workspace, check=True)
    program = place.folder.parent.parent / "debug/tess"
    timed = frames(program, place, variants)
    found = {
        variant: {
            "answers": ask(program, place, variant),
            "piglit": piglit(place, variant),
            "frames": timed[variant],
        }
        for variant in variants
    }
    table(place.version, found)
    if fault := judge(found):
        sys.exit(fault)
    print("\nno patched driver is worse in any column or in any test of piglit; long draws are right with all patches alone")
