"""Pictures of glTF files by f3d (https://f3d.app), a viewer that shares nothing with the program."""

import json

import f3d
import numpy as np

SIZE = (320, 240)
# Azimuth and elevation in degrees.
VIEWS = [(0, 0), (40, 25), (160, -30), (270, 10)]
# A pixel differs if a component does by more than this of 255. At an outline, the last bit of a position decides.
LEVELS = 8
MOST = 0.001


def pictures(path, cameras=None):
    """The pictures of a file from all views, or with the cameras of another file, and the cameras."""
    engine = f3d.Engine.create(True)
    engine.window.size = SIZE
    engine.options.update({"ui.axis": False, "render.grid.enable": False, "scene.up_direction": "+Y"})
    engine.scene.add(str(path))
    camera, found, used = engine.window.camera, [], []
    for number, (azimuth, elevation) in enumerate(VIEWS):
        if cameras:
            camera.state = cameras[number]
        else:
            camera.reset_to_default()
            camera.azimuth(azimuth)
            camera.elevation(elevation)
            camera.reset_to_bounds(0.7)
        used.append(camera.state)
        image = engine.window.render_to_image()
        pixels = np.frombuffer(image.content, np.uint8).reshape(image.height, image.width, image.channel_count)
        found.append(pixels.astype(int))
    return found, used


def difference(path, other):
    """The largest part of a picture that differs, and the largest part that is drawn."""
    own, cameras = pictures(path)
    others, _ = pictures(other, cameras)
    parts = [float((abs(a - b).max(-1) > LEVELS).mean()) for a, b in zip(own, others)]
    drawn = [float((a != a[0, 0]).any(-1).mean()) for a in own]
    return max(parts), max(drawn)


def without_materials(path, other):
    """Writes a .gltf without its materials, and says whether it had one that colours."""
    document = json.loads(path.read_text())
    coloured = [m for m in document.get("materials", []) if "baseColor" in json.dumps(m.get("pbrMetallicRoughness", {}))]
    for mesh in document["meshes"]:
        for primitive in mesh["primitives"]:
            primitive.pop("material", None)
    other.write_text(json.dumps(document))
    return bool(coloured)
