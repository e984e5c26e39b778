"""Writes the files in this folder with trimesh, plyfile, numpy-stl and pygltflib (see README.md).

    python make.py
"""

from pathlib import Path

import numpy as np
import pygltflib
import trimesh
from plyfile import PlyData, PlyElement
from stl import Mode
from stl.mesh import Mesh as StlMesh

here = Path(__file__).parent

# A quad and a triangle above it: no symmetry, no two coordinates of a vertex alike.
positions = np.array([[0, 0.5, 0.25], [3, 0, 0.5], [3.5, 2, 1], [-0.5, 2.25, 1.5], [1, 3, 0.125]])
triangles = np.array([[0, 1, 2], [0, 2, 3], [3, 2, 4]])
colors = np.array([[255, 0, 51], [0, 102, 0], [0, 0, 255], [153, 153, 0], [10, 20, 30]], np.uint8)
uvs = positions[:, :2] / 4 + 0.25

# trimesh, which splits polygons itself.
mesh = trimesh.Trimesh(positions, triangles, vertex_colors=colors, process=False)
mesh.export(here / "colours.obj")
mesh.export(here / "trimesh-binary.ply")
(here / "trimesh-ascii.ply").write_bytes(mesh.export(file_type="ply", encoding="ascii"))
plain = trimesh.Trimesh(positions, triangles, process=False)
plain.export(here / "binary.stl")
(here / "ascii.stl").write_text(plain.export(file_type="stl_ascii"))
# A node's transform: a quarter turn about z, twice the size, and a shift.
turned = np.array([[0, -2, 0, 10], [2, 0, 0, 20], [0, 0, 2, 30], [0, 0, 0, 1]], float)
scene = trimesh.Scene()
scene.add_geometry(mesh, transform=turned)
scene.export(here / "turned.glb")

# plyfile: polygons, doubles, both byte orders.
fields = [("x", "f8"), ("y", "f8"), ("z", "f8"), ("red", "u1"), ("green", "u1"), ("blue", "u1")]
rows = np.array([(*p, *c) for p, c in zip(positions, colors)], dtype=fields)
faces = np.empty(2, dtype=[("vertex_index", object)])
faces["vertex_index"] = [np.array([0, 1, 2, 3], np.int32), np.array([3, 2, 4], np.int32)]
vertex, face = PlyElement.describe(rows, "vertex"), PlyElement.describe(faces, "face")
edges = PlyElement.describe(np.array([(0, 1), (2, 3)], dtype=[("vertex1", "i4"), ("vertex2", "i4")]), "edge")
PlyData([vertex, edges, face], text=True).write(here / "polygons-ascii.ply")
PlyData([vertex, edges, face], byte_order="<").write(here / "polygons-le.ply")
PlyData([vertex, edges, face], byte_order=">").write(here / "polygons-be.ply")
PlyData([vertex], byte_order="<").write(here / "points.ply")

# numpy-stl, which begins its binary files as ASCII ones would.
stl = StlMesh(np.zeros(3, dtype=StlMesh.dtype), name=b"solid like ASCII")
stl.vectors[:] = positions[triangles]
stl.save(str(here / "numpy-ascii.stl"), mode=Mode.ASCII)
stl.save(str(here / "numpy-binary.stl"), mode=Mode.BINARY)
binary = bytearray((here / "numpy-binary.stl").read_bytes())
binary[:80] = b"solid like ASCII".ljust(80)
(here / "numpy-binary.stl").write_bytes(binary)


# pygltflib: interleaved strips and fans, short indices, two nodes above one another.
def gltf(mode, order, extensions=None):
    vertices = np.hstack([positions, uvs]).astype("<f4").tobytes()
    indices = np.array(order, "<u2").tobytes()
    out = pygltflib.GLTF2(
        scene=0,
        scenes=[pygltflib.Scene(nodes=[0])],
        nodes=[
            pygltflib.Node(children=[1], translation=[10, 20, 30], scale=[2, 2, 2]),
            pygltflib.Node(mesh=0, rotation=[0, 0, np.sqrt(0.5), np.sqrt(0.5)]),
        ],
        meshes=[pygltflib.Mesh(primitives=[pygltflib.Primitive(
            attributes=pygltflib.Attributes(POSITION=0, TEXCOORD_0=1), indices=2, mode=mode)])],
        accessors=[
            pygltflib.Accessor(bufferView=0, componentType=pygltflib.FLOAT, count=5, type="VEC3",
                               min=positions.min(0).tolist(), max=positions.max(0).tolist()),
            pygltflib.Accessor(bufferView=0, byteOffset=12, componentType=pygltflib.FLOAT, count=5,
                               type="VEC2"),
            pygltflib.Accessor(bufferView=1, componentType=pygltflib.UNSIGNED_SHORT,
                               count=len(order), type="SCALAR"),
        ],
        bufferViews=[
            pygltflib.BufferView(buffer=0, byteLength=len(vertices), byteStride=20),
            pygltflib.BufferView(buffer=0, byteOffset=len(vertices), byteLength=len(indices)),
        ],
        buffers=[pygltflib.Buffer(byteLength=len(vertices) + len(indices))],
    )
    if extensions:
        out.extensionsUsed = out.extensionsRequired = extensions
    out.set_binary_blob(vertices + indices)
    return out


gltf(pygltflib.TRIANGLE_STRIP, [1, 0, 2, 3, 4]).save(str(here / "strip.glb"))
gltf(pygltflib.TRIANGLE_FAN, [2, 3, 0, 1]).save(str(here / "fan.glb"))
embedded = gltf(pygltflib.TRIANGLES, triangles.ravel())
embedded.convert_buffers(pygltflib.BufferFormat.DATAURI)
embedded.save(str(here / "embedded.gltf"))
gltf(pygltflib.TRIANGLES, triangles.ravel(), ["KHR_draco_mesh_compression"]).save(str(here / "draco.glb"))
