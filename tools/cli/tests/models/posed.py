"""The triangles of a model file, posed as its standard demands, computed with pygltflib and numpy."""

import base64
import json
import pathlib
import struct
import urllib.parse

import numpy as np
import pygltflib
from scipy.spatial.transform import Rotation

DTYPES = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
SIZES = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


def posed_triangles(path):
    """The corners of the triangles, float32 of shape (n, 3, 3)."""
    if path.suffix.lower() == ".obj":
        return obj_triangles(path)
    return Gltf(path).triangles()


def obj_triangles(path):
    """OBJ faces as fans of triangles, which have the same corners and border as any other triangulation."""
    positions, triangles = [], []
    for line in path.read_text(encoding="utf-8-sig", errors="replace").splitlines():
        words = line.split("#")[0].split()
        if words[:1] == ["v"]:
            positions.append([float(word) for word in words[1:4]])
        elif words[:1] == ["f"]:
            corners = [int(word.split("/")[0]) for word in words[1:]]
            corners = [corner - 1 if corner > 0 else len(positions) + corner for corner in corners]
            triangles += [[corners[0], corners[k - 1], corners[k]] for k in range(2, len(corners))]
    return np.array(positions, dtype=np.float32)[np.array(triangles)]


def document(path):
    """The JSON of a glTF file, because pygltflib leaves out the nodes' weights."""
    data = path.read_bytes()
    if data[:4] == b"glTF":
        data = data[20 : 20 + struct.unpack("<I", data[12:16])[0]]
    return json.loads(data)


class Gltf:
    """A glTF file with its buffers loaded."""

    def __init__(self, path):
        self.gltf = pygltflib.GLTF2().load(str(path))
        self.weights = [node.get("weights") for node in document(path).get("nodes", [])]
        self.buffers = [self.buffer(path, buffer) for buffer in self.gltf.buffers]

    def buffer(self, path, buffer):
        if buffer.uri is None:
            return self.gltf.binary_blob()
        if buffer.uri.startswith("data:"):
            return base64.b64decode(buffer.uri.split(",", 1)[1])
        return (pathlib.Path(path).parent / urllib.parse.unquote(buffer.uri)).read_bytes()

    def elements(self, view, offset, dtype, size, count):
        view = self.gltf.bufferViews[view]
        data, item = self.buffers[view.buffer], np.dtype(dtype).itemsize
        start = (view.byteOffset or 0) + (offset or 0)
        strides = (view.byteStride or item * size, item)
        return np.ndarray((count, size), dtype, data, start, strides).copy()

    def accessor(self, number):
        accessor = self.gltf.accessors[number]
        dtype, size = DTYPES[accessor.componentType], SIZES[accessor.type]
        if accessor.bufferView is None:
            values = np.zeros((accessor.count, size), dtype)
        else:
            values = self.elements(accessor.bufferView, accessor.byteOffset, dtype, size, accessor.count)
        if accessor.sparse:
            indices, new = accessor.sparse.indices, accessor.sparse.values
            places = self.elements(
                indices.bufferView, indices.byteOffset, DTYPES[indices.componentType], 1, accessor.sparse.count
            )
            values[places[:, 0]] = self.elements(new.bufferView, new.byteOffset, dtype, size, accessor.sparse.count)
        if accessor.normalized and accessor.componentType != 5126:
            return np.maximum(values / float(np.iinfo(dtype).max), -1.0)
        return values

    def local(self, node):
        if node.matrix:
            return np.array(node.matrix, float).reshape(4, 4).T
        matrix = np.eye(4)
        rotation = Rotation.from_quat(node.rotation or [0, 0, 0, 1]).as_matrix()
        matrix[:3, :3] = rotation * np.array(node.scale or [1, 1, 1], float)
        matrix[:3, 3] = node.translation or [0, 0, 0]
        return matrix

    def transforms(self):
        nodes = self.gltf.nodes
        world = [None] * len(nodes)
        below = {child for node in nodes for child in node.children or []}
        waiting = [(root, np.eye(4)) for root in range(len(nodes)) if root not in below]
        while waiting:
            number, parent = waiting.pop()
            world[number] = parent @ self.local(nodes[number])
            waiting += [(child, world[number]) for child in nodes[number].children or []]
        return world, below

    def triangles(self):
        world, below = self.transforms()
        scenes = self.gltf.scenes or []
        roots = [n for n in range(len(world)) if n not in below]
        if scenes:
            roots = scenes[self.gltf.scene or 0].nodes or []
        found, waiting = [], list(roots)
        while waiting:
            node = self.gltf.nodes[waiting.pop()]
            waiting += node.children or []
            if node.mesh is not None:
                found += self.mesh(node, world)
        return np.concatenate(found).astype(np.float32) if found else np.zeros((0, 3, 3), np.float32)

    def mesh(self, node, world):
        mesh = self.gltf.meshes[node.mesh]
        number = next(n for n, other in enumerate(self.gltf.nodes) if other is node)
        weights, own = self.weights[number] or mesh.weights or [], world[number]
        found = []
        for primitive in mesh.primitives:
            mode = 4 if primitive.mode is None else primitive.mode
            if mode < 4 or primitive.attributes.POSITION is None:
                continue
            positions = self.accessor(primitive.attributes.POSITION).astype(float)
            for target, weight in zip(primitive.targets or [], weights):
                number = target.get("POSITION") if isinstance(target, dict) else target.POSITION
                if number is not None:
                    positions += weight * self.accessor(number)
            matrices = self.skin(node, primitive, world, len(positions))
            if matrices is None:
                matrices = np.broadcast_to(own, (len(positions), 4, 4))
            ones = np.concatenate([positions, np.ones((len(positions), 1))], axis=1)
            placed = np.einsum("nij,nj->ni", matrices, ones)[:, :3]
            found.append(placed[self.corners(primitive, mode, len(positions))])
        return found

    def skin(self, node, primitive, world, count):
        if node.skin is None or getattr(primitive.attributes, "JOINTS_0", None) is None:
            return None
        skin = self.gltf.skins[node.skin]
        inverse = np.broadcast_to(np.eye(4), (len(skin.joints), 4, 4))
        if skin.inverseBindMatrices is not None:
            inverse = self.accessor(skin.inverseBindMatrices).reshape(-1, 4, 4).transpose(0, 2, 1).astype(float)
        joints = np.stack([world[joint] @ inverse[k] for k, joint in enumerate(skin.joints)])
        total, matrices = np.zeros(count), np.zeros((count, 4, 4))
        for number in range(8):
            joint = getattr(primitive.attributes, f"JOINTS_{number}", None)
            if joint is None:
                break
            places = self.accessor(joint)
            weights = self.accessor(getattr(primitive.attributes, f"WEIGHTS_{number}")).astype(float)
            matrices += np.einsum("nk,nkij->nij", weights, joints[places])
            total += weights.sum(1)
        return matrices / total[:, None, None]

    def corners(self, primitive, mode, count):
        if primitive.indices is None:
            indices = np.arange(count)
        else:
            indices = self.accessor(primitive.indices)[:, 0].astype(int)
        if mode == 4:
            return indices[: len(indices) // 3 * 3].reshape(-1, 3)
        if mode == 6:
            return np.array([[indices[0], a, b] for a, b in zip(indices[1:], indices[2:])])
        return np.array([indices[k : k + 3] for k in range(len(indices) - 2)])
