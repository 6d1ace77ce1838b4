"""Tetrahedra for one eighth of a square duct, 0 <= z <= y <= 1, with a spherical cell on its axis (lengths in half widths).

The surface of the cube [-1, 1]^3 in the eighth is cut into triangles; they are carried to the sphere, and prisms stand on
them: rings inside the cell round a core of prisms, layers of liquid that grow from the sphere to the wall and to a box, and
layers beyond the box to both ends. Each prism is cut into three tetrahedra by its vertices' numbers, so that neighbours
agree. Written in Medit's format. Regions: 0 liquid, 1 cell. Labels: 1 z = 0, 2 y = z, 3 wall, 4 inlet, 5 outlet, 6 surface.
"""
import itertools
import math

LIQUID, CELL = 0, 1
MIRROR, DIAGONAL, WALL, INLET, OUTLET, SURFACE = 1, 2, 3, 4, 5, 6


class Mesh:
    def __init__(self):
        self.points, self.numbers, self.tetrahedra, self.spokes = [], {}, [], {}

    def vertex(self, key, point):
        """The number of the vertex with this key; it is made at `point` when it is new."""
        if key not in self.numbers:
            self.numbers[key] = len(self.points)
            self.points.append(point)
        return self.numbers[key]

    def prism(self, bottom, top, region):
        """Three tetrahedra; the diagonal of each four-sided face starts at its least vertex (Dompierre et al. 1999)."""
        v = list(bottom) + list(top)
        if min(v[3:]) < min(v[:3]):
            v = v[3:] + v[:3]
        turn = v.index(min(v))
        v = [v[(k + turn) % 3] for k in range(3)] + [v[3 + (k + turn) % 3] for k in range(3)]
        if min(v[1], v[5]) < min(v[2], v[4]):
            corners = ((0, 1, 2, 5), (0, 1, 5, 4), (0, 4, 5, 3))
        else:
            corners = ((0, 1, 2, 4), (0, 4, 2, 5), (0, 4, 5, 3))
        for four in corners:
            self.tetrahedra.append(([v[k] for k in four], region))

    def faces(self):
        """Each face's vertices in order with the regions of its tetrahedra."""
        found = {}
        for vertices, region in self.tetrahedra:
            for face in itertools.combinations(sorted(vertices), 3):
                found.setdefault(face, []).append(region)
        return found


def ball(X, Y, Z):
    """The cube's surface on the unit sphere."""
    def one(a, b, c):
        return a * (1 - b * b / 2 - c * c / 2 + b * b * c * c / 3) ** 0.5
    return one(X, Y, Z), one(Y, Z, X), one(Z, X, Y)


def between(a, b, s):
    return tuple(p + (q - p) * s for p, q in zip(a, b))


def add_core(mesh, n, radius):
    """Prisms on the triangle 0 <= Z <= Y <= 1, 2 n layers along X; the keys of vertices are their places in the cube."""
    def at(i, j, k):
        cube = (i / n, j / n, k / n)
        # Half a cube, half a ball: the core's edges are blunt, and the rings become even.
        size = max(map(abs, cube))
        round_one = ball(*(c / size for c in cube)) if size else cube
        return mesh.vertex((i, j, k), tuple(radius * (0.24 * c + 0.26 * size * b) for c, b in zip(cube, round_one)))

    for i in range(-n, n):
        for j in range(n):
            for k in range(j + 1):
                halves = [((j, k), (j + 1, k), (j + 1, k + 1))]
                if k < j:
                    halves.append(((j, k), (j + 1, k + 1), (j, k + 1)))
                for half in halves:
                    mesh.prism([at(i, *c) for c in half], [at(i + 1, *c) for c in half], CELL)


def outer_triangles(mesh, n):
    """Triangles of the core that face the cube's surface, as keys."""
    keys = {number: key for key, number in mesh.numbers.items()}
    for face, regions in mesh.faces().items():
        corners = [keys[v] for v in face]
        if len(regions) == 1 and any(all(c[axis] == value for c in corners)
                                     for axis, value in ((0, n), (0, -n), (1, n))):
            yield corners


def add_layers(mesh, triangles, names, point, fractions, region):
    """Prisms between two images of the triangles, cut at the fractions; vertices of both are (name, key), or key for None.

    `point(key, fraction)` is a place on the spoke of a key.
    """
    def at(key, layer):
        name = names[0] if layer == 0 else names[1] if layer == len(fractions) - 1 else (names, layer)
        return mesh.vertex((name, key) if name else key, point(key, fractions[layer]))

    for triangle in triangles:
        for layer in range(len(fractions) - 1):
            mesh.prism([at(c, layer) for c in triangle], [at(c, layer + 1) for c in triangle], region)


def geometric(count, ratio):
    """0 ... 1 in `count` steps, each `ratio` times the one before."""
    steps = [ratio ** k for k in range(count)]
    return [sum(steps[:k]) / sum(steps) for k in range(count + 1)]


def duct_mesh(radius, n, rings, layers, growth, channel, end):
    """n edges to 45 degrees of the cell's surface; rings in the cell, layers of liquid that grow by `growth`, `channel`
    layers from the box to each end, which lies `end` from the cell's pole."""
    mesh = Mesh()
    add_core(mesh, n, radius)
    triangles = list(outer_triangles(mesh, n))
    box = radius + 0.6

    def on_sphere(key):
        return tuple(radius * c for c in ball(*(k / n for k in key)))

    def on_box(key):
        return box * key[0] / n, key[1] / n, key[2] / n

    def in_channel(key, fraction):
        x, y, z = on_box(key)
        return x + math.copysign((end - 0.6) * fraction, x), y, z

    cores = {key: mesh.points[number] for key, number in mesh.numbers.items()}
    add_layers(mesh, triangles, (None, "surface"), lambda key, s: between(cores[key], on_sphere(key), s),
               geometric(rings, 1.0), CELL)
    add_layers(mesh, triangles, ("surface", "box"), lambda key, s: between(on_sphere(key), on_box(key), s),
               geometric(layers, growth), LIQUID)
    for side in (-n, n):
        faces = [triangle for triangle in triangles if all(key[0] == side for key in triangle)]
        add_layers(mesh, faces, ("box", "end"), in_channel, geometric(channel, 1.3), LIQUID)
    return mesh


def label(points, regions):
    if len(regions) == 2:
        return SURFACE if regions[0] != regions[1] else 0
    tiny = 1e-12
    if all(abs(p[2]) < tiny for p in points):
        return MIRROR
    if all(abs(p[1] - p[2]) < tiny for p in points):
        return DIAGONAL
    if all(abs(p[1] - 1) < tiny for p in points):
        return WALL
    return INLET if points[0][0] < 0 else OUTLET


def volume6(a, b, c, d):
    u, v, w = ([q[k] - a[k] for k in range(3)] for q in (b, c, d))
    return (u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0]))


def meridian(mesh):
    """The vertices of the surface in z = 0 from the rear pole to the front pole."""
    return sorted(mesh.points[number] for key, number in mesh.numbers.items() if key[0] == "surface" and key[1][2] == 0)


def write(mesh, path):
    """The mesh as `path`, and the vertices of its meridian beside it."""
    lines = ["MeshVersionFormatted 2", "Dimension 3", "Vertices", str(len(mesh.points))]
    lines += ["%.17g %.17g %.17g 0" % point for point in mesh.points]
    lines += ["Tetrahedra", str(len(mesh.tetrahedra))]
    for vertices, region in mesh.tetrahedra:
        size = volume6(*(mesh.points[v] for v in vertices))
        assert abs(size) > 1e-12, vertices
        a, b, c, d = vertices if size > 0 else [vertices[k] for k in (1, 0, 2, 3)]
        lines.append(f"{a + 1} {b + 1} {c + 1} {d + 1} {region}")
    faces = [(face, label([mesh.points[v] for v in face], regions)) for face, regions in mesh.faces().items()]
    faces = [(face, mark) for face, mark in faces if mark]
    lines += ["Triangles", str(len(faces))]
    lines += ["%d %d %d %d" % (*(v + 1 for v in face), mark) for face, mark in faces]
    path.write_text("\n".join(lines + ["End", ""]))
    points = meridian(mesh)
    path.with_suffix(".meridian").write_text("\n".join([str(len(points))] + ["%.17g %.17g" % p[:2] for p in points]) + "\n")
