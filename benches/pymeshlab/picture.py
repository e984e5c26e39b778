"""The README's picture of a whole oloid, noisy and found.

    env/bin/python benches/pymeshlab/picture.py target/release/examples/surface docs/oloid.png
"""

import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

import numpy as np

from compare import load
from whole import Truth, hull, noisy, remeshed, save

SIZE, FINER = 380, 3
LIGHT = np.array([-0.45, 0.55, 0.7]) / np.linalg.norm([-0.45, 0.55, 0.7])


def oloid():
    """The hull of two circles in planes at right angles, each through the centre of the other."""
    t = np.linspace(0, 2 * np.pi, 1501)[:-1]
    return hull(np.vstack([np.c_[np.cos(t) - 0.5, np.sin(t), 0 * t], np.c_[np.cos(t) + 0.5, 0 * t, np.sin(t)]]))


def turned(vertices):
    a, b = np.radians(35), np.radians(-28)
    around = np.array([[np.cos(a), 0, np.sin(a)], [0, 1, 0], [-np.sin(a), 0, np.cos(a)]])
    down = np.array([[1, 0, 0], [0, np.cos(b), -np.sin(b)], [0, np.sin(b), np.cos(b)]])
    return vertices @ around.T @ down.T


def drawn(vertices, faces):
    """Seen along -z, each triangle in one shade; white where there is none."""
    side = SIZE * FINER
    places = vertices[:, :2] * [1, -1] * side / 3.5 + side / 2
    depth, image = np.full((side, side), -np.inf), np.full((side, side), 255.0)
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    shades = 40 + 190 * np.clip(normals @ LIGHT, 0, 1) ** 0.9
    for face, shade in zip(faces[normals[:, 2] > 0], shades[normals[:, 2] > 0]):
        p, z = places[face], vertices[face, 2]
        low, high = np.floor(p.min(axis=0)).astype(int), np.ceil(p.max(axis=0)).astype(int) + 1
        x, y = np.meshgrid(np.arange(low[0], high[0]), np.arange(low[1], high[1]))
        (ux, uy), (vx, vy) = p[1] - p[0], p[2] - p[0]
        area = ux * vy - uy * vx
        if area == 0:
            continue
        s = ((x - p[0, 0]) * vy - (y - p[0, 1]) * vx) / area
        t = (ux * (y - p[0, 1]) - uy * (x - p[0, 0])) / area
        at = z[0] + s * (z[1] - z[0]) + t * (z[2] - z[0])
        inside = (s >= -1e-9) & (t >= -1e-9) & (s + t <= 1 + 1e-9) & (at > depth[y, x])
        depth[y[inside], x[inside]], image[y[inside], x[inside]] = at[inside], shade
    return image.reshape(SIZE, FINER, SIZE, FINER).mean(axis=(1, 3))


def png(path, image):
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    height, width = image.shape
    rows = b"".join(b"\0" + row.tobytes() for row in image.round().astype(np.uint8))
    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    parts = [chunk(b"IHDR", header), chunk(b"IDAT", zlib.compress(rows, 9)), chunk(b"IEND", b"")]
    Path(path).write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(parts))


def main(program, path):
    truth = Truth(*remeshed(*oloid(), 12000))
    rough = noisy(truth, 0.006, "normals", 1)
    with tempfile.TemporaryDirectory() as folder:
        before, after = f"{folder}/before.ply", f"{folder}/after.ply"
        save(before, rough, truth.faces)
        subprocess.run([program, before, after], check=True, stdout=subprocess.DEVNULL)
        found = load(after)[0]
    png(path, np.hstack([drawn(turned(v), truth.faces) for v in (rough, found)]))


if __name__ == "__main__":
    main(*sys.argv[1:])
