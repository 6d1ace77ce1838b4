"""Meshes, elements and cortex of tube_cortex.py, and the reader of its cases."""
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import tomllib
from scipy.interpolate import CubicSpline
from scipy.spatial import cKDTree

KBT = 4.116404e-21  # J, at 25 degrees C
END = 3.6  # from the cell's centre to both ends of the tube
DEPTH = 0.07  # of small elements under the rim, in radii of the cell
FLOOR = 0.01  # shear rate below which the power law levels off


# ---- Shape functions: six of P2 (vertices, then midpoints of 01, 12, 20), three of P1, at seven points (degree 5) ----
A1, B1 = (6 - math.sqrt(15)) / 21, (6 + math.sqrt(15)) / 21
POINTS = np.array([[1 / 3, 1 / 3]] + [[a, b] for c in (A1, B1) for a, b in ((c, c), (1 - 2 * c, c), (c, 1 - 2 * c))])
WEIGHTS = np.array([9 / 80] + [(155 - math.sqrt(15)) / 2400] * 3 + [(155 + math.sqrt(15)) / 2400] * 3)


def shape_functions(points):
    """P1 (3, q), P2 (6, q) and its derivatives (6, q) along both coordinates."""
    b, c = points.T
    a = 1 - b - c
    one, zero = np.ones_like(a), np.zeros_like(a)
    linear = np.array([a, b, c])
    quadratic = np.array([a * (2 * a - 1), b * (2 * b - 1), c * (2 * c - 1), 4 * a * b, 4 * b * c, 4 * c * a])
    first = np.array([1 - 4 * a, 4 * b - 1, zero, 4 * (a - b), 4 * c, -4 * c])
    second = np.array([1 - 4 * a, zero, 4 * c - 1, -4 * b, 4 * b, 4 * (a - c)])
    return linear * one, quadratic, first, second


L, N, N1, N2 = shape_functions(POINTS)


# ---- Meshes ----
class Triangles:
    """Vertices (nv first), then midpoints of edges; `six` are the nodes of each triangle."""

    def __init__(self, vertices, three):
        edges = np.sort(three[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        unique, where, count = np.unique(edges, axis=0, return_inverse=True, return_counts=True)
        self.nv = len(vertices)
        self.three = three
        self.six = np.hstack([three, self.nv + where.reshape(-1, 3)])
        self.nodes = np.vstack([vertices, vertices[unique].mean(axis=1)])
        self.n = len(self.nodes)
        outer = np.flatnonzero(count == 1)
        self.outline = np.unique(np.concatenate([unique[outer].ravel(), self.nv + outer]))

    def find(self, places):
        """The nodes at these places."""
        distance, node = cKDTree(self.nodes).query(places)
        assert distance.max() < 1e-8, distance.max()
        return node


def least_determinant(places):
    """Of the triangles with the nodes' places (e, 6, 2)."""
    x, r = places[:, :, 0], places[:, :, 1]
    return ((x @ N1) * (r @ N2) - (x @ N2) * (r @ N1)).min()


def triangulate(outline, folder, inside=()):
    path = Path(folder, "outline")
    path.write_text("".join(f"{len(line)}\n" + "".join(f"{x:.17g} {r:.17g}\n" for x, r in line) for line in (outline, inside)))
    program = Path(__file__).resolve().parent / "triangles.edp"
    subprocess.run(["FreeFem++", "-nw", "-v", "0", program, path], check=True, stdout=subprocess.DEVNULL)
    words = Path(str(path) + ".msh").read_text().split()
    nv, nt = int(words[0]), int(words[1])
    numbers = np.array(words[3:3 + 3 * nv + 4 * nt], dtype=float)
    return Triangles(numbers[:3 * nv].reshape(nv, 3)[:, :2].copy(), numbers[3 * nv:].reshape(nt, 4)[:, :3].astype(int) - 1)


def spaced(a, b, size):
    """Points from a to b whose distances are about size(place)."""
    s = np.linspace(0, 1, 2001)
    places = a + (b - a) * s
    density = abs(b - a) / np.array([size(x) for x in places])
    number = np.concatenate([[0], np.cumsum((density[1:] + density[:-1]) / 2 * np.diff(s))])
    count = max(1, math.ceil(number[-1]))
    return np.interp(np.arange(count + 1) * number[-1] / count, number, places)


def surface_angles(size, turning=None):
    """Angles of the surface's vertices. `turning` has the angle by which the meridian turns per angle of the sphere at equal
    distances of it; without it they are the nearer where the rear of soft cells is bent most."""
    if turning is None:
        return spaced(0.0, math.pi, lambda t: size * min(0.045, 0.012 + 0.05 * max(1.75 - t, t - 2.5, 0.0)))
    t = np.linspace(0, math.pi, len(turning))
    requested = size * np.minimum(0.045, 0.15 / np.maximum(abs(turning), 1e-3))
    away = np.maximum(abs(t[:, None] - t) - 0.06, 0)
    allowed = (requested + 0.08 * away).min(axis=1)
    return spaced(0.0, math.pi, lambda place: np.interp(place, t, allowed))


def cell_mesh(radius, angles, size, folder):
    arc = radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    arc[[0, -1], 1] = 0
    # Small elements under the rim, too: a line below those vertices that are near to each other.
    steps = np.diff(angles)
    near = np.flatnonzero(steps < 0.6 * steps.max())
    near = near[angles[near] > 1.2]
    below = (1 - DEPTH) * arc[near[0]:near[-1] + 2] if len(near) else ()
    axis = spaced(-radius, radius, lambda x: size * min(0.08, 0.03 + 0.3 * (radius - abs(x))))[1:-1]
    mesh = triangulate(np.vstack([arc, np.stack([axis, 0 * axis], axis=1)]), folder, below)
    surface = np.empty(2 * len(angles) - 1, dtype=int)
    surface[::2] = mesh.find(arc)
    surface[1::2] = mesh.find((arc[1:] + arc[:-1]) / 2)
    middle = (angles[1:] + angles[:-1]) / 2
    mesh.nodes[surface[1::2]] = radius * np.stack([np.cos(middle), np.sin(middle)], axis=1)
    return mesh, surface


def liquid_mesh(surface, size, folder):
    """Round the surface's nodes, given from the front to the rear."""
    vertices = surface[::2]
    front, rear = vertices[0, 0], vertices[-1, 0]
    ahead = np.linalg.norm(vertices[1] - vertices[0])
    behind = np.linalg.norm(vertices[-1] - vertices[-2])
    left, right = vertices[:, 0].min(), vertices[:, 0].max()

    def on_axis(x):
        start, distance = (ahead, x - front) if x > front else (behind, rear - x)
        return min(start + 0.15 * distance, 0.2 * size)

    def on_wall(x):
        return min(size * (0.06 + 0.1 * max(left - x, x - right, 0.0)), 0.2 * size)

    def along(x, r):
        return np.stack(np.broadcast_arrays(x, r), axis=1)

    side = spaced(0.0, 1.0, lambda r: size * 0.15)
    outline = [along(spaced(-END, rear, on_axis)[:-1], 0.0), vertices[::-1][:-1], along(spaced(front, END, on_axis)[:-1], 0.0),
               along(END, side[:-1]), along(spaced(END, -END, on_wall)[:-1], 1.0), along(-END, side[:0:-1])]
    mesh = triangulate(np.vstack(outline), folder)
    own = np.empty(len(surface), dtype=int)
    own[::2] = mesh.find(vertices)
    own[1::2] = mesh.find((vertices[1:] + vertices[:-1]) / 2)
    mesh.nodes[own] = surface
    return mesh, own


# ---- Integrals over elements: residuals of real or complex values at the elements' nodes ----
def liquid_element(values, n, re):
    """values (e, 27): places x, r, velocities u, v at six nodes, p at three. Residuals (e, 15) of u, v, p."""
    x, r, u, v, p = values[:, :6], values[:, 6:12], values[:, 12:18], values[:, 18:24], values[:, 24:] @ L
    x1, x2, r1, r2, r = x @ N1, x @ N2, r @ N1, r @ N2, r @ N
    det = x1 * r2 - x2 * r1

    def slopes(f):
        f1, f2 = f @ N1, f @ N2
        return (f1 * r2 - f2 * r1) / det, (f2 * x1 - f1 * x2) / det

    (ux, ur), (vx, vr) = slopes(u), slopes(v)
    u, v = u @ N, v @ N
    hoop = v / r
    eta = (2 * (ux * ux + vr * vr + hoop * hoop) + (ur + vx) ** 2 + FLOOR**2) ** ((n - 1) / 2) if n != 1 else 1.0
    sxx, srr, shh, sxr = 2 * eta * ux - p, 2 * eta * vr - p, 2 * eta * hoop - p, eta * (ur + vx)
    whole, flat = WEIGHTS * det * r, WEIGHTS * r
    of_u = (flat * (sxx * r2 - sxr * x2)) @ N1.T + (flat * (sxr * x1 - sxx * r1)) @ N2.T + (whole * re * (u * ux + v * ur)) @ N.T
    of_v = (flat * (sxr * r2 - srr * x2)) @ N1.T + (flat * (srr * x1 - sxr * r1)) @ N2.T \
        + (whole * (shh / r + re * (u * vx + v * vr))) @ N.T
    return np.hstack([of_u, of_v, -(whole * (ux + vr + hoop)) @ L.T])


class SolidElements:
    """values (e, 15): x, r at six nodes, p at three; residuals in the same way."""

    def __init__(self, mesh):
        x, r = mesh.nodes[mesh.six, 0], mesh.nodes[mesh.six, 1]
        x1, x2, r1, r2, self.r0 = x @ N1, x @ N2, r @ N1, r @ N2, r @ N
        det = x1 * r2 - x2 * r1
        assert det.min() > 0
        self.dx = (N1[None] * r2[:, None] - N2[None] * r1[:, None]) / det[:, None]
        self.dr = (N2[None] * x1[:, None] - N1[None] * x2[:, None]) / det[:, None]
        self.weight = WEIGHTS * det * self.r0

    def __call__(self, values, mu):
        x, r, p = values[:, :6, None], values[:, 6:12, None], values[:, 12:] @ L
        f11, f12, f21, f22 = ((f * d).sum(axis=1) for f in (x, r) for d in (self.dx, self.dr))
        hoop, flat = (values[:, 6:12] @ N) / self.r0, f11 * f22 - f12 * f21

        def work(p1, p2):
            return (self.dx * (self.weight * p1)[:, None] + self.dr * (self.weight * p2)[:, None]).sum(axis=2)

        of_x = work(mu * f11 - p * hoop * f22, mu * f12 + p * hoop * f21)
        of_r = work(mu * f21 + p * hoop * f12, mu * f22 - p * hoop * f11) + (self.weight * (mu * hoop - p * flat) / self.r0) @ N.T
        return np.hstack([of_x, of_r, -(self.weight * (flat * hoop - 1)) @ L.T])


def with_derivatives(element, values):
    """Residuals (e, i) and their derivatives (e, i, j) by the complex step."""
    residual = element(values)
    derivatives = np.empty(residual.shape + values.shape[1:])
    step = 1e-30
    shifted = values.astype(complex)
    for j in range(values.shape[1]):
        shifted[:, j] += 1j * step
        derivatives[:, :, j] = element(shifted).imag / step
        shifted[:, j] = values[:, j]
    return residual, derivatives


# ---- Cortex ----
def tensions(law, modulus, l1, l2):
    area = l1 * l2
    if law == "neo-hookean":
        return tuple(modulus / 6 * (3 * a * a + b * b - area**-2 - 3) for a, b in ((l1, l2), (l2, l1)))
    if law == "neo-hookean-reference":
        return tuple(modulus / 3 * (a / b - area**-3) for a, b in ((l1, l2), (l2, l1)))
    sys.exit(f"this program has no membrane law {law}")


class Cortex:
    """The spline through the surface's nodes at the angles t."""

    def __init__(self, t, radius):
        gauss, weights = np.polynomial.legendre.leggauss(4)
        half = np.diff(t)[:, None] / 2
        self.t = (t[:-1, None] + half * (1 + gauss)).ravel()
        self.weight = (half * weights).ravel()
        self.radius, self.rest = radius, radius * np.sin(self.t)
        unit = np.eye(len(t))
        even, odd = CubicSpline(t, unit, bc_type=((1, 0 * t), (1, 0 * t))), CubicSpline(t, unit, bc_type=((2, 0 * t), (2, 0 * t)))
        self.basis = [even(self.t, 1), odd(self.t), odd(self.t, 1), even(self.t, 2), odd(self.t, 2)]  # x', r, r', x'', r''
        self.value = even(self.t)

    def slopes(self, law, given, x1, r, r1, x2, r2):
        """Derivatives of the energy per dt with respect to x', r, r', x'', r''."""
        s = (x1 * x1 + r1 * r1) ** 0.5
        one, two = tensions(law, given["modulus"], s / self.radius, r / self.rest)
        turn = x1 * r2 - r1 * x2
        k = turn / s**3 - x1 / (s * r)
        bend, lever = given["bending"] / 8 * k * k, given["bending"] / 4 * r * s * k
        by_s = r * (one + given["tension"] + bend) + lever * (x1 / (s * s * r) - 3 * turn / s**4)
        return [by_s * x1 / s + lever * (r2 / s**3 - 1 / (s * r)), s * (two + given["tension"] + bend) + lever * x1 / (s * r * r),
                by_s * r1 / s - lever * x2 / s**3, -lever * r1 / s**3, lever * x1 / s**3]

    def forces(self, law, given, x, r):
        """Residuals (2 n) of the nodes' x and r, axial tension included, and their derivatives (2 n, 2 n)."""
        n = len(x)
        inputs = [b @ (x if i in (0, 3) else r) for i, b in enumerate(self.basis)]
        residual, tangent = np.zeros(2 * n), np.zeros((2 * n, 2 * n))
        part = [slice(0, n) if i in (0, 3) else slice(n, 2 * n) for i in range(5)]
        for i, slope in enumerate(self.slopes(law, given, *inputs)):
            residual[part[i]] += self.basis[i].T @ (self.weight * slope)
        for j in range(5):
            shifted = [f + 1e-30j * (j == i) for i, f in enumerate(inputs)]
            for i, slope in enumerate(self.slopes(law, given, *shifted)):
                tangent[part[i], part[j]] += self.basis[i].T @ ((self.weight * slope.imag / 1e-30)[:, None] * self.basis[j])
        pull = given["axial"] * self.weight
        residual[:n] -= self.value.T @ (pull * inputs[1] * inputs[2])
        area = inputs[1][:, None] * self.basis[2] + inputs[2][:, None] * self.basis[1]
        tangent[:n, n:] -= self.value.T @ (pull[:, None] * area)
        return residual, tangent


# ---- The case ----
class Case:
    def __init__(self, path):
        case = tomllib.loads(Path(path).read_text())
        channel, flow, cell = case["channel"], case["flow"], case["cell"]
        self.R = 1e-6 * (channel["radius_um"] if "radius_um" in channel else 0.547 * channel["width_um"])
        self.V = 1e-9 * flow["rate_ul_per_s"] / (math.pi * self.R**2)
        power = flow.get("law", "newtonian") == "power-law"
        self.n = flow["exponent"] if power else 1.0
        consistency = flow["consistency_Pa_sn"] if power else 1e-3 * flow["viscosity_mPas"]
        self.S = consistency * (self.V / self.R) ** self.n
        self.re = flow.get("density_kg_per_m3", 1000) * self.V**2 / self.S
        self.radius = 1e-6 * cell["radius_um"] / self.R
        self.mu = 1e3 * cell["bulk"]["young_modulus_kPa"] / 3 / self.S
        cortex = cell["cortex"]
        self.law = cortex["law"]
        modulus = 1e-3 * cortex["modulus_mN_per_m"] / (self.S * self.R)
        self.cortex = {"modulus": modulus, "tension": modulus * cortex.get("tension_ratio", 0.0),
                       "bending": cortex.get("bending_kBT", 0.0) * KBT / (self.S * self.R**3),
                       "axial": flow.get("axial_tension_Pa", 0.0) / self.S}

    def stiffer(self, factor):
        """mu and the cortex's numbers with moduli and tension multiplied."""
        return self.mu * factor, self.cortex | {k: self.cortex[k] * factor for k in ("modulus", "tension")}

    def profile(self, r):
        n = self.n
        return (3 * n + 1) / (n + 1) * (1 - r ** ((n + 1) / n))
