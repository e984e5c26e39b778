"""Writes the textured meshes, point clouds and depths in this folder with trimesh, plyfile and
Pillow (see README.md).

    python make-textured.py
"""

from pathlib import Path

import numpy as np
import trimesh
from PIL import Image
from plyfile import PlyData, PlyElement
from trimesh.visual.material import PBRMaterial, SimpleMaterial

here = Path(__file__).parent

# The mesh of make.py, and a picture whose red grows to the right and green downwards: bilinear
# between its pixels, so that colours are linear in the texture coordinates, and these in x and y.
positions = np.array([[0, 0.5, 0.25], [3, 0, 0.5], [3.5, 2, 1], [-0.5, 2.25, 1.5], [1, 3, 0.125]])
triangles = np.array([[0, 1, 2], [0, 2, 3], [3, 2, 4]])
uvs = positions[:, :2] / 5 + 0.2
row, col = np.mgrid[0:8, 0:8]
picture = Image.fromarray(np.dstack([32 * col, 32 * row, 0 * row + 128]).astype(np.uint8))


def textured(material):
    visual = trimesh.visual.TextureVisuals(uv=uvs, material=material)
    return trimesh.Trimesh(positions, triangles, visual=visual, process=False)


def plain(shift):
    """One more triangle, beside the others, of one colour."""
    visual = trimesh.visual.TextureVisuals(
        uv=np.zeros((3, 2)), material=PBRMaterial(baseColorFactor=[255, 51, 0, 255]))
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]]) + [shift, 0, 2.0]
    return trimesh.Trimesh(corners, [[0, 1, 2]], visual=visual, process=False)


# OBJ with its MTL and picture; trimesh gives the names.
text, others = trimesh.exchange.obj.export_obj(
    textured(SimpleMaterial(image=picture, name="sheet")), return_texture=True, mtl_name="textured.mtl")
(here / "textured.obj").write_text(text)
for name, content in others.items():
    (here / name).write_bytes(content)

# GLB with the picture within it; and a scene of two meshes, of which one has a texture.
textured(PBRMaterial(baseColorTexture=picture)).export(here / "textured.glb")
scene = trimesh.Scene([textured(PBRMaterial(baseColorTexture=picture)), plain(4)])
scene.export(here / "half-textured.glb")
# glTF in parts.
for name, content in textured(PBRMaterial(baseColorTexture=picture)).export(file_type="gltf").items():
    (here / ("parts.gltf" if name == "model.gltf" else name)).write_bytes(content)

# PLY with the picture's name in a comment, as MeshLab has it.
fields = [("x", "f4"), ("y", "f4"), ("z", "f4"), ("texture_u", "f4"), ("texture_v", "f4")]
rows = np.array([(*p, *t) for p, t in zip(positions, uvs)], dtype=fields)
faces = np.empty(3, dtype=[("vertex_indices", object)])
faces["vertex_indices"] = list(triangles.astype(np.int32))
PlyData([PlyElement.describe(rows, "vertex"), PlyElement.describe(faces, "face")],
        comments=["TextureFile sheet.png"]).write(here / "textured.ply")

# Point clouds of a slanted plane, on a jittered grid, as scanners' programs write them: floats with
# normals and colours, or doubles far from the origin.
random = np.random.default_rng(1)
grid = np.stack(np.meshgrid(np.arange(30), np.arange(20)), axis=-1).reshape(-1, 2)
xy = grid / 10 + random.uniform(-0.03, 0.03, grid.shape)
cloud = np.column_stack([xy, 0.5 * xy[:, 0] - 0.25 * xy[:, 1] + 1])
shade = np.column_stack([xy[:, 0] / 3, xy[:, 1] / 2, 0 * xy[:, 0]]).clip(0, 1) * 255
trimesh.PointCloud(cloud, colors=shade.round().astype(np.uint8)).export(here / "cloud.ply")
fields = [("x", "f8"), ("y", "f8"), ("z", "f8"), ("nx", "f4"), ("ny", "f4"), ("nz", "f4"), ("intensity", "f4")]
far = cloud + [512000, 5413000, 300]
rows = np.array([(*p, 0, 0, 1, 0.5) for p in far], dtype=fields)
PlyData([PlyElement.describe(rows, "vertex")], text=True).write(here / "cloud-far.ply")

# Depths of a slanted plane, as the TUM data have them: 16 bits, 5000 to the metre, 0 is nothing.
# In the camera's axes (x right, y down, z ahead) the plane is n·p = 2.
fx, fy, cx, cy = 60.0, 62.0, 39.5, 29.5
v, u = np.mgrid[0:60, 0:80]
ray = np.dstack([(u - cx) / fx, (v - cy) / fy, np.ones_like(u)])
depth = 2 / (ray @ np.array([0.36, 0.48, 0.8]))
levels = np.round(5000 * depth).astype(np.uint16)
levels[:5, :7] = 0
Image.fromarray(levels).save(here / "depth-tum.png")
# What the camera has seen in colour.
colour = np.dstack([3 * u, 4 * v, 0 * u + 60]).astype(np.uint8)
Image.fromarray(colour).save(here / "colour-tum.png")
Image.fromarray(colour).save(here / "colour-tum.jpg", quality=95, subsampling=0)
