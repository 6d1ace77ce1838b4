"""The unknowns of tube_cortex.py, and Newton's method for all of them."""
import math

import numpy as np
from scipy.interpolate import (
    CloughTocher2DInterpolator,
    CubicSpline,
    LinearNDInterpolator,
    NearestNDInterpolator,
)
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu
from tube_cortex_parts import (
    END,
    N1,
    N2,
    WEIGHTS,
    Cortex,
    SolidElements,
    cell_mesh,
    least_determinant,
    liquid_element,
    liquid_mesh,
    surface_angles,
    with_derivatives,
)


# ---- The cell, with the liquid round its last shape ----
class Model:
    def __init__(self, case, size, folder, tell, turning=None):
        self.case, self.size, self.folder, self.tell = case, size, folder, tell
        vertices = surface_angles(size, turning)
        self.t = np.empty(2 * len(vertices) - 1)
        self.t[::2], self.t[1::2] = vertices, (vertices[1:] + vertices[:-1]) / 2
        self.solid, self.surface = cell_mesh(case.radius, vertices, size, folder)
        self.elements = SolidElements(self.solid)
        self.cortex = Cortex(self.t, case.radius)
        self.places = self.solid.nodes.copy()
        self.pressure = None
        self.liquid = self.w = self.p = None
        self.speed = 1.3
        centre = self.solid.outline[np.argmin(abs(self.solid.nodes[self.solid.outline]).sum(axis=1))]
        self.held = centre if centre < self.solid.nv else self.solid.find([self.solid.nodes[centre]])[0]

    # Numbers of the unknowns: bulk x, r, p; liquid x, r, u, v, p; speed.
    def number(self):
        ns, nl = self.solid.n, self.liquid.n
        self.at_x, self.at_r = np.arange(ns), ns + np.arange(ns)
        self.at_ps = 2 * ns + np.arange(self.solid.nv)
        start = 2 * ns + self.solid.nv
        self.at_mx, self.at_mr = start + np.arange(nl), start + nl + np.arange(nl)
        self.at_u, self.at_v = start + 2 * nl + np.arange(nl), start + 3 * nl + np.arange(nl)
        self.at_p = start + 4 * nl + np.arange(self.liquid.nv)
        self.at_speed = start + 4 * nl + self.liquid.nv
        self.unknowns = self.at_speed + 1
        x, r = self.liquid.nodes.T
        outline = self.liquid.outline
        self.axis = outline[(r[outline] < 1e-9)]
        self.wall, self.inlet = outline[r[outline] > 1 - 1e-9], outline[x[outline] < -END + 1e-9]
        self.outlet = outline[x[outline] > END - 1e-9]
        solid_outline = self.solid.outline
        self.solid_axis = solid_outline[self.solid.nodes[solid_outline, 1] < 1e-9]
        self.columns = np.hstack([a[self.liquid.six] for a in (self.at_mx, self.at_mr, self.at_u, self.at_v)]
                                 + [self.at_p[self.liquid.three]])
        self.rows = self.liquid_rows()
        self.solid_columns = np.hstack([self.at_x[self.solid.six], self.at_r[self.solid.six], self.at_ps[self.solid.three]])
        self.surface_columns = np.concatenate([self.at_x[self.surface], self.at_r[self.surface]])
        self.given_rows()
        self.mesh_matrix()

    def liquid_rows(self):
        """Where the liquid's residuals belong: those of the surface's nodes to the bulk's equations."""
        row_u, row_v = self.at_u.copy(), self.at_v.copy()
        row_u[self.own], row_v[self.own] = self.at_x[self.surface], self.at_r[self.surface]
        return np.hstack([row_u[self.liquid.six], row_v[self.liquid.six], self.at_p[self.liquid.three]])

    def given_rows(self):
        """Unknowns with given values: numbers, values, and those that the speed is taken off."""
        at, values, minus = [], [], []

        def give(numbers, value=0.0, speed=0.0):
            at.append(numbers)
            values.append(np.broadcast_to(value, len(numbers)))
            minus.append(np.full(len(numbers), speed))

        x, r = self.liquid.nodes.T
        give(self.at_r[self.solid_axis])
        give(self.at_mr[self.axis])
        fixed = np.unique(np.concatenate([self.wall, self.inlet, self.outlet]))
        give(self.at_mx[fixed], x[fixed])
        give(self.at_mr[fixed], r[fixed])
        give(self.at_u[self.wall], 0.0, 1.0)
        inner = np.setdiff1d(self.inlet, self.wall)
        give(self.at_u[inner], self.case.profile(r[inner]), 1.0)
        still = np.unique(np.concatenate([self.wall, self.inlet, self.outlet, self.axis, self.own]))
        give(self.at_v[still])
        give(self.at_u[self.own])
        self.given, first = np.unique(np.concatenate(at), return_index=True)
        self.given_values, self.given_minus = np.concatenate(values)[first], np.concatenate(minus)[first]
        self.free = np.ones(self.unknowns, dtype=bool)
        self.free[self.given] = False
        self.free[self.at_mx[self.own]] = self.free[self.at_mr[self.own]] = self.free[self.at_speed] = False

    def mesh_matrix(self):
        """Laplace's equation for the displacement of the liquid's nodes, small elements the stiffer."""
        x, r = self.liquid.nodes[self.liquid.six, 0], self.liquid.nodes[self.liquid.six, 1]
        x1, x2, r1, r2 = x @ N1, x @ N2, r @ N1, r @ N2
        det = x1 * r2 - x2 * r1
        dx = (N1[None] * r2[:, None] - N2[None] * r1[:, None]) / det[:, None]
        dr = (N2[None] * x1[:, None] - N1[None] * x2[:, None]) / det[:, None]
        weight = WEIGHTS * det / (det @ WEIGHTS)[:, None]
        local = np.einsum("eq,eaq,ebq->eab", weight, dx, dx) + np.einsum("eq,eaq,ebq->eab", weight, dr, dr)
        rows, columns = np.repeat(self.liquid.six, 6, axis=1).ravel(), np.tile(self.liquid.six, 6).ravel()
        self.laplace = coo_matrix((local.ravel(), (rows, columns)), shape=(self.liquid.n,) * 2).tocsr()

    def surround(self):
        """A new mesh of the liquid round the present shape, and the liquid's flow in it."""
        old = (self.liquid, self.w, self.p)
        mesh, own = liquid_mesh(self.places[self.surface], self.size, self.folder)
        if least_determinant(mesh.nodes[mesh.six]) <= 0:
            raise ArithmeticError("the liquid's new mesh is folded")
        self.liquid, self.own = mesh, own
        self.number()
        self.rest = self.liquid.nodes.copy()
        self.w, self.p = np.zeros((self.liquid.n, 2)), np.zeros(self.liquid.nv)
        if old[0] is not None:
            self.w = interpolated(old[0].nodes, old[1], self.liquid.nodes)
            self.p = interpolated(old[0].nodes[:old[0].nv], old[2], self.liquid.nodes[:self.liquid.nv])
        for n in ([self.case.n] if old[0] is not None else [1.0, 0.5 + 0.5 * self.case.n, self.case.n]):
            self.solve_liquid(n)

    def state(self):
        mesh = self.liquid.nodes
        return np.concatenate([self.places.T.ravel(), self.pressure, mesh.T.ravel(), self.w.T.ravel(), self.p, [self.speed]])

    def set_state(self, z):
        ns, nl = self.solid.n, self.liquid.n
        self.places = z[:2 * ns].reshape(2, ns).T.copy()
        self.pressure, self.p, self.speed = z[self.at_ps].copy(), z[self.at_p].copy(), z[self.at_speed]
        start = self.at_mx[0]
        self.liquid.nodes = z[start:start + 2 * nl].reshape(2, nl).T.copy()
        self.w = z[start + 2 * nl:start + 4 * nl].reshape(2, nl).T.copy()

    def solve_liquid(self, n):
        """Newton's method with the shape and the speed given."""
        if self.pressure is None:
            self.pressure = np.zeros(self.solid.nv)
        z = self.state()
        z[self.given] = self.given_values - self.given_minus * self.speed
        fluid = np.concatenate([self.at_u, self.at_v, self.at_p])
        fluid = fluid[self.free[fluid]]
        place = np.full(self.unknowns, -1)
        place[fluid] = np.arange(len(fluid))
        for step in range(25):
            residual, local = with_derivatives(lambda v: liquid_element(v, n, self.case.re), z[self.columns])
            rows, columns = place[self.rows], place[self.columns]
            # Rows of the surface's nodes belong to the bulk and drop out here.
            b = np.zeros(len(fluid))
            np.add.at(b, rows[rows >= 0], residual[rows >= 0])
            A = gather(local, rows, columns, len(fluid))
            change = splu(A).solve(-b)
            size = abs(change[: 2 * self.liquid.n - len(self.own)]).max()
            z[fluid] += change
            self.tell(f"    liquid n = {n:.2f}: change {size:.1e}")
            if size < 1e-6:
                break
        self.set_state(z)

    def system(self, z, factor):
        """Residual and tangent of all equations."""
        mu, cortex = self.case.stiffer(factor)
        b = np.zeros(self.unknowns)
        entries = []
        residual, local = with_derivatives(lambda v: liquid_element(v, self.case.n, self.case.re), z[self.columns])
        add(b, entries, residual, local, self.rows, self.columns)
        residual, local = with_derivatives(lambda v: self.elements(v, mu), z[self.solid_columns])
        add(b, entries, residual, local, self.solid_columns, self.solid_columns)
        force, tangent = self.cortex.forces(self.case.law, cortex, z[self.at_x[self.surface]], z[self.at_r[self.surface]])
        tangent[abs(tangent) < 1e-13 * abs(tangent).max()] = 0
        add(b, entries, force[None], tangent[None], self.surface_columns[None], self.surface_columns[None])
        lists = [np.concatenate(part) for part in zip(*entries)]
        keep = self.free[lists[0]] & (lists[2] != 0)
        rows, columns, values = ([part[keep]] for part in lists)
        b[~self.free] = 0
        self.add_mesh(z, b, rows, columns, values)
        self.add_given(z, b, rows, columns, values)
        rows, columns, values = (np.concatenate(part) for part in (rows, columns, values))
        return b, coo_matrix((values, (rows, columns)), shape=(self.unknowns,) * 2).tocsc()

    def add_mesh(self, z, b, rows, columns, values):
        laplace = self.laplace.tocoo()
        for at, shift in ((self.at_mx, z[self.at_mx] - self.rest[:, 0]), (self.at_mr, z[self.at_mr] - self.rest[:, 1])):
            keep = self.free[at[laplace.row]]
            rows.append(at[laplace.row[keep]])
            columns.append(at[laplace.col[keep]])
            values.append(laplace.data[keep])
            free = self.free[at]
            b[at[free]] = (self.laplace @ shift)[free]
        for mesh, bulk in ((self.at_mx, self.at_x), (self.at_mr, self.at_r)):
            mesh, bulk = mesh[self.own], bulk[self.surface]
            b[mesh] = z[mesh] - z[bulk]
            rows += [mesh, mesh]
            columns += [mesh, bulk]
            values += [np.ones(len(mesh)), -np.ones(len(mesh))]

    def add_given(self, z, b, rows, columns, values):
        own = np.concatenate([self.at_mx[self.own], self.at_mr[self.own]])
        keep = ~np.isin(self.given, own)
        at, value, minus = self.given[keep], self.given_values[keep], self.given_minus[keep]
        b[at] = z[at] - value + minus * z[self.at_speed]
        moving = at[minus != 0]
        held = self.at_x[self.held]
        b[self.at_speed] = z[held] - self.held_place
        rows += [at, moving, [self.at_speed]]
        columns += [at, np.full(len(moving), self.at_speed), [held]]
        values += [np.ones(len(at)), np.ones(len(moving)), [1.0]]

    def folded(self, z):
        """Which of the meshes is folded."""
        for name, six, x, r in (("bulk", self.solid.six, self.at_x, self.at_r),
                                ("liquid", self.liquid.six, self.at_mx, self.at_mr)):
            if least_determinant(np.stack([z[x[six]], z[r[six]]], axis=2)) <= 0:
                return name
        return ""

    def step(self, z, change):
        """As much of the change as possible, and how much; the liquid gets a new mesh where that is little."""
        part = min(1.0, 0.15 / abs(change[:2 * self.solid.n]).max())
        while self.folded(z + part * change) == "bulk":
            part /= 2
            if part < 0.1:
                raise ArithmeticError("the bulk folds")
        if not self.folded(z + part * change):
            return z + part * change, part
        self.set_state(z)
        self.places = self.places + part * change[:2 * self.solid.n].reshape(2, -1).T
        self.pressure, self.speed = self.pressure + part * change[self.at_ps], self.speed + part * change[self.at_speed]
        self.tell(f"    new mesh within a step, {part:.2f} of it")
        self.surround()
        return self.state(), 0.0

    def newton(self, factor, tolerance=1e-8, most=16):
        """To the state of the moduli times factor; raises ArithmeticError."""
        z = self.state()
        self.held_place = z[self.at_x[self.held]]
        last = np.inf
        for step in range(most):
            b, A = self.system(z, factor)
            change = splu(A, permc_spec="COLAMD", diag_pivot_thresh=0.1).solve(-b)
            moved = abs(change[:2 * self.solid.n]).max()
            self.tell(f"    {step}: residual {abs(b).max():.1e}, moved {moved:.1e}")
            if not np.isfinite(moved) or (step > 6 and moved > last and moved > 0.01):
                break
            z, part = self.step(z, change)
            if part == 1 and moved < tolerance:
                self.set_state(z)
                return
            last = moved
        raise ArithmeticError("Newton's method does not converge")

    def copy_from(self, other):
        """The state of a model with another size."""
        shift = other.places - other.solid.nodes
        smooth = CloughTocher2DInterpolator(other.solid.nodes, shift)(self.solid.nodes)
        near = NearestNDInterpolator(other.solid.nodes, shift)(self.solid.nodes)
        self.places = self.solid.nodes + np.where(np.isfinite(smooth), smooth, near)
        self.places[self.surface] = other.meridian(self.t)
        self.places[self.solid.nodes[:, 1] < 1e-9, 1] = 0
        self.pressure = interpolated(other.solid.nodes[:other.solid.nv], other.pressure, self.solid.nodes[:self.solid.nv])
        self.speed = other.speed

    def splines(self):
        x, r = self.places[self.surface].T
        return CubicSpline(self.t, x, bc_type=((1, 0.0), (1, 0.0))), CubicSpline(self.t, r, bc_type=((2, 0.0), (2, 0.0)))

    def meridian(self, t):
        return np.stack([spline(t) for spline in self.splines()], axis=1)

    def turning(self):
        """The angle by which the meridian turns per angle of the sphere, at 601 of these."""
        t, (even, odd) = np.linspace(0, math.pi, 601), self.splines()
        return (even(t, 1) * odd(t, 2) - odd(t, 1) * even(t, 2)) / (even(t, 1) ** 2 + odd(t, 1) ** 2)

    def snapshot(self):
        return self.places, self.pressure, self.speed

    def set_snapshot(self, snapshot):
        self.places, self.pressure, self.speed = snapshot

    def extrapolate(self, states, requested):
        """To the requested compliance by the polynomial through states, pairs of a compliance and a snapshot."""
        weights = [math.prod((requested - b) / (a - b) for b, _ in states if b != a) for a, _ in states]
        self.set_snapshot([sum(w * part for w, part in zip(weights, parts)) for parts in zip(*(s for _, s in states))])
        if least_determinant(self.places[self.solid.six]) <= 0:
            raise ArithmeticError("the bulk folds on the way")

    def volume(self):
        x, r = self.meridian(np.linspace(0, math.pi, 20001)).T
        return -math.pi * ((r[1:]**2 + r[1:] * r[:-1] + r[:-1]**2) / 3 * np.diff(x)).sum() * self.case.R**3


def interpolated(places, values, new):
    result = LinearNDInterpolator(places, values)(new)
    return np.where(np.isfinite(result), result, NearestNDInterpolator(places, values)(new))


def gather(local, rows, columns, n):
    i, j = np.repeat(rows, columns.shape[1], axis=1).ravel(), np.tile(columns, rows.shape[1]).ravel()
    keep = (i >= 0) & (j >= 0)
    return coo_matrix((local.ravel()[keep], (i[keep], j[keep])), shape=(n, n)).tocsc()


def add(b, entries, residual, local, rows, columns):
    np.add.at(b, rows, residual)
    entries.append((np.repeat(rows, columns.shape[1], axis=1).ravel(), np.tile(columns, rows.shape[1]).ravel(), local.ravel()))
