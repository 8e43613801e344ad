"""A campaign on Dask: 64 shards of `tess verify` and of a device, merged by `tess merge`.

    python -m tess_model.examples.campaign_on_dask FOLDER [--scheduler ADDRESS] [--kill]

Each shard writes a report to FOLDER, which all workers must be able to access. If a worker dies, another worker runs its
shard again and replaces the report, so every shard is counted once. --kill kills a worker halfway. Without a scheduler,
four workers run on this machine. The workers need `dask[distributed]` and the program `tess`.
"""

import argparse
import hashlib
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import tess_model

SHARDS = 64
SEED, COUNT = 7, 6400


def verify(shard: int, folder: str) -> int:
    """Compares one shard of the CPU backend with the program `tess`; returns its exit code."""
    report = f"{folder}/verify-{shard}.jsonl"
    words = ["tess", "verify", "--backend", "simd", "--random", "200", "--shard", f"{shard}/{SHARDS}"]
    return subprocess.run([*words, "--report", report], stdout=subprocess.DEVNULL).returncode


def device(patch: tess_model.Patch) -> "tuple[Any, Any]":
    """Your device: its points and indices for a patch. Here it is the model."""
    return patch.points, patch.indices


def digest(patches: "list[tess_model.Patch]") -> str:
    """The digest of cases in a report, from which `tess merge` sees that they are the asked ones."""
    hashes = (hashlib.sha256(patch.case.encode()).hexdigest()[:32] for patch in patches)
    return f"{sum(int(half, 16) for half in hashes) % 2**128:032x}"


def check(shard: int, folder: str) -> int:
    """Compares one shard of the device; returns the number of answers that differ."""
    began = time.monotonic()
    asked = list(tess_model.generate(3, seed=SEED, count=COUNT, shard=(shard, SHARDS)))
    verdict = tess_model.check_device(((patch, *device(patch)) for patch in asked), cases=asked)
    report = {
        "format": "tess-report 2",
        "version": tess_model.__version__,
        "commit": "unknown",
        "command": "device",
        "words": ["python", "-m", "tess_model.examples.campaign_on_dask", folder],
        "options": {"level": ["3"], "count": [str(COUNT)]},
        "set": f"level=3 seed={SEED} random={COUNT}",
        "asked": {"cases": len(asked), "digest": digest(asked)},
        "shard": shard,
        "shards": SHARDS,
        "state": "done",
        "cases": verdict.cases,
        "mismatches": verdict.mismatches,
        "milliseconds": int(1000 * (time.monotonic() - began)),
    }
    whole = Path(folder, f"device-{shard}.jsonl")
    part = whole.with_suffix(f".{os.getpid()}")
    part.write_text(json.dumps(report) + "\n")
    part.replace(whole)
    return verdict.mismatches


def main() -> int:
    parser = argparse.ArgumentParser(description="64 shards of `tess verify` and of a device on Dask.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--scheduler", help="address of a scheduler; without it, four workers run here")
    parser.add_argument("--kill", action="store_true", help="kill a worker in the middle")
    parser.add_argument("--shard", help="this shard of the device alone, I/64, as `tess merge` advises")
    options = parser.parse_args()
    folder = options.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    if options.shard:
        return min(check(int(options.shard.split("/")[0]), str(folder)), 1)
    from dask.distributed import Client, as_completed

    for old in folder.glob("*.jsonl"):
        old.unlink()
    where = {"address": options.scheduler} if options.scheduler else {"n_workers": 4, "threads_per_worker": 1}
    with Client(**where) as client:
        shards = range(1, SHARDS + 1)
        tasks = [client.submit(run, i, str(folder), pure=False) for i in shards for run in (verify, check)]
        for done, _ in enumerate(as_completed(tasks), 1):
            if done == SHARDS and options.kill:
                (pid, *_) = client.run(os.getpid).values()
                os.kill(pid, signal.SIGKILL)
                print(f"killed the worker with process {pid}, after {done} of {len(tasks)} tasks")
    return max(merge(folder, name) for name in ("verify", "device"))


def merge(folder: Path, name: str) -> int:
    """Merges the reports of one campaign with `tess merge`; returns its exit code."""
    reports = [str(folder / f"{name}-{shard}.jsonl") for shard in range(1, SHARDS + 1)]
    sys.stdout.flush()
    return subprocess.run(["tess", "merge", *reports]).returncode


if __name__ == "__main__":
    sys.exit(main())
