"""Draws the pictures of delaunay.md from what the library answers through its C ABI.

usage: delaunay_pictures.py [LIBRADVOR.so]    writes beside this file; the library of the release build by default
"""

import ctypes
import pathlib
import random
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import LineCollection, PolyCollection
from PIL import Image

HERE = pathlib.Path(__file__).resolve().parent
BORDER, DISCONTINUOUS = 1, 2


class Delaunay:
    def __init__(self, library):
        self.library = library
        self.context = ctypes.c_void_p()
        self.handle = ctypes.c_void_p()
        self.must(library.radvor_context_create(None, ctypes.byref(self.context)))
        self.must(library.radvor_delaunay_create(self.context, ctypes.byref(self.handle)))

    @staticmethod
    def must(result):
        if result != 0:
            raise RuntimeError(f"radvor result {result}")

    def insert(self, x, y):
        vertex = ctypes.c_uint32()
        self.must(self.library.radvor_delaunay_insert(self.handle, ctypes.c_double(x), ctypes.c_double(y),
                                                      ctypes.byref(vertex)))
        return vertex.value

    def constrain(self, a, b, flags):
        self.must(self.library.radvor_delaunay_constrain_as(self.handle, a, b, flags, 0))

    def mark_domain(self):
        self.must(self.library.radvor_delaunay_mark_domain(self.handle))

    def realign_to(self, values):
        array = (ctypes.c_double * len(values))(*values)
        self.must(self.library.radvor_delaunay_set_values(self.handle, array, 0, len(values)))
        self.must(self.library.radvor_delaunay_realign(self.handle))

    def position(self, vertex):
        xy = (ctypes.c_double * 2)()
        self.must(self.library.radvor_delaunay_position(self.handle, vertex, xy))
        return xy[0], xy[1]

    def triangles(self, inside_only=False):
        count = self.library.radvor_delaunay_triangle_count(self.handle)
        indices = (ctypes.c_uint32 * (3 * count))()
        inside = (ctypes.c_uint8 * count)()
        self.must(self.library.radvor_delaunay_triangles(self.handle, indices, count))
        self.must(self.library.radvor_delaunay_inside(self.handle, inside, count))
        return [tuple(indices[3 * t:3 * t + 3]) for t in range(count) if inside[t] or not inside_only]

    def constraints(self):
        count = ctypes.c_uint32()
        self.must(self.library.radvor_delaunay_constraints(self.handle, None, ctypes.byref(count)))
        pairs = (ctypes.c_uint32 * (2 * count.value))()
        self.must(self.library.radvor_delaunay_constraints(self.handle, pairs, ctypes.byref(count)))
        return [(pairs[2 * i], pairs[2 * i + 1]) for i in range(count.value)]

    def bounded_cell(self, vertex):
        """One polygon a sector."""
        sectors = ctypes.c_uint32()
        self.must(self.library.radvor_delaunay_bounded_cell(self.handle, vertex, 0, ctypes.byref(sectors), None, None,
                                                            None, None))
        polygons = []
        for sector in range(sectors.value):
            size = ctypes.c_uint32(64)
            polygon = (ctypes.c_double * 128)()
            self.must(self.library.radvor_delaunay_bounded_cell(self.handle, vertex, sector, None, polygon,
                                                                ctypes.byref(size), None, None))
            polygons.append([(polygon[2 * i], polygon[2 * i + 1]) for i in range(size.value)])
        return polygons


def edges(triangles):
    return {tuple(sorted(pair)) for a, b, c in triangles for pair in ((a, b), (b, c), (c, a))}


def bare(axes):
    axes.set_aspect("equal")
    axes.axis("off")


def draw_cells(library):
    """A domain with a hole and a slit: its triangulation, and the bounded Voronoi cells dual to it."""
    d = Delaunay(library)
    outline = [(0, 0), (8, -0.5), (10, 3), (6.4, 3.6), (9.5, 8), (4, 7), (1, 9), (2, 4)]
    hole = [(3.5, 2), (3, 3), (4, 4), (5, 2.5)]
    for ring in (outline, hole):
        ids = [d.insert(*point) for point in ring]
        for i, a in enumerate(ids):
            d.constrain(a, ids[(i + 1) % len(ids)], BORDER)
    d.constrain(d.insert(5, 5), d.insert(6.5, 6.5), DISCONTINUOUS)
    d.mark_domain()

    def is_inside(x, y, ring):
        inside = False
        for (ax, ay), (bx, by) in zip(ring, ring[1:] + ring[:1]):
            if (ay > y) != (by > y) and x < ax + (y - ay) / (by - ay) * (bx - ax):
                inside = not inside
        return inside

    generator = random.Random(4)
    vertices = len(outline) + len(hole) + 2
    while vertices < 60:
        x, y = generator.uniform(0, 10), generator.uniform(-0.5, 9)
        if is_inside(x, y, outline) and not is_inside(x, y, hole):
            d.insert(x, y)
            vertices += 1

    figure, both = plt.subplots(1, 2, figsize=(9, 4.4), dpi=100)
    points = [d.position(v) for v in range(vertices)]
    triangulation = [[points[a], points[b]] for a, b in edges(d.triangles(inside_only=True))]
    walls = [[points[a], points[b]] for a, b in d.constraints()]
    cells = [polygon for v in range(vertices) for polygon in d.bounded_cell(v)]
    both[0].set_title("triangles", fontsize=10)
    both[0].add_collection(LineCollection(triangulation, colors="#4c78a8", linewidths=0.9))
    both[1].set_title("cells: nearest vertex in sight", fontsize=10)
    shades = [plt.cm.Pastel1(i % 9) for i in range(len(cells))]
    both[1].add_collection(PolyCollection(cells, facecolors=shades, edgecolors="#d1605e", linewidths=0.9))
    both[1].add_collection(LineCollection(triangulation, colors="#4c78a8", linewidths=0.4, alpha=0.6))
    for axes in both:
        axes.add_collection(LineCollection(walls, colors="black", linewidths=1.8))
        axes.plot(*zip(*points), "k.", markersize=4)
        bare(axes)
    save(figure, "delaunay_cells.png")


def draw_realign(library):
    """A square lattice, all of it ties, with values that step at a circle: before and after realign."""
    d = Delaunay(library)
    side = 13
    points = [(i, j) for i in range(side) for j in range(side)]
    for point in points:
        d.insert(*point)
    values = [1.0 if (x - 5.8) ** 2 + (y - 6.3) ** 2 < 20 else 0.0 for x, y in points]
    figure, both = plt.subplots(1, 2, figsize=(9, 4.6), dpi=100)
    for axes, title in zip(both, ("canonical diagonals", "after realign")):
        if axes is both[1]:
            d.realign_to(values)
        triangles = d.triangles()
        axes.tripcolor([p[0] for p in points], [p[1] for p in points], triangles, values, shading="gouraud",
                       cmap="cividis")
        axes.add_collection(LineCollection([[points[a], points[b]] for a, b in edges(triangles)], colors="white",
                                           linewidths=0.6))
        axes.scatter(*zip(*points), c=values, cmap="cividis", s=14, edgecolors="white", linewidths=0.5, zorder=3)
        axes.set_title(title, fontsize=10)
        bare(axes)
    save(figure, "delaunay_realign.png")


def save(figure, name):
    figure.tight_layout()
    figure.savefig(HERE / name, bbox_inches="tight", pad_inches=0.1)
    Image.open(HERE / name).convert("RGB").quantize(96).save(HERE / name, optimize=True)
    print(HERE / name)


if __name__ == "__main__":
    path = sys.argv[1] if len(sys.argv) > 1 else HERE.parent / "build/release/lib/libradvor.so"
    shared = ctypes.CDLL(str(path))
    draw_cells(shared)
    draw_realign(shared)
