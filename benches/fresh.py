"""Checks that every record measured the present code; `cargo xtask ci` runs this."""

import io
import json
import re
import subprocess
import sys
import tarfile

from measure import MEASUREMENTS
from records import RECORDS, ROOT, read

# Records that may be older than the code, each with the reason.
EXCEPTIONS = ROOT / "benches/exceptions.json"


def fresh():
    """Checks that each record's commit exists and has the present code, except for the records that EXCEPTIONS names."""
    exceptions = json.loads(EXCEPTIONS.read_text())
    names = {path.stem for path in RECORDS.glob("*.json")}
    problems = [f"{EXCEPTIONS}: there is no record {name}" for name in sorted(exceptions.keys() - names)]
    here = {}
    for name in sorted(names):
        measurement, commit = MEASUREMENTS.get(name), read(name)["commit"]
        if measurement is None:
            problem = "measure.py does not take it"
        elif run_git("cat-file", "-e", f"{commit}^{{commit}}") is None:
            problem = f"its commit {commit} does not exist"
        else:
            sources = tuple(measurement.code.paths())
            if sources not in here:
                here[sources] = code_of("HEAD", sources)
            now = here[sources]
            then = code_of(commit, sources)
            changed = sorted(path for path in now.keys() | then.keys() if now.get(path) != then.get(path))
            problem = f"{changed[0]} has changed since {commit}" if changed else None
        if problem and name not in exceptions:
            measured_by = getattr(measurement, "set", "")
            command = measured_by if measured_by == "study" else f"records {measured_by}"
            problems.append(f"benches/records/{name}.json: {problem}: cargo xtask {command}")
        elif name in exceptions and not problem:
            problems.append(f"{EXCEPTIONS}: {name} needs no exception")
    if problems:
        sys.exit("\n".join(problems))
    print(f"{len(names)} records, {len(exceptions)} exceptions")


def run_git(*words):
    """The output of git; `None` if it fails."""
    done = subprocess.run(["git", *words], cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    return None if done.returncode else done.stdout


def code_of(commit, folders):
    """The code of each file of some folders at a commit."""
    there = [folder for folder in folders if run_git("cat-file", "-e", f"{commit}:{folder}") is not None]
    with tarfile.open(fileobj=io.BytesIO(run_git("archive", commit, "--", *there))) as files:
        sources = [file for file in files if file.isfile() and not file.name.endswith(".md")]
        return {file.name: code_of_file(file.name, files.extractfile(file).read()) for file in sources}


def code_of_file(name, content):
    """The lines of code in a file of Rust or WGSL; of another file, such as a compiled shader, all of it."""
    return code_in(content.decode()) if name.endswith((".rs", ".wgsl")) else content


def code_in(text):
    """The lines of Rust or WGSL code, without comments, empty lines and unit tests."""
    text = text.split("#[cfg(test)]\nmod tests {")[0]
    lines = (re.sub(r"\s//.*", "", line).strip() for line in text.splitlines())
    return [line for line in lines if line and not line.startswith("//")]


if __name__ == "__main__":
    fresh()
