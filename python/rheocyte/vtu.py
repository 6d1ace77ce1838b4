"""A small reader for the .vtu files that rheocyte writes: quadrilaterals of any degree with fields at their nodes."""

import base64
import binascii
import xml.etree.ElementTree as ElementTree
import zlib
from dataclasses import dataclass

import numpy as np

from rheocyte.files import InputError, reason

VTK_QUAD, VTK_LAGRANGE_QUADRILATERAL = 9, 70
TYPES = {"Float32": "f4", "Float64": "f8", "Int8": "i1", "UInt8": "u1", "Int16": "i2", "UInt16": "u2",
         "Int32": "i4", "UInt32": "u4", "Int64": "i8", "UInt64": "u8"}


@dataclass
class Fields:
    """All elements have the same degree p; their nodes are equidistant in the reference square."""

    points: np.ndarray  # (N, 3): x, r, 0 in um
    elements: np.ndarray  # (n, p + 1, p + 1): node numbers, second index along the element's first direction
    data: dict  # name -> (N,) or (N, 3)

    @property
    def degree(self):
        return self.elements.shape[1] - 1

    def at_nodes(self, name, component=None):
        """Values of a field as an array (n, p + 1, p + 1)."""
        values = self.data[name]
        return (values if component is None else values[:, component])[self.elements]


def read_vtu(path, wanted=()):
    """Reads inline ascii, base64 and zlib-compressed base64 arrays; InputError names what is missing or damaged."""
    try:
        root = ElementTree.parse(path).getroot()
        return read_grid(root, wanted)
    except OSError as error:
        raise InputError(f"{path} cannot be read: {reason(error)}.") from error
    except (ElementTree.ParseError, zlib.error, binascii.Error, ValueError, KeyError, IndexError) as error:
        raise InputError(f"{path} is damaged or not a VTU file of rheocyte: {error}.") from error


def read_grid(root, wanted):
    """The only piece of the file; ValueError says what it lacks."""
    pieces = root.findall("./UnstructuredGrid/Piece")
    if len(pieces) != 1:
        raise ValueError(f"it holds {len(pieces)} pieces instead of one unstructured grid")
    arrays = {(parent.tag, array.get("Name") if parent.tag != "Points" else "points"): read_array(array, root.attrib)
              for parent in pieces[0] for array in parent.iter("DataArray")}
    points = arrays["Points", "points"]
    data = {name: values for (parent, name), values in arrays.items() if parent == "PointData"}
    missing = [name for name in wanted if name not in data]
    if missing:
        raise ValueError(f"the field \"{missing[0]}\" is missing")
    if any(len(values) != len(points) for values in data.values()):
        raise ValueError("a field has another number of values than there are points")
    elements = tensor_elements(*(arrays["Cells", name] for name in ("connectivity", "offsets", "types")))
    if elements.min() < 0 or elements.max() >= len(points):
        raise ValueError("a cell refers to a point that does not exist")
    return Fields(points, elements, data)


def read_array(array, attributes):
    """One DataArray as numpy array, (N,) or (N, components)."""
    order = "<" if attributes.get("byte_order", "LittleEndian") == "LittleEndian" else ">"
    dtype = np.dtype(order + TYPES[array.get("type")])
    text = array.text or ""
    if array.get("format", "ascii") == "ascii":
        values = np.array(text.split(), dtype=float).astype(dtype)
    elif array.get("format") == "binary":
        header = np.dtype(order + TYPES[attributes.get("header_type", "UInt32")])
        values = np.frombuffer(decode("".join(text.split()), header, attributes.get("compressor")), dtype)
    else:
        raise ValueError(f"arrays of format \"{array.get('format')}\" are not read here")
    components = int(array.get("NumberOfComponents", 1))
    return values.reshape(-1, components) if components > 1 else values


def decode(text, header, compressor):
    """Bytes of a base64 array; the header (one length, or the lengths of the compressed blocks) is encoded apart."""
    if compressor is None:
        data = base64.b64decode(text)
        length = int(np.frombuffer(data, header, 1)[0])
        return data[header.itemsize:header.itemsize + length]
    if compressor != "vtkZLibDataCompressor":
        raise ValueError(f"the compressor \"{compressor}\" is not known here")
    blocks = int(np.frombuffer(base64.b64decode(text[:16]), header, 1)[0])
    if blocks == 0:
        return b""
    header_characters = -(-(3 + blocks) * header.itemsize // 3) * 4
    sizes = np.frombuffer(base64.b64decode(text[:header_characters]), header, 3 + blocks)[3:]
    data = base64.b64decode(text[header_characters:])
    ends = np.cumsum(sizes, dtype=int)
    return b"".join(zlib.decompress(data[end - size:end]) for end, size in zip(ends, sizes))


def tensor_elements(connectivity, offsets, types):
    """Node numbers (n, p + 1, p + 1) from VTK's order: corners, edges (bottom, right, top, left), interior rows."""
    if len(types) == 0 or not set(np.unique(types)) <= {VTK_QUAD, VTK_LAGRANGE_QUADRILATERAL}:
        raise ValueError("its cells are not quadrilaterals")
    sizes = np.diff(np.asarray(offsets, dtype=int), prepend=0)
    nodes = int(round(np.sqrt(sizes[0])))
    if (sizes != sizes[0]).any() or nodes * nodes != sizes[0] or nodes < 2:
        raise ValueError("its cells are not quadrilaterals of one degree")
    listed = np.asarray(connectivity, dtype=int).reshape(-1, nodes * nodes)
    return listed[:, vtk_position(nodes - 1)]


def vtk_position(degree):
    """Where node (row, column) of a tensor grid stands in VTK's list of a Lagrange quadrilateral."""
    inner = degree - 1
    position = np.empty((degree + 1, degree + 1), dtype=int)
    position[0, 0], position[0, -1], position[-1, -1], position[-1, 0] = 0, 1, 2, 3
    edges = 4 + np.arange(4 * inner).reshape(4, inner)
    position[0, 1:-1], position[1:-1, -1], position[-1, 1:-1], position[1:-1, 0] = edges
    position[1:-1, 1:-1] = 4 + 4 * inner + np.arange(inner * inner).reshape(inner, inner)
    return position
