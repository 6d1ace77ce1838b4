"""Invented result folders: a deformed cell in a channel with a flow that vanishes on it, written as rheocyte writes."""

import json
from pathlib import Path

import numpy as np

from rheocyte.vtu import quadrilateral_position

CHANNEL_UM, CELL_UM, DEGREE = 10.94, 7.66, 4
MEAN_SPEED, CELL_SPEED = 0.106, 0.125
KINDS = {"<f8": "Float64", "<i8": "Int64", "|u1": "UInt8"}


def surface(theta):
    """Contour of the invented cell: bullet-like, with a shallow dent at the rear."""
    c = np.cos(theta)
    x = CELL_UM * (1.12 * c + 0.3 * np.exp(-4 * (c + 1)) - 0.02)
    return x, 0.93 * CELL_UM * np.sin(theta) * (1 - 0.08 * c)


def frame(theta):
    """Where the ray of an angle meets the channel's wall or its ends at +-3 R."""
    reach = np.minimum(3 * CHANNEL_UM / np.maximum(np.abs(np.cos(theta)), 1e-12),
                       CHANNEL_UM / np.maximum(np.sin(theta), 1e-12))
    return reach * np.cos(theta), reach * np.sin(theta)


def blocks():
    """Node positions (n, p + 1, p + 1) of x and r, the place between cell (0) and frame (1), region of each element."""
    corner = np.arctan(1 / 3)
    angles = np.concatenate([np.linspace(0, corner, 4)[:-1], np.linspace(corner, np.pi - corner, 15)[:-1],
                             np.linspace(np.pi - corner, np.pi, 4)])
    xs, rs, gaps, regions = [], [], [], []
    for region, layers in ((0, np.linspace(0, 1, 6) ** 1.3), (1, np.linspace(0, 1, 5))):
        for a0, a1 in zip(angles[:-1], angles[1:]):
            for s0, s1 in zip(layers[:-1], layers[1:]):
                t, s = np.meshgrid(np.linspace(a0, a1, DEGREE + 1), np.linspace(s0, s1, DEGREE + 1))
                inner, outer = surface(t), frame(t)
                if region == 1:
                    inner, outer = (0 * inner[0], 0 * inner[1]), inner
                xs.append((1 - s) * inner[0] + s * outer[0])
                rs.append((1 - s) * inner[1] + s * outer[1])
                gaps.append(s)
                regions.append(region)
    return np.array(xs), np.maximum(np.array(rs), 0), np.array(gaps), np.array(regions)


def fields(x, r, gap, region):
    """Point data with the names, frames and units of rheocyte."""
    liquid = (region == 0)[:, None, None] * np.ones_like(x)
    theta = np.arctan2(r, x)
    fade = 1 - np.exp(-4 * gap)
    axial = (2 * MEAN_SPEED * (1 - (r / CHANNEL_UM) ** 2) - CELL_SPEED) * fade * liquid
    radial = -0.03 * np.sin(2 * theta) * gap * np.exp(-4 * gap) * (1 - r / CHANNEL_UM) * liquid
    inside = 1 - liquid
    zero = np.zeros_like(x)
    return {"velocity": np.stack([axial + CELL_SPEED, radial, zero], -1),
            "velocity_relative": np.stack([axial, radial, zero], -1),
            "pressure": 2000 - 30 * x,
            "stress": 900 * inside * (0.2 + (np.hypot(x + 2, r) / CELL_UM) ** 2),
            "shear_stress": 60 * liquid * r / CHANNEL_UM,
            "displacement": np.stack([0.1 * x, -0.05 * r, zero], -1) * inside[..., None],
            "region": inside}


def write_vtu(path, x, r, data):
    """Each element has points of its own, as in the program's output."""
    n, nodes = len(x), x[0].size
    points = np.stack([x, r, np.zeros_like(x)], -1).reshape(-1, 3)
    connectivity = np.empty((n, nodes), dtype="<i8")
    connectivity[:, quadrilateral_position(x.shape[1] - 1).ravel()] = np.arange(n * nodes).reshape(n, nodes)
    arrays = bytearray()

    def array(name, values, components=1):
        line = (f'<DataArray type="{KINDS[values.dtype.str]}" Name="{name}" NumberOfComponents="{components}" '
                f'format="appended" offset="{len(arrays)}"/>\n')
        arrays.extend(np.uint64(values.nbytes).tobytes() + values.tobytes())
        return line

    fields_at_points = "".join(array(name, values, 3 if values.ndim == 4 else 1) for name, values in data.items())
    head = (f'<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="2.2" byte_order="LittleEndian" '
            f'header_type="UInt64">\n<UnstructuredGrid><Piece NumberOfPoints="{n * nodes}" NumberOfCells="{n}">\n'
            f'<Points>{array("Points", points, 3)}</Points>\n'
            f'<Cells>{array("connectivity", connectivity)}{array("offsets", np.arange(1, n + 1) * nodes)}'
            f'{array("types", np.full(n, 70, dtype="u1"))}</Cells>\n<PointData>{fields_at_points}</PointData>\n'
            '</Piece></UnstructuredGrid>\n<AppendedData encoding="raw">\n_')
    Path(path).write_bytes(head.encode() + arrays + b"\n</AppendedData>\n</VTKFile>\n")


def write_result(folder, **changes):
    """result.json, contour.csv and fields.vtu of the invented cell."""
    folder = Path(folder)
    x, r, gap, region = blocks()
    write_vtu(folder / "fields.vtu", x, r, fields(x, r, gap, region))
    contour = np.stack(surface(np.linspace(0, np.pi, 181)), axis=1)
    np.savetxt(folder / "contour.csv", contour, delimiter=",", header="x_um,r_um", comments="")
    result = {"status": "converged", "message": "", "deformation": 0.0361, "area_um2": 190.2,
              "cell_velocity_m_per_s": CELL_SPEED, "pressure_drop_Pa": 2310.0, "estimated_error": 3.2e-5,
              "case": {"channel": {"radius_um": CHANNEL_UM}, "cell": {
                  "radius_um": CELL_UM, "bulk": {"law": "neo-hookean", "young_modulus_kPa": 3.437}}}}
    (folder / "result.json").write_text(json.dumps(result | changes), encoding="utf-8")
