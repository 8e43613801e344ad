#!/usr/bin/env python3
"""Makes small models of every common kind: make.py FOLDER.

The program must refuse the files whose names begin with `refused-` and read all others.
"""

import base64
import json
import math
import pathlib
import struct
import sys


class Gltf:
    """A glTF file that is being built."""

    def __init__(self):
        self.data = b""
        self.json = {
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {}}]}], "accessors": [], "bufferViews": [],
        }

    @property
    def primitive(self):
        return self.json["meshes"][0]["primitives"][0]

    def accessor(self, rows, code="f", kind="VEC3", target=None, stride=None, **more):
        """Adds an accessor of rows of numbers, packed with a code of `struct`, and returns its number."""
        size = struct.calcsize(code)
        row = stride or len(rows[0]) * size
        packed = [struct.pack(f"<{len(r)}{code}", *r).ljust(row, b"\0") for r in rows]
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": row * len(rows)}
        if target:
            view["target"] = target
        if target == 34962:
            view["byteStride"] = row
        self.json["bufferViews"].append(view)
        self.data += b"".join(packed)
        self.data += bytes(-len(self.data) % 4)
        component = {"b": 5120, "B": 5121, "h": 5122, "H": 5123, "I": 5125, "f": 5126}[code]
        bounds = {"min": [min(c) for c in zip(*rows)], "max": [max(c) for c in zip(*rows)]}
        if code == "f":
            bounds = {name: [struct.unpack("f", struct.pack("f", x))[0] for x in xs] for name, xs in bounds.items()}
        accessor = {"bufferView": len(self.json["bufferViews"]) - 1, "componentType": component, "count": len(rows),
                    "type": kind, **bounds, **more}
        self.json["accessors"].append(accessor)
        return len(self.json["accessors"]) - 1

    def attribute(self, name, rows, code="f", kind="VEC3", **more):
        stride = (struct.calcsize(code) * len(rows[0]) + 3) // 4 * 4
        self.primitive["attributes"][name] = self.accessor(rows, code, kind, 34962, stride, **more)

    def indices(self, numbers, code="H"):
        self.primitive["indices"] = self.accessor([[n] for n in numbers], code, "SCALAR", 34963)

    def text(self):
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        return json.dumps({**self.json, "buffers": [{"byteLength": len(self.data), "uri": uri}]}).encode()

    def binary(self):
        document = json.dumps({**self.json, "buffers": [{"byteLength": len(self.data)}]}).encode()
        document += b" " * (-len(document) % 4)
        length = 28 + len(document) + len(self.data)
        head = struct.pack("<4sIIII", b"glTF", 2, length, len(document), 0x4E4F534A)
        return head + document + struct.pack("<II", len(self.data), 0x004E4942) + self.data


def grid(side=6, bend=0.4):
    """The points of a bent sheet, row by row, and its quads."""
    points = [(i, j, bend * math.sin(i) * math.cos(0.7 * j)) for j in range(side) for i in range(side)]
    corners = [(j * side + i) for j in range(side - 1) for i in range(side - 1)]
    return points, [(c, c + 1, c + side + 1, c + side) for c in corners]


def sheet(**more):
    """A glTF file of the bent sheet."""
    file = Gltf()
    points, quads = grid()
    file.attribute("POSITION", points)
    file.indices([n for a, b, c, d in quads for n in (a, b, c, a, c, d)])
    file.json.update(more)
    return file


def obj(points, faces, more=""):
    lines = ["v " + " ".join(f"{x:.7g}" for x in point) for point in points]
    lines += ["f " + " ".join(str(n + 1) for n in face) for face in faces]
    return ("\n".join(lines) + "\n" + more).encode()


CUBE = [(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
CUBE_FACES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (2, 0, 4, 6)]


def obj_models():
    points, quads = grid()
    yield "cube.obj", obj(CUBE, CUBE_FACES)
    yield "sheet.obj", obj(points, quads)
    yield "two-sided.obj", obj(points, quads + [tuple(reversed(quad)) for quad in quads])
    turned = [(a, c, b) for a, b, c, d in quads] + [(a, d, c) for a, b, c, d in quads]
    yield "two-sided-cut.obj", obj(points, quads + turned)
    yield "wrong-order.obj", obj(points, quads[:7] + [tuple(reversed(quads[7]))] + quads[8:])
    fin = [(2, 2, 3), (3, 2, 3)]
    yield "fin.obj", obj(points + fin, quads + [(14, 15, 37, 36)])
    yield "touching-cubes.obj", obj(
        CUBE + [(x + 2, y + 2, z) for x, y, z in CUBE], CUBE_FACES + [tuple(n + 8 for n in f) for f in CUBE_FACES])
    circle = [(math.cos(k * math.pi / 12), math.sin(k * math.pi / 12), 0) for k in range(24)]
    yield "disc.obj", obj(circle, [range(24)])
    star = [(x * (1 if k % 2 else 0.4), y * (1 if k % 2 else 0.4), 0) for k, (x, y, _) in enumerate(circle)]
    yield "star.obj", obj(star, [range(24)])
    yield "concave-quad.obj", obj([(0, 0, 0), (2, 0, 0), (0.4, 0.4, 0), (0, 2, 0)], [(0, 1, 2, 3)])
    hanging = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (1, 0.5, 0), (2, 0, 0), (2, 0.5, 0), (2, 1, 0)]
    yield "hanging.obj", obj(hanging, [(0, 1, 2, 3), (1, 5, 6, 4), (4, 6, 7, 2)])
    seam = [(-1, 0, 0), (0, 0, 0), (0, 1, 0), (-1, 1, 0), (1e-9, 0, 0), (1, 0, 0), (1, 1, 0), (-1e-9, 1, 0)]
    yield "seam.obj", obj(seam, [(0, 1, 2, 3), (4, 5, 6, 7)])
    yield "pole.obj", obj([(0, 0, 1), *circle[::4]], [(0, 1 + k, 1 + (k + 1) % 6, 0) for k in range(6)])
    yield "line-face.obj", obj(CUBE + [(0, 0, 9), (0, 0, 8), (0, 0, 7)], CUBE_FACES + [(8, 9, 10)])
    triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
    for name, rest in {
        "zero-normal": "vn 0 0 0\nf 1//1 2//1 3//1\n", "nan-normal": "vn nan nan nan\nf 1 2 3\n",
        "slashes": "vt 0 0\nf 1/1/ 2/1/ 3/1/\n", "more-slashes": "f 1// 2// 3//\n", "backwards": "f -3 -2 -1\n",
        "lines": "l 1 2\np 3\nf 1 2 3\n", "comment": "# caf\u00e9\nf 1 2 3 # all\n",
        "refused-word": "f 1 2 three\n", "refused-index": "f 1 2 4\n", "refused-keyword": "face 1 2 3\n",
        "refused-empty": "",
    }.items():
        yield f"{name}.obj", (triangle + rest).encode()


def bpt_models():
    rows = [f"{i} {j} {(i * j) % 3}" for j in range(4) for i in range(4)]
    points = "\n".join(rows)
    yield "patch.bpt", f"1\n3 3\n{points}\n".encode()
    yield "comment.bpt", f"# a patch\n1\n3 3\n{points}\n".encode()
    yield "four-four.bpt", f"1\n4 4\n{points}\n".encode()
    yield "one-line.bpt", f"1 3 3 {' '.join(rows)}".encode()
    yield "rows.bpt", ("1\n4 4\n" + "\n".join(" ".join(rows[k : k + 4]) for k in range(0, 16, 4))).encode()
    yield "refused-short.bpt", f"2\n3 3\n{points}\n".encode()


def skinned(weights, code="f", **more):
    """The sheet, bent by two joints."""
    file = sheet()
    joints = [[0, 1, 0, 0] for _ in range(36)]
    rows = [weights(x) for j in range(6) for x in range(6)]
    file.attribute("JOINTS_0", joints, "B", "VEC4")
    file.attribute("WEIGHTS_0", rows, code, "VEC4", **more)
    half = math.sqrt(0.5)
    file.json["nodes"] = [
        {"mesh": 0, "skin": 0, "translation": [100, 0, 0]}, {"children": [2], "translation": [0, 1, 0]},
        {"translation": [2.5, 0, 0], "rotation": [0, half, 0, half]},
    ]
    back = [[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -x, 0, 0, 1] for x in (0, 2.5)]
    file.json["skins"] = [{"joints": [1, 2], "inverseBindMatrices": file.accessor(back, "f", "MAT4")}]
    file.json["scenes"][0]["nodes"] = [0, 1]
    return file


def morphed(**more):
    file = sheet()
    moves = [(0, 0, 0.5 * i) for j in range(6) for i in range(6)]
    file.primitive["targets"] = [{"POSITION": file.accessor(moves, target=34962)} for _ in range(2)]
    file.json["meshes"][0]["weights"] = [0.5, 0]
    file.json["nodes"][0].update(more)
    return file


def gltf_models():
    yield "sheet.gltf", sheet().text()
    yield "sheet.glb", sheet().binary()
    yield "morph.gltf", morphed().text()
    yield "morph-node.glb", morphed(weights=[0.25, -1.0]).binary()
    both = skinned(lambda x: [1 - x / 5, x / 5, 0, 0])
    moves = both.accessor([(0, 0, 1)] * 36, target=34962)
    both.primitive["targets"], both.json["meshes"][0]["weights"] = [{"POSITION": moves}], [0.5]
    yield "skin.gltf", skinned(lambda x: [1 - x / 5, x / 5, 0, 0]).text()
    yield "skin-bytes.glb", skinned(lambda x: [255 - 51 * x, 51 * x, 0, 0], "B", normalized=True).binary()
    yield "skin-morph.gltf", both.text()
    mirrored = sheet()
    mirrored.attribute("NORMAL", [(0, 0, 1)] * 36)
    mirrored.json["nodes"] = [{"children": [1], "scale": [1, 1, -2]}, {"mesh": 0, "rotation": [0, 0.6, 0, 0.8]}]
    yield "mirrored.gltf", mirrored.text()
    for axis, scale in {"flat": [1, 1, 0], "gone": [0, 0, 0]}.items():
        file = sheet()
        file.attribute("NORMAL", [(0, 0, 1)] * 36)
        file.json["nodes"] = [{"children": [1, 2]}, {"mesh": 0}, {"mesh": 0, "scale": scale, "translation": [0, 0, 9]}]
        yield f"scale-{axis}.gltf", file.text()
    for mode, name in {5: "strip", 6: "fan"}.items():
        file = Gltf()
        points = [(math.cos(k), math.sin(k), 0) for k in range(6)]
        file.attribute("POSITION", points if mode == 6 else [points[k] for k in (0, 1, 5, 2, 4, 3)])
        file.primitive["mode"] = mode
        yield f"{name}.gltf", file.text()
    lines = sheet()
    lines.json["meshes"][0]["primitives"] += [{**lines.primitive, "mode": mode} for mode in (0, 1, 3)]
    yield "with-lines.gltf", lines.text()
    small = Gltf()
    small.attribute("POSITION", [(0, 0, 0), (100, 0, 0), (0, 100, 50)], "h")
    small.attribute("NORMAL", [(0, 0, 127)] * 3, "b", normalized=True)
    small.json["extensionsUsed"] = small.json["extensionsRequired"] = ["KHR_mesh_quantization"]
    yield "quantized.gltf", small.text()
    for name in ("KHR_texture_transform", "KHR_materials_unlit", "KHR_lights_punctual"):
        yield f"{name}.gltf", sheet(extensionsUsed=[name], extensionsRequired=[name]).text()
    bare = sheet()
    del bare.json["scenes"], bare.json["scene"]
    yield "no-scenes.gltf", bare.text()
    yield "points.gltf", sheet().text().replace(b'"count": 36', b'"count": 36.0')
    sparse = sheet()
    places = sparse.accessor([[0], [35]], "H", "SCALAR")
    values = sparse.accessor([(-1, -1, -1), (9, 9, 9)])
    view = [sparse.json["accessors"][n]["bufferView"] for n in (places, values)]
    sparse.json["accessors"][0].update({"max": [9, 9, 9], "min": [-1, -1, -1], "sparse": {
        "count": 2, "indices": {"bufferView": view[0], "componentType": 5123}, "values": {"bufferView": view[1]}}})
    del sparse.json["accessors"][places:]
    yield "sparse.gltf", sparse.text()
    yield "refused-version.gltf", b'{"asset": {"version": "1.0"}, "accessors": {}, "meshes": {}, "nodes": {}}'
    yield "refused-extension.gltf", sheet(extensionsRequired=["EXT_meshopt_compression"]).text()
    draco = sheet(extensionsUsed=["KHR_draco_mesh_compression"])
    draco.primitive["extensions"] = {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}
    del draco.json["accessors"][0]["bufferView"]
    yield "refused-draco.gltf", draco.text()
    yield "refused-cut.glb", sheet().binary()[:-8]


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for models in (obj_models, bpt_models, gltf_models):
        for name, content in models():
            (folder / name).write_bytes(content)


if __name__ == "__main__":
    main()
