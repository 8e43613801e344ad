#!/usr/bin/env python3
"""Measures the stages of tess-simd's front end over arrays and over the vectors of `wide`, for each target.

Builds the program `lanes` for each target, runs it, and prints the rows of benches/records/lanes-xeon.json.
For aarch64 it counts the instructions that an emulator executes. It needs an x86-64 processor with AVX-512,
Node.js, Debian's gcc-aarch64-linux-gnu and qemu-user-static, and the targets below from rustup.
"""

import json
import os
import subprocess
import sys

AVX2 = "+avx2,+bmi1,+bmi2,+lzcnt,+popcnt"
AVX512 = AVX2 + ",+avx512f,+avx512bw,+avx512cd,+avx512dq,+avx512vl"
NODE = ["node", "--no-warnings", "dev/xtask/src/ports/wasi.mjs"]
QEMU = ["qemu-aarch64-static", "-L", "/usr/aarch64-linux-gnu"]
X86, ARM, WASM = "x86_64-unknown-linux-gnu", "aarch64-unknown-linux-gnu", "wasm32-wasip1"

STAGES = ["factors, integer", "factors, fractional", "contexts", "locations"]
# Blocks, or edges, of one run.
UNITS = {"locations": 96}
BLOCKS = 8


def build(target, features):
    """The program for a target. Each set of features has a folder of its own."""
    folder = os.path.join("target", "lanes", features.replace("+", "").replace(",", "-") or "plain")
    flags = f"-C target-feature={features}" if features else ""
    linker = {"CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER": "aarch64-linux-gnu-gcc"}
    environment = {**os.environ, **linker, "CARGO_TARGET_DIR": folder, "RUSTFLAGS": flags}
    command = ["cargo", "build", "--release", "-p", "tess-benches", "--bin", "lanes"]
    subprocess.run(command + ["--target", target], env=environment, check=True)
    suffix = ".wasm" if target == WASM else ""
    return os.path.join(folder, target, "release", "lanes" + suffix)


def output(command):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def rows(command):
    return [json.loads(line) for line in output(command).splitlines()]


def instructions(program, stage, form, times):
    """Instructions that the emulator executes, one a line of its log."""
    emulator = QEMU + ["-singlestep", "-d", "exec,nochain", program, stage, form, str(times)]
    log = subprocess.Popen(emulator, stderr=subprocess.PIPE)
    count = sum(line.startswith(b"Trace ") for line in log.stderr)
    if log.wait() != 0:
        sys.exit(f"{' '.join(emulator)}: failed")
    return count


def counted(program):
    """The rows of a program whose times mean nothing: the difference of two and of one run."""
    result = rows(QEMU + [program])
    for row in result:
        stage, counts = row["stage"], []
        for form in ["arrays", "wide"]:
            of = [instructions(program, stage, form, times) for times in [1, 2]]
            counts.append((of[1] - of[0]) / UNITS.get(stage, BLOCKS))
        row.update({"unit": "instructions", "arrays": f"{counts[0]:.0f}", "wide": f"{counts[1]:.0f}"})
        row["wide / arrays"] = f"{counts[1] / counts[0]:.2f}"
    return result


def main():
    result = []
    for features in ["", AVX2, AVX512]:
        result += rows([build(X86, features)])
    result += counted(build(ARM, ""))
    result += rows(NODE + [build(WASM, "+simd128")])
    print(json.dumps(result, indent=2))


if __name__ == "__main__":
    main()
