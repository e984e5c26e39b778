"""Whole meshes smoothed by pymeshlab, each filter with the parameters that are best by the truth, beside
`fit_mesh` without any.

    cargo build --release --example surface
    python -m venv env && env/bin/pip install -r benches/pymeshlab/requirements.txt
    env/bin/python benches/pymeshlab/whole.py target/release/examples/surface 2000:0.5:normals:3 2000:1:all:3

makes the rows of benches/whole.md: vertices, noise in per cent of the diagonal, along normals or in all
directions, and how many seeds. Figures are means over the seeds, ratios and what is lost the worst of them.
With `--stein` the flow of Stein et al. is among the filters, which takes minutes for each row.

The shapes are made here and remeshed to uneven triangles with the creases kept. Noise is along the normals or
in all directions, as a share of the diagonal. What is told: the root mean square of the vertices' distances
from the true surface (in thousandths of the diagonal), the mean angle between the triangles' normals and the
true ones, and the share of the fold angle that is kept: between the mean normals of up to three rings of
triangles on either side of each crease.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import pymeshlab

from compare import FILTERS, load

DIAGONAL = 1e3


def grid(f, columns, rows, flipped=None):
    """The triangles of a map from the unit square."""
    u, v = np.meshgrid(np.linspace(0, 1, columns + 1), np.linspace(0, 1, rows + 1), indexing="ij")
    at = np.arange(u.size).reshape(u.shape)
    a, b, c, d = (x.ravel() for x in (at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:]))
    turn = np.zeros(len(a), bool) if flipped is None else flipped(u[:-1, :-1].ravel(), v[:-1, :-1].ravel())
    faces = [np.c_[a, b, c][~turn], np.c_[a, c, d][~turn], np.c_[a, b, d][turn], np.c_[b, c, d][turn]]
    return f(u.ravel(), v.ravel()), np.vstack(faces)


def joined(parts):
    first = np.cumsum([0] + [len(p) for p, _ in parts])
    return np.vstack([p for p, _ in parts]), np.vstack([f + n for (_, f), n in zip(parts, first)])


def circle(radius, z, x=0, y=0):
    return lambda u: np.c_[x + radius * np.cos(2 * np.pi * u), y + radius * np.sin(2 * np.pi * u), z + 0 * u]


def between(a, b, columns=720, rows=20):
    return grid(lambda u, v: (1 - v)[:, None] * a(u) + v[:, None] * b(u), columns, rows)


def disk(radius, z, x=0, y=0):
    return between(circle(0, z, x, y), circle(radius, z, x, y), 720, 24)


def hull(points):
    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(points))
    meshes.generate_convex_hull()
    return meshes.current_mesh().vertex_matrix(), meshes.current_mesh().face_matrix()


def d_form():
    """The hull of a closed curve in space: two developable sheets glued along their borders."""
    t = np.linspace(0, 2 * np.pi, 2001)[:-1]
    x, y = np.cos(t) + 0.12 * np.cos(3 * t), 1.2 * (np.sin(t) - 0.12 * np.sin(3 * t))
    return hull(np.c_[x, y, 0.55 * np.sin(2 * t)])


def oblique_cone():
    top = (0.45, 1.4, 0.7, 0.2)
    return joined([between(circle(1, 0), circle(*top)), disk(1, 0), disk(*top)])


def groin_vault():
    """Two barrels that cross, on four walls, open below."""
    arch = lambda x: np.sqrt(np.maximum(1.2 - x * x, 0))
    place = lambda u, v: np.c_[2 * u - 1, 2 * v - 1, np.maximum(arch(2 * u - 1), arch(2 * v - 1))]
    parts = [grid(place, 320, 320, lambda u, v: (u < 0.499) != (v < 0.499))]
    for along, side in ((0, 1), (0, -1), (1, 1), (1, -1)):

        def wall(u, v, along=along, side=side):
            x, z = 2 * u - 1, (1 - v) * np.maximum(arch(1), arch(2 * u - 1)) - 0.6 * v
            return np.c_[x, 0 * x + side, z][:, [1, 0, 2] if along == 0 else [0, 1, 2]]

        parts.append(grid(wall, 320, 20))
    return joined(parts)


def ribbon():
    """A strip that bends over itself and is folded once."""
    u = np.linspace(0, 1, 801)
    angle = np.where(u < 0.5, -0.3 + 7.2 * u, 1.9 - 4.8 * (u - 0.5))
    middle = (angle[1:] + angle[:-1]) / 2
    x, z = (np.r_[0, np.cumsum(f(middle))] * 3 / 800 for f in (np.cos, np.sin))
    at = lambda u: np.round(800 * u).astype(int)
    return grid(lambda u, v: np.c_[x[at(u)], v, z[at(u)]], 800, 40)


def part():
    """A machined block: planes, a rounded corner and a step."""
    t = np.linspace(0, np.pi / 2, 60)
    arc = np.c_[1.4 + 0.6 * np.cos(t), 0.5 + 0.6 * np.sin(t)]
    outline = np.vstack([[[0, 0], [2, 0]], arc, [[0.8, 1.1], [0.8, 1.6], [0.3, 1.9], [0, 1.9]]])
    inner = np.array([0.5, 0.6])
    n = len(outline)
    whole = np.vstack([np.c_[outline, 0 * outline[:, :1]], np.c_[outline, 0 * outline[:, :1] + 0.9]])
    middles = np.array([[*inner, 0], [*inner, 0.9]])
    i, j = np.arange(n), (np.arange(n) + 1) % n
    sides = [np.c_[i, j, n + j], np.c_[i, n + j, n + i]]
    lids = [np.c_[0 * i + 2 * n, j, i], np.c_[0 * i + 2 * n + 1, n + i, n + j]]
    return np.vstack([whole, middles]), np.vstack(sides + lids)


def cut_tube():
    def place(u, v):
        x, y = np.cos(2 * np.pi * u), np.sin(2 * np.pi * u)
        return np.c_[x, y, (1 - v) * (0.5 * x - 1) + v * (1.2 + 0.3 * y - 0.2 * x)]

    return grid(place, 720, 60)


SHAPES = {
    "D-form": d_form,
    "oblique cone": oblique_cone,
    "groin vault": groin_vault,
    "folded ribbon": ribbon,
    "machined part": part,
    "tube, cut aslant": cut_tube,
}


def remeshed(vertices, faces, count):
    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(vertices, faces))
    near = 1e-6 * np.linalg.norm(np.ptp(vertices, axis=0))
    meshes.meshing_merge_close_vertices(threshold=pymeshlab.PureValue(near))
    meshes.meshing_remove_null_faces()
    meshes.meshing_remove_unreferenced_vertices()
    meshes.meshing_re_orient_faces_coherently()
    area = meshes.get_geometric_measures()["surface_area"]
    length = pymeshlab.PureValue(np.sqrt(2 / np.sqrt(3) * area / count))
    for iterations in (8, 5):
        meshes.meshing_isotropic_explicit_remeshing(
            iterations=iterations, targetlen=length, featuredeg=25, checksurfdist=False
        )
    meshes.meshing_remove_unreferenced_vertices()
    mesh = meshes.current_mesh()
    return mesh.vertex_matrix(), mesh.face_matrix()


def area_vectors(vertices, faces):
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    return np.cross(b - a, c - a) / 2


def unit(vectors):
    return vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-300)


def vertex_normals(vertices, faces):
    sums = np.zeros_like(vertices)
    for k in range(3):
        np.add.at(sums, faces[:, k], area_vectors(vertices, faces))
    return unit(sums)


class Truth:
    def __init__(self, vertices, faces):
        self.vertices, self.faces = vertices, faces
        self.diagonal = np.linalg.norm(np.ptp(vertices, axis=0))
        self.normals = unit(area_vectors(vertices, faces))
        self.areas = np.linalg.norm(area_vectors(vertices, faces), axis=1)
        edges = np.sort(np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
        owner = np.tile(np.arange(len(faces)), 3)
        order = np.lexsort(edges.T[::-1])
        edges, owner = edges[order], owner[order]
        twin = np.flatnonzero((edges[1:] == edges[:-1]).all(axis=1))
        pairs = np.c_[owner[twin], owner[twin + 1]]
        cosine = (self.normals[pairs[:, 0]] * self.normals[pairs[:, 1]]).sum(axis=1)
        creased = cosine < np.cos(np.radians(25))
        beside = [[] for _ in faces]
        for a, b in pairs[~creased]:
            beside[a].append(b)
            beside[b].append(a)
        creases = pairs[creased]
        self.creased = np.unique(edges[twin[creased]])
        some = np.random.default_rng(0).permutation(len(creases))[:400]
        self.sides = [[self.grown(beside, face) for face in creases[i]] for i in some]

    @staticmethod
    def grown(beside, face):
        found, front = {face}, [face]
        for _ in range(3):
            front = [g for f in front for g in beside[f] if g not in found and not found.add(g)]
        return sorted(found)

    def folds(self, vertices):
        area = area_vectors(vertices, self.faces)
        means = [[area[side].sum(axis=0) for side in sides] for sides in self.sides]
        return np.array([np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b) for a, b in means])

    def kept(self, vertices):
        if not self.sides:
            return np.nan
        true = self.folds(self.vertices)
        clear = true > np.radians(15)
        return (self.folds(vertices)[clear] / true[clear]).mean()

    def errors(self, vertices):
        meshes = pymeshlab.MeshSet()
        meshes.add_mesh(pymeshlab.Mesh(vertices, self.faces))
        meshes.add_mesh(pymeshlab.Mesh(self.vertices, self.faces))
        distance = meshes.get_hausdorff_distance(
            sampledmesh=0, targetmesh=1, samplevert=True, sampleedge=False, sampleface=False,
            samplenum=len(vertices), maxdist=pymeshlab.PercentageValue(50),
        )
        normals = unit(area_vectors(vertices, self.faces))
        angles = np.degrees(np.arccos(np.clip((normals * self.normals).sum(axis=1), -1, 1)))
        return np.array([DIAGONAL * distance["RMS"] / self.diagonal, (angles * self.areas).sum() / self.areas.sum()])


def noisy(truth, share, kind, seed):
    random = np.random.default_rng(seed)
    sigma = share * truth.diagonal
    if kind == "normals":
        along = vertex_normals(truth.vertices, truth.faces)
        return truth.vertices + sigma * random.standard_normal(len(truth.vertices))[:, None] * along
    return truth.vertices + sigma * random.standard_normal(truth.vertices.shape)


def save(path, vertices, faces):
    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(vertices, faces))
    meshes.save_current_mesh(str(path), binary=True, save_vertex_color=False, save_vertex_quality=False,
                             save_vertex_normal=False, save_face_color=False)


def oracle(path, truth):
    """The least of each error over all filters and values of their parameters."""
    from itertools import product

    least = {}
    for title, (name, values) in FILTERS.items():
        least[title] = np.full(2, np.inf)
        for chosen in product(*values.values()):
            meshes = pymeshlab.MeshSet()
            meshes.load_new_mesh(str(path))
            try:
                meshes.apply_filter(name, **dict(zip(values, chosen)))
            except pymeshlab.PyMeshLabException:
                continue
            vertices = meshes.current_mesh().vertex_matrix()
            if vertices.shape == truth.vertices.shape and np.isfinite(vertices).all():
                least[title] = np.minimum(least[title], truth.errors(vertices))
    return least


def angle_defects(vertices, faces):
    """Gaussian curvature at vertices by what angles lack of a full turn, and each vertex's share of the area."""
    turns, areas = np.full(len(vertices), 2 * np.pi), np.zeros(len(vertices))
    own = np.linalg.norm(area_vectors(vertices, faces), axis=1) / 3
    for k in range(3):
        a, b, c = (vertices[faces[:, (k + i) % 3]] for i in range(3))
        along = np.arctan2(np.linalg.norm(np.cross(b - a, c - a), axis=1), ((b - a) * (c - a)).sum(axis=1))
        np.subtract.at(turns, faces[:, k], along)
        np.add.at(areas, faces[:, k], own)
    return turns / np.maximum(areas, 1e-300), areas


def curved(truth, vertices, rings=3, threshold=1.0):
    """The share of the area that is curved in both directions: |K| above the paper's threshold where the
    surface has the size 1, no nearer to creases and the border than some rings."""
    faces = truth.faces
    edges = np.sort(np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    unique, uses = np.unique(edges, axis=0, return_counts=True)
    near = np.zeros(len(vertices), bool)
    near[unique[uses == 1]] = True
    near[truth.creased] = True
    for _ in range(rings):
        near[faces[near[faces].any(axis=1)]] = True
    size = np.linalg.norm(vertices - vertices.mean(axis=0), axis=1).max() * 2
    found, areas = angle_defects(vertices / size, faces)
    return areas[~near & (np.abs(found) > threshold)].sum() / max(areas[~near].sum(), 1e-300)


def crossings(vertices, faces):
    """How many triangles cross others."""
    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(vertices, faces))
    meshes.compute_selection_by_self_intersections_per_face()
    return meshes.current_mesh().selected_face_number()


def main(program, rows, stein):
    """Each of the `rows` is a number of vertices, the noise in per cent, its kind and how many seeds."""
    if not stein:
        del FILTERS["Stein et al. 2018"]
    print("| shape | vertices | noise | distance, ‰ | | normals, ° | | fold kept | curved, % | folded | crossing | seconds |")
    print("| :--- | ---: | :--- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    ratios = []
    with tempfile.TemporaryDirectory() as folder:
        before, after = Path(folder) / "before.ply", Path(folder) / "after.ply"
        for row in rows:
            count, percent, kind, seeds = row.split(":")
            for shape, make in SHAPES.items():
                truth = Truth(*remeshed(*make(), int(count)))
                figures, names = [], []
                for seed in range(1, int(seeds) + 1):
                    save(before, noisy(truth, float(percent) / 100, kind, seed), truth.faces)
                    done = subprocess.run([program, before, after], capture_output=True, text=True, check=True)
                    report = json.loads(done.stdout)
                    vertices = load(after)[0]
                    ours, theirs = truth.errors(vertices), oracle(before, truth)
                    best = [min(theirs, key=lambda t: theirs[t][k]) for k in range(2)]
                    names.append(best)
                    least = [theirs[best[k]][k] for k in range(2)]
                    figures.append([
                        *ours, *least, *(ours / least), truth.kept(vertices), 100 * curved(truth, vertices),
                        report["flipped"][1], crossings(vertices, truth.faces), report["seconds"]["total"],
                    ])
                figures = np.array(figures)
                mean, most = figures.mean(axis=0), figures.max(axis=0)
                ratios += [(k, r) for k in range(2) for r in figures[:, 4 + k]]
                kept = figures[:, 6].min()
                own = 100 * curved(truth, truth.vertices)
                where = "along normals" if kind == "normals" else "in all directions"
                print(
                    f"| {shape} | {len(truth.vertices):,} | {percent} % {where} "
                    + "".join(
                        f"| {mean[k]:.2f}, {mean[2 + k]:.2f} ({names[0][k]}) | {most[4 + k]:.2f} " for k in range(2)
                    )
                    + f"| {'' if np.isnan(kept) else f'{kept:.2f}'} | {most[7]:.1f} ({own:.1f}) | {most[8]:.0f} | {most[9]:.0f} | {mean[10]:.2f} |",
                    flush=True,
                )
    for k, name in enumerate(["distances", "normals"]):
        own = [r for i, r in ratios if i == k]
        print(f"\nOurs over the best of theirs, {name}: {np.exp(np.mean(np.log(own))):.2f} (geometric mean), {max(own):.2f} at most.")


if __name__ == "__main__":
    main(sys.argv[1], [arg for arg in sys.argv[2:] if arg != "--stein"], "--stein" in sys.argv)
