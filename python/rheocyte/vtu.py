"""A small reader for the .vtu files that rheocyte writes: Lagrange quadrilaterals or hexahedra of any degree, raw arrays."""

import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from rheocyte.errors import InputError, reason

VTK_LAGRANGE_QUADRILATERAL, VTK_LAGRANGE_HEXAHEDRON = 70, 72
TYPES = {"Float32": "<f4", "Float64": "<f8", "UInt8": "u1", "Int32": "<i4", "Int64": "<i8"}
LAYOUT = {"byte_order": "LittleEndian", "header_type": "UInt64", "compressor": None}


@dataclass
class Fields:
    """All elements have the same degree p; their nodes are equidistant in the reference square."""

    points: np.ndarray  # (N, 3): x, r, 0 in um; in a square channel x, y, z
    elements: np.ndarray  # (n, p + 1, p + 1): node numbers, last index along the element's first direction; one more in 3D
    data: dict  # name -> (N,) or (N, 3)

    def at_nodes(self, name, component=None):
        """Values of a field as an array like the elements."""
        values = self.data[name]
        return (values if component is None else values[:, component])[self.elements]


def read_vtu(path, wanted):
    """The grid and the requested fields at its nodes; InputError names what is missing or damaged."""
    try:
        return read_grid(Path(path).read_bytes(), wanted)
    except OSError as error:
        raise InputError(f"{path} cannot be read: {reason(error)}.") from error
    except (ElementTree.ParseError, ValueError, KeyError, AttributeError, TypeError) as error:
        raise InputError(f"{path} is damaged or not a VTU file of rheocyte: {error}.") from error


def read_grid(content, wanted):
    """The only piece of the file; ValueError says what it lacks."""
    appended = content.find(b"<AppendedData")
    first = content.find(b"_", appended) + 1
    if appended < 0 or first == 0 or not content.rstrip().endswith(b"</VTKFile>"):
        raise ValueError("it holds no appended arrays or breaks off")
    root = ElementTree.fromstring(content[:appended] + b"</VTKFile>")
    if any(root.get(key) != value for key, value in LAYOUT.items()):
        raise ValueError("its arrays are laid out in another way")
    piece = root.find("./UnstructuredGrid/Piece")

    def read(place):
        return read_array(content, first, piece.find(place))

    points = read("Points/DataArray")
    data = {name: read(f"PointData/DataArray[@Name='{name}']") for name in wanted}
    if any(len(values) != len(points) for values in data.values()):
        raise ValueError("a field has another number of values than there are points")
    elements = tensor_elements(*(read(f"Cells/DataArray[@Name='{name}']")
                                 for name in ("connectivity", "offsets", "types")))
    if elements.min() < 0 or elements.max() >= len(points):
        raise ValueError("a cell refers to a point that does not exist")
    return Fields(points, elements, data)


def read_array(content, first, array):
    """A DataArray as numpy array, (N,) or (N, components): its length in bytes, then its values."""
    if array is None:
        raise ValueError("an array is missing")
    place, dtype = first + int(array.get("offset")), np.dtype(TYPES[array.get("type")])
    length = int(np.frombuffer(content, "<u8", 1, place)[0])
    values = np.frombuffer(content, dtype, length // dtype.itemsize, place + 8)
    components = int(array.get("NumberOfComponents", 1))
    return values.reshape(-1, components) if components > 1 else values


def tensor_elements(connectivity, offsets, types):
    """Node numbers (n, p + 1, p + 1) of quadrilaterals or (n, p + 1, p + 1, p + 1) of hexahedra, from VTK's order."""
    if len(types) == 0 or (types != types[0]).any() or types[0] not in ORDERS:
        raise ValueError("its cells are not all Lagrange quadrilaterals, nor all hexahedra")
    dimension, position = ORDERS[types[0]]
    sizes = np.diff(offsets, prepend=0)
    nodes = int(round(sizes[0] ** (1 / dimension)))
    if (sizes != sizes[0]).any() or nodes ** dimension != sizes[0] or nodes < 2:
        raise ValueError("its cells are not of one degree")
    return connectivity.reshape(-1, nodes ** dimension)[:, position(nodes - 1)]


def quadrilateral_position(degree):
    """Where node (row, column) stands in VTK's list: corners, edges (bottom, right, top, left), interior rows."""
    inner = degree - 1
    position = np.empty((degree + 1, degree + 1), dtype=int)
    position[0, 0], position[0, -1], position[-1, -1], position[-1, 0] = 0, 1, 2, 3
    edges = 4 + np.arange(4 * inner).reshape(4, inner)
    position[0, 1:-1], position[1:-1, -1], position[-1, 1:-1], position[1:-1, 0] = edges
    position[1:-1, 1:-1] = 4 + 4 * inner + np.arange(inner * inner).reshape(inner, inner)
    return position


def hexahedron_position(degree):
    """Where node (layer, row, column) stands in VTK's list: corners, edges, faces (left, right, front, ...), interior."""
    inner, rim = degree - 1, slice(1, -1)
    flat = quadrilateral_position(degree)
    corner, edge = flat < 4, (flat >= 4) & (flat < 4 + 4 * inner)
    position = np.empty((degree + 1,) * 3, dtype=int)
    for k, layer in enumerate((0, -1)):
        position[layer][corner] = flat[corner] + 4 * k
        position[layer][edge] = flat[edge] + 4 + 4 * inner * k
    for row in (0, -1):
        for column in (0, -1):
            position[rim, row, column] = 8 + 8 * inner + flat[row, column] * inner + np.arange(inner)
    faces, face = 8 + 12 * inner, np.arange(inner * inner).reshape(inner, inner)
    for k, end in enumerate((0, -1)):
        position[rim, rim, end] = faces + k * inner * inner + face
        position[rim, end, rim] = faces + (2 + k) * inner * inner + face
        position[end, rim, rim] = faces + (4 + k) * inner * inner + face
    position[rim, rim, rim] = faces + 6 * inner * inner + np.arange(inner ** 3).reshape(inner, inner, inner)
    return position


ORDERS = {VTK_LAGRANGE_QUADRILATERAL: (2, quadrilateral_position), VTK_LAGRANGE_HEXAHEDRON: (3, hexahedron_position)}
