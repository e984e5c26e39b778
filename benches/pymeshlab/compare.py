"""Scenes smoothed by pymeshlab, each filter with the parameters that are best by the truth, beside ours
without any.

    cargo run --release --example scenes -- meshes FOLDER
    python -m venv env && env/bin/pip install -r benches/pymeshlab/requirements.txt
    env/bin/python benches/pymeshlab/compare.py FOLDER > benches/pymeshlab.md

`--scenes N` takes the first N scenes only, `--json FILE` writes the ratios to a file besides; `npm run bench -- --peers` does
all of this.

The filters move vertices in all directions and keep their triangles, so vertices are compared one by one:
the mean angle between their normals and the true ones, and the root mean square of their distances from
the true tangent planes. Vertices on the border, and next to it, do not count.
"""

import argparse
import json
import sys
import time
from importlib.metadata import version
from itertools import product
from pathlib import Path

import numpy as np
import pymeshlab

STEPS = [1, 2, 4, 8, 16, 32, 64, 128, 256, 512]

# Filters, their parameters and the values that are tried.
FILTERS = {
    "Laplacian": ("apply_coord_laplacian_smoothing", {"stepsmoothnum": STEPS, "cotangentweight": [False, True]}),
    "Taubin": ("apply_coord_taubin_smoothing", {"stepsmoothnum": STEPS}),
    "two-step": (
        "apply_coord_two_steps_smoothing",
        {"stepsmoothnum": [1, 2, 4, 8, 16], "normalthr": [20.0, 60.0, 120.0]},
    ),
    "Stein et al. 2018": (
        "apply_coord_developability_of_mesh",
        {"maxfunevals": [10, 30, 100, 300], "edgeflips": [False], "edgecollapses": [False]},
    ),
}


def normals(vertices, faces):
    """Of vertices: the sum of their triangles' area vectors, upwards, of unit length."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    areas = np.cross(b - a, c - a)
    total = np.zeros_like(vertices)
    for k in range(3):
        np.add.at(total, faces[:, k], areas)
    total *= np.sign(total[:, 2:])
    return total / np.linalg.norm(total, axis=1, keepdims=True)


def inner(faces, count):
    """Which vertices are neither on the border nor beside it."""
    edges = np.sort(np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    unique, uses = np.unique(edges, axis=0, return_counts=True)
    near = np.zeros(count, bool)
    near[unique[uses == 1]] = True
    near[faces[near[faces].any(axis=1)]] = True
    return ~near


class Truth:
    def __init__(self, path):
        self.vertices, self.faces = load(path)
        self.normals = normals(self.vertices, self.faces)
        self.inner = inner(self.faces, len(self.vertices))

    def errors(self, vertices):
        """In degrees, and in the mesh's units."""
        found = normals(vertices, self.faces)[self.inner]
        true = self.normals[self.inner]
        angles = np.degrees(2 * np.arcsin(np.clip(np.linalg.norm(found - true, axis=1) / 2, 0, 1)))
        distances = ((vertices - self.vertices)[self.inner] * true).sum(axis=1)
        return np.array([angles.mean(), np.sqrt((distances**2).mean())])


def load(path):
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(path))
    mesh = meshes.current_mesh()
    return mesh.vertex_matrix(), mesh.face_matrix()


def best(path, truth, name, grid):
    """The least of each error over all values of the parameters, and the seconds that the best normals took."""
    least, seconds = np.full(2, np.inf), np.nan
    for values in product(*grid.values()):
        meshes = pymeshlab.MeshSet()
        meshes.load_new_mesh(str(path))
        start = time.perf_counter()
        try:
            meshes.apply_filter(name, **dict(zip(grid, values)))
        except pymeshlab.PyMeshLabException:
            continue
        spent = time.perf_counter() - start
        vertices = meshes.current_mesh().vertex_matrix()
        if vertices.shape != truth.vertices.shape or not np.isfinite(vertices).all():
            continue
        errors = truth.errors(vertices)
        if errors[0] < least[0]:
            seconds = spent
        least = np.minimum(least, errors)
    return least, seconds


def main(folder, count, summary):
    scenes = json.loads((folder / "scenes.json").read_text())[:count]
    print("# Beside pymeshlab\n")
    print(
        "Written by `benches/pymeshlab/compare.py`, which says what is compared. Each filter has the parameters "
        f"that are best by the truth, for normals and distances apart; ours (`huber`, λ by itself) has none. "
        f"pymeshlab {version('pymeshlab')}; "
        f"{scenes[0]['vertices']:,} vertices each; seconds on one machine that had other work as well, of pymeshlab's native code and of our "
        "native build, the search for λ included.\n"
    )
    names = ["ours", *FILTERS]
    print("| scene | noise | " + " | ".join(f"{name}, °" for name in names) + " |")
    print("| :--- | :--- |" + " ---: |" * len(names))
    table = []
    for scene in scenes:
        truth = Truth(folder / scene["truth"])
        rows = [(truth.errors(load(folder / scene["ours"])[0]), scene["seconds"])]
        for name, grid in FILTERS.values():
            rows.append(best(folder / scene["noisy"], truth, name, grid))
        table.append(rows)
        print(f"| {scene['name']} | {scene['noise']} | " + " | ".join(f"{e[0]:.2f}" for e, _ in rows) + " |")
        print(scene["name"], scene["noise"], file=sys.stderr)
    errors = np.array([[e for e, _ in rows] for rows in table])
    seconds = np.array([[s for _, s in rows] for rows in table])
    ratios = np.exp(np.log(errors[:, :1] / errors[:, 1:]).mean(axis=0))
    worst = (errors[:, :1] / errors[:, 1:]).max(axis=0)
    print("\nOurs over theirs, geometric means and the largest, and the mean of seconds:\n")
    print("| | normals | largest | distances | largest | seconds | ours |")
    print("| :--- | ---: | ---: | ---: | ---: | ---: | ---: |")
    filters = [
        {
            "name": name,
            "normals": {"mean": ratios[k][0], "largest": worst[k][0]},
            "distances": {"mean": ratios[k][1], "largest": worst[k][1]},
            "seconds": np.nanmean(seconds[:, k + 1]),
            "ours": seconds[:, 0].mean(),
        }
        for k, name in enumerate(FILTERS)
    ]
    for found in filters:
        parts = [found[of][figure] for of in ("normals", "distances") for figure in ("mean", "largest")]
        print(f"| {found['name']} | " + " | ".join(f"{x:.2f}" for x in [*parts, found["seconds"], found["ours"]]) + " |")
    if summary:
        summary.write_text(json.dumps({"version": version("pymeshlab"), "filters": filters}))


if __name__ == "__main__":
    arguments = argparse.ArgumentParser()
    arguments.add_argument("folder", type=Path)
    arguments.add_argument("--scenes", type=int)
    arguments.add_argument("--json", type=Path)
    given = arguments.parse_args()
    main(given.folder, given.scenes, given.json)
