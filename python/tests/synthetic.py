"""Invented result folders: a deformed cell in a channel with a flow that vanishes on it, written as rheocyte writes."""

import base64
import json
import zlib
from pathlib import Path

import numpy as np

from rheocyte.vtu import vtk_position

CHANNEL_UM, CELL_UM, DEGREE = 10.94, 7.66, 4
MEAN_SPEED, CELL_SPEED = 0.106, 0.125


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


def encode(values, encoding):
    """Text of a DataArray: ascii, or zlib-compressed base64 as deal.II writes it (here in blocks of 1000 bytes)."""
    if encoding == "ascii":
        return " ".join(repr(float(v)) if values.dtype.kind == "f" else str(v) for v in values.ravel())
    data = values.tobytes()
    if encoding == "raw":
        return base64.b64encode(np.uint32(len(data)).tobytes() + data).decode()
    size = 1000
    packed = [zlib.compress(data[i:i + size]) for i in range(0, len(data), size)]
    header = np.array([len(packed), size, len(data) % size] + [len(p) for p in packed], dtype="<u4")
    return base64.b64encode(header.tobytes()).decode() + base64.b64encode(b"".join(packed)).decode()


def data_array(name, values, encoding):
    """One DataArray element."""
    kinds = {"f8": "Float64", "i4": "Int32", "u1": "UInt8"}
    components = f' NumberOfComponents="{values.shape[1]}"' if values.ndim > 1 else ""
    return (f'<DataArray type="{kinds[values.dtype.str[1:]]}" Name="{name}"{components} '
            f'format="{"ascii" if encoding == "ascii" else "binary"}">\n{encode(values, encoding)}\n</DataArray>\n')


def write_vtu(path, x, r, data, encoding="zlib"):
    """Each element has its own points, as in deal.II's output."""
    n, nodes = len(x), x[0].size
    points = np.zeros((n * nodes, 3))
    connectivity = np.empty((n, nodes), dtype="<i4")
    place = vtk_position(x.shape[1] - 1).ravel()
    connectivity[:, place] = np.arange(n * nodes).reshape(n, nodes)
    points[:, 0], points[:, 1] = x.ravel(), r.ravel()
    cells = [("connectivity", connectivity.ravel()), ("offsets", np.arange(1, n + 1, dtype="<i4") * nodes),
             ("types", np.full(n, 70, dtype="u1"))]
    compressor = ' compressor="vtkZLibDataCompressor"' if encoding == "zlib" else ""
    flat = {name: values.reshape(n * nodes, *values.shape[3:]) for name, values in data.items()}
    Path(path).write_text(
        f'<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="0.1"{compressor} byte_order="LittleEndian">\n'
        f'<UnstructuredGrid><Piece NumberOfPoints="{n * nodes}" NumberOfCells="{n}">\n'
        f'<Points>{data_array("Points", points, encoding)}</Points>\n'
        f'<Cells>{"".join(data_array(name, values, encoding) for name, values in cells)}</Cells>\n'
        f'<PointData>{"".join(data_array(name, values, encoding) for name, values in flat.items())}</PointData>\n'
        '</Piece></UnstructuredGrid></VTKFile>\n', encoding="utf-8")


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
