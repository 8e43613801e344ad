#!/usr/bin/env python3
"""Runs `tess mesh` on every model of some folders and judges the outputs.

    judge.py TESS FOLDER... [--validator FOLDER] [--pictures] [--made] [--limit SECONDS]

No code here is shared with the program: pygltflib and numpy read files and compute poses, and Khronos' glTF validator
checks outputs if it is installed in FOLDER as an npm package. A file must be read (exit code 0) or refused (2); with
--made, files whose names begin with `refused-` must be refused and all others read. For each output:

- it loads, its numbers are finite, its normals have unit length;
- at factor 1 its points are the points of the posed input, each within 1e-5 of the diagonal;
- at factor 3, flat and curved, it has at most three open edges for each open edge of the input;
- its triangles face the side of their normals: flat ones, and with --made also curved ones;
- its picture is not blank;
- with --pictures, the pictures that f3d makes of it at factor 1 are those that it makes of a glTF input, unless a note says
  that faces, points or lines were left out or normals were wrong.

Exit code: 0 if all is right, 1 if there are complaints, 2 if no model was found.
"""

import argparse
import collections
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from PIL import Image
from posed import Gltf, posed_triangles
from scipy.spatial import cKDTree

SUFFIXES = {".obj", ".gltf", ".glb", ".bpt"}
FACTOR = 3
MOST_TRIANGLES = 400_000


class Mesh:
    """The triangles of an output: the positions of their corners, and the normals there."""

    def __init__(self, path):
        file = Gltf(path)
        primitives = [primitive for mesh in file.gltf.meshes for primitive in mesh.primitives]
        corners = [file.accessor(primitive.indices).reshape(-1, 3) for primitive in primitives]

        def values(name):
            parts = [file.accessor(getattr(primitive.attributes, name)) for primitive in primitives]
            return np.concatenate([part[of] for part, of in zip(parts, corners)])

        self.positions = values("POSITION")
        self.normals = values("NORMAL").astype(float)


def areas(triangles):
    a, b, c = (triangles[:, k].astype(float) for k in range(3))
    return np.cross(b - a, c - a)


def diagonal(triangles):
    points = triangles.reshape(-1, 3).astype(float)
    return float(np.linalg.norm(points.max(0) - points.min(0)))


def solid(triangles):
    """The triangles that have an area, within rounding."""
    a, b, c = (triangles[:, k].astype(float) for k in range(3))
    sides = np.linalg.norm(b - a, axis=1) * np.linalg.norm(c - a, axis=1)
    return triangles[np.linalg.norm(areas(triangles), axis=1) > 2.0**-22 * sides]


def open_edges(triangles):
    """The number of edges that belong to an odd number of triangles, after points with equal bits are joined."""
    points = (triangles.reshape(-1, 3) + np.float32(0)).view(np.uint32)
    _, numbers = np.unique(points, axis=0, return_inverse=True)
    corners = numbers.reshape(-1, 3)
    edges = np.sort(np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]]), axis=1)
    edges = edges[edges[:, 0] != edges[:, 1]]
    _, counts = np.unique(edges, axis=0, return_counts=True)
    return int((counts % 2).sum())


def judge_numbers(mesh):
    if not len(mesh.positions):
        return ["it has no triangle"]
    if not (np.isfinite(mesh.positions).all() and np.isfinite(mesh.normals).all()):
        return ["a number is not finite"]
    lengths = np.linalg.norm(mesh.normals, axis=2)
    wrong = int((abs(lengths - 1) > 1e-3).sum())
    return [f"{wrong} normals do not have unit length"] if wrong else []


def judge_pose(mesh, expected):
    """Checks that each point of one set is within a tolerance of the other set."""
    reach = max(1e-5 * diagonal(expected), 1e-30)
    complaints = []
    kept = solid(expected).reshape(-1, 3)
    if not len(kept):
        return ["the input has no triangle with an area"]
    found = mesh.positions.reshape(-1, 3)
    for name, points, others in [("output", found, expected.reshape(-1, 3)), ("input", kept, found)]:
        distance = float(cKDTree(others).query(points)[0].max())
        if distance > reach:
            complaints.append(f"a point of the {name} is {distance:.3g} from the other's, more than {reach:.3g}")
    return complaints


def judge_cracks(mesh, expected):
    before, after = open_edges(solid(expected)), open_edges(mesh.positions)
    return [f"{after} open edges from {before}"] if after > FACTOR * before else []


def judge_sides(mesh):
    """Checks that triangles face the direction in which their normals point."""
    normals = areas(mesh.positions)
    lengths = np.linalg.norm(normals, axis=1)
    large = lengths > 1e-4 * lengths.max()
    towards = np.einsum("ij,ij->i", normals, mesh.normals.mean(1))
    turned = int((large & (towards < -1e-3 * lengths)).sum())
    return [f"{turned} triangles look away from their normals"] if turned else []


def judge_picture(path):
    pixels = np.asarray(Image.open(path).convert("RGB")).reshape(-1, 3)
    drawn = (pixels != pixels[0]).any(1).mean()
    return [f"only {drawn:.2%} of the picture is drawn"] if drawn < 0.005 else []


class Run:
    """Runs of the program on one file."""

    def __init__(self, tess, path, folder, limit):
        self.tess, self.path, self.folder, self.limit = tess, path, pathlib.Path(folder), limit
        self.reason = None
        self.notes = []

    def mesh(self, name, words):
        """The output's path; None if the file is refused, and then `reason` is set."""
        out = self.folder / name
        command = [self.tess, "mesh", str(self.path), *words.split(), "-o", str(out)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=self.limit, check=False)
        lines = [line for line in done.stderr.splitlines() if line.strip()]
        self.notes = [line for line in lines if line.startswith("tess: note: ")]
        if done.returncode == 2 and lines and self.path.name in done.stderr:
            self.reason = done.stderr.strip().replace(str(self.path), self.path.name)
            return None
        if done.returncode != 0:
            raise RuntimeError(f"exit code {done.returncode}: {done.stderr[-300:]}")
        return out


def judge_file(run, validate, made):
    """The complaints about one file; None if it is refused."""
    is_bezier = run.path.suffix.lower() == ".bpt"
    flat = "" if is_bezier else "--surface flat"
    whole = run.mesh("whole.glb", f"--factor 1 {flat}")
    if whole is None:
        return None
    mesh = Mesh(whole)
    complaints = judge_numbers(mesh)
    if complaints:
        return complaints
    expected = mesh.positions if is_bezier else posed_triangles(run.path)
    complaints += judge_pose(mesh, expected)
    if len(expected) <= MOST_TRIANGLES:
        outputs = [run.mesh("flat.glb", f"--factor {FACTOR} {flat}"), run.mesh("curved.glb", f"--factor {FACTOR}")]
        for out in outputs:
            mesh = Mesh(out)
            complaints += [f"{out.name}: {what}" for what in judge_numbers(mesh) + judge_cracks(mesh, expected)]
        if not is_bezier:
            complaints += [what for out in outputs[: 1 + made] for what in judge_sides(Mesh(out))]
        # What is wrong with the input's materials is wrong with the output's, which are the same.
        of_input = validate([run.path]) if run.path.suffix.lower() in (".gltf", ".glb") else []
        complaints += sorted(set(validate([whole, outputs[0]])) - set(of_input))
    complaints += judge_picture(run.mesh("picture.png", "--factor 2 --size 160x120"))
    return complaints


# Notes on what the output shows otherwise.
CHANGED = ("points or lines", "no whole triangle", "smooth normals")


class Pictures:
    """Compares pictures of inputs and outputs."""

    def __init__(self):
        import pictured  # f3d needs a library of graphics, which not every machine has

        self.pictured = pictured
        self.compared = self.faults = 0
        self.unseen = []

    def judge(self, run):
        if run.path.suffix.lower() not in (".gltf", ".glb"):
            return []
        out = run.mesh("look.gltf", "--factor 1")
        if any(words in note for note in run.notes for words in CHANGED):
            return []
        part, drawn = self.pictured.difference(run.path, out)
        self.compared += 1
        # The same comparison must see that materials are lost.
        faulty = out.with_name("faulty.gltf")
        if drawn > 0.02 and self.pictured.without_materials(out, faulty):
            self.faults += 1
            if self.pictured.difference(run.path, faulty)[0] <= self.pictured.MOST:
                self.unseen.append(run.path.name)
        return [f"{part:.2%} of a picture differs"] if part > self.pictured.MOST else []


VALIDATE = """
const validator = require("gltf-validator"), fs = require("fs"), { dirname, resolve } = require("path");
const read = (path) => new Uint8Array(fs.readFileSync(path));
Promise.all(process.argv.slice(1).map(async (path) => {
    const externalResourceFunction = async (uri) => read(resolve(dirname(path), decodeURIComponent(uri)));
    const report = await validator.validateBytes(read(path), { externalResourceFunction });
    return report.issues.messages.filter((issue) => issue.severity === 0).map((issue) => issue.message);
})).then((issues) => console.log(JSON.stringify(issues.flat())));
"""


def validator(folder):
    """A function that returns the validator's errors in files; without a folder, one that returns none."""
    if folder is None:
        return lambda paths: []

    def validate(paths):
        command = ["node", "-e", VALIDATE, *(str(path.resolve()) for path in paths)]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True)
        return [f"validator: {issue}" for issue in json.loads(done.stdout)]

    return validate


def check_judges():
    """Checks that every judge detects a fault that is planted for it."""
    square = np.array([[[0, 0, 0], [1, 0, 0], [1, 1, 0]], [[0, 0, 0], [1, 1, 0], [0, 1, 0]]], dtype=np.float32)
    mesh = Mesh.__new__(Mesh)

    def with_fault(positions=None, normals=None):
        mesh.positions, mesh.normals = square.copy(), np.zeros((2, 3, 3)) + [0, 0, 1]
        if positions is not None:
            mesh.positions[positions] += np.float32(0.001)
        if normals is not None:
            mesh.normals[normals] *= -1.5 if normals == (0, 0) else -1
        return mesh

    right = with_fault()
    assert not judge_numbers(right) + judge_pose(right, square) + judge_cracks(right, square) + judge_sides(right)
    assert judge_numbers(with_fault(normals=(0, 0))), "a long normal"
    assert judge_pose(with_fault(positions=(1, 2)), square), "a moved point"
    assert open_edges(square) == 4 and open_edges(with_fault(positions=(1, 0)).positions) == 6, "a crack"
    assert judge_sides(with_fault(normals=1)), "a turned triangle"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tess")
    parser.add_argument("folders", nargs="+", type=pathlib.Path)
    parser.add_argument("--validator", type=pathlib.Path, help="folder of node_modules with gltf-validator")
    parser.add_argument("--pictures", action="store_true", help="compare pictures by f3d")
    parser.add_argument("--made", action="store_true", help="names say which files are refused")
    parser.add_argument("--limit", type=float, default=120, help="most seconds of a run")
    args = parser.parse_args()
    check_judges()
    validate = validator(args.validator)
    files = sorted(path for folder in args.folders for path in folder.rglob("*") if path.suffix.lower() in SUFFIXES)
    if not files:
        sys.exit(2)
    refused, wrong, pictures = collections.Counter(), 0, Pictures() if args.pictures else None
    for path in files:
        with tempfile.TemporaryDirectory() as folder:
            run = Run(args.tess, path, folder, args.limit)
            try:
                complaints = judge_file(run, validate, args.made)
                if pictures and complaints is not None:
                    complaints += pictures.judge(run)
            except Exception as error:  # whatever goes wrong with one file is a finding
                complaints = [f"{type(error).__name__}: {error}"]
        if complaints is None:
            refused[run.reason.split(": ", 2)[-1]] += 1
            complaints = []
        must_refuse = path.name.startswith("refused-")
        if args.made and must_refuse != (run.reason is not None):
            complaints.append(f"refused: {run.reason}" if run.reason else "it should be refused")
        wrong += bool(complaints)
        for complaint in complaints:
            print(f"{path}: {complaint}", flush=True)
    for reason, count in refused.most_common():
        print(f"refused {count}: {reason}")
    if pictures:
        seen = pictures.faults - len(pictures.unseen)
        print(f"{pictures.compared} files pictured; of {pictures.faults} outputs without materials {seen} are seen")
        for name in pictures.unseen:
            print(f"not seen without materials: {name}")
    print(f"{len(files)} files: {len(files) - refused.total()} read, {refused.total()} refused, {wrong} with complaints")
    verdict = "FAILED" if wrong else "ok"
    print(f"test result: {verdict}. {len(files) - wrong} passed; {wrong} failed; 0 ignored")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
