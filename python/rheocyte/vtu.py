"""A small reader for the .vtu files that rheocyte writes: Lagrange quadrilaterals of any degree, raw appended arrays."""

import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from rheocyte.errors import InputError, reason

VTK_LAGRANGE_QUADRILATERAL = 70
TYPES = {"Float32": "<f4", "Float64": "<f8", "UInt8": "u1", "Int32": "<i4", "Int64": "<i8"}
LAYOUT = {"byte_order": "LittleEndian", "header_type": "UInt64", "compressor": None}


@dataclass
class Fields:
    """All elements have the same degree p; their nodes are equidistant in the reference square."""

    points: np.ndarray  # (N, 3): x, r, 0 in um
    elements: np.ndarray  # (n, p + 1, p + 1): node numbers, second index along the element's first direction
    data: dict  # name -> (N,) or (N, 3)

    def at_nodes(self, name, component=None):
        """Values of a field as an array (n, p + 1, p + 1)."""
        values = self.data[name]
        return (values if component is None else values[:, component])[self.elements]


def read_vtu(path, wanted):
    """The grid and the wanted fields at its nodes; InputError names what is missing or damaged."""
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
    """Node numbers (n, p + 1, p + 1) from VTK's order: corners, edges (bottom, right, top, left), interior rows."""
    if len(types) == 0 or (types != VTK_LAGRANGE_QUADRILATERAL).any():
        raise ValueError("its cells are not Lagrange quadrilaterals")
    sizes = np.diff(offsets, prepend=0)
    nodes = int(round(np.sqrt(sizes[0])))
    if (sizes != sizes[0]).any() or nodes * nodes != sizes[0] or nodes < 2:
        raise ValueError("its cells are not quadrilaterals of one degree")
    return connectivity.reshape(-1, nodes * nodes)[:, vtk_position(nodes - 1)]


def vtk_position(degree):
    """Where node (row, column) of a tensor grid stands in VTK's list of a Lagrange quadrilateral."""
    inner = degree - 1
    position = np.empty((degree + 1, degree + 1), dtype=int)
    position[0, 0], position[0, -1], position[-1, -1], position[-1, 0] = 0, 1, 2, 3
    edges = 4 + np.arange(4 * inner).reshape(4, inner)
    position[0, 1:-1], position[1:-1, -1], position[-1, 1:-1], position[1:-1, 0] = edges
    position[1:-1, 1:-1] = 4 + 4 * inner + np.arange(inner * inner).reshape(inner, inner)
    return position
