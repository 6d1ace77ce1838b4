"""The cell's surface in a square channel or a rectangle, from the fields of the part that was computed."""

import numpy as np

# (layer, row, column) of the faces of a hexahedron.
FACES = [(slice(None), slice(None), 0), (slice(None), slice(None), -1), (slice(None), 0, slice(None)),
         (slice(None), -1, slice(None)), (0, slice(None), slice(None)), (-1, slice(None), slice(None))]
# What the symmetries of the section do to (y, z); the part that is computed is an eighth of a square, or a quarter.
SIGNS = [np.diag([a, b]) for a in (1, -1) for b in (1, -1)]
SWAP = np.array([[0, 1], [1, 0]])
IMAGES = {"square": [sign @ swap for sign in SIGNS for swap in (np.eye(2), SWAP)], "rectangle": SIGNS}


def images_of(case):
    """What makes the whole cell, in width and height, from the part that was computed: matrices of its (y, z)."""
    width, height = case["cell"].get("offset_um") or (0, 0)
    if width == 0 and height == 0:
        is_funnel = "profile" in case["channel"]  # whose width is not a height
        return IMAGES["rectangle" if is_funnel else case["channel"]["section"]]
    # The half of a cell off the axis lies along y, its mirror plane is z = 0.
    return [(SWAP if height else np.eye(2)) @ np.diag([1, sign]) for sign in (1, -1)]


def is_off_axis(images):
    """Whether these are those of a cell off the axis."""
    return len(images) == 2


def surface_faces(fields):
    """Nodes of the faces between cell and liquid, (m, p + 1, p + 1, 3): x, y, z in um, equidistant in the reference square."""
    in_cell = fields.at_nodes("region")[:, 0, 0, 0] > 0.5
    nodes = fields.points[fields.elements]
    size = np.ptp(fields.points[:, 1])

    def middles(elements):
        return [(tuple(np.round(face[[0, 0, -1, -1], [0, -1, 0, -1]].mean(axis=0) / size, 7) + 0.0), face)
                for element in elements for face in (element[place] for place in FACES)]

    wet = {middle for middle, _ in middles(nodes[~in_cell])}
    return np.array([face for middle, face in middles(nodes[in_cell]) if middle in wet])


def refined(faces, count, middle=0.0):
    """Points and outward normals (m, count, count, 3) of the polynomial faces of a cell whose middle has this y."""
    degree = faces.shape[1] - 1
    equidistant, fine = np.linspace(0, 1, degree + 1), np.linspace(0, 1, count)
    powers = np.arange(degree + 1)
    to_powers = np.linalg.inv(np.vander(equidistant, increasing=True))
    value = fine[:, None] ** powers @ to_powers
    slope = powers * fine[:, None] ** np.maximum(powers - 1, 0) @ to_powers

    def at(first, second):
        return np.einsum("ai,bj,mijc->mabc", first, second, faces, optimize=True)

    points, normals = at(value, value), np.cross(at(value, slope), at(slope, value))
    normals /= np.maximum(np.linalg.norm(normals, axis=-1, keepdims=True), 1e-30)
    centre = np.array([(faces[..., 0].min() + faces[..., 0].max()) / 2, middle, 0])
    inward = np.einsum("mabc,mabc->m", normals, points - centre) < 0
    normals[inward] *= -1
    return points, normals


def whole(points, images):
    """All images of points or normals (m, a, b, 3) of the computed part, (m times their number, a, b, 3)."""
    return np.concatenate([np.concatenate([points[..., :1], points[..., 1:] @ image.T], axis=-1) for image in images])


def silhouettes(faces, images, camera_degree=None):
    """Outlines (n, 2) of x and the place across the flow: from the side, of a square along the diagonal, from the camera.

    Cells off the axis are seen along their offset alone.
    """
    seen = {"side": 0} | ({"diagonal": 45} if len(images) == len(IMAGES["square"]) else {})
    if is_off_axis(images) and camera_degree:
        seen = {}
    if camera_degree is not None and camera_degree not in seen.values():
        seen[f"{camera_degree:g}°"] = camera_degree
    points = whole(refined(faces, 24)[0], images).reshape(-1, 3)

    def outline(degrees):
        across = points[:, 1:] @ [np.cos(np.radians(degrees)), np.sin(np.radians(degrees))]
        return ring(np.column_stack([points[:, 0], across]))

    return {name: outline(degrees) for name, degrees in seen.items()}


def front_view(faces, images):
    """Outline (n, 2) in y and z of the cell seen along the channel."""
    return ring(whole(refined(faces, 24)[0], images).reshape(-1, 3)[:, 1:])


def ring(points, sectors=2000):
    """The closed convex outline, as cameras see such cells, of the farthest points in all directions."""
    from rheocyte.contour import convex_hull

    away = points - points.mean(axis=0)
    sector = (np.arctan2(away[:, 1], away[:, 0]) * (sectors / (2 * np.pi))).astype(int)
    order = np.lexsort((np.hypot(*away.T), sector))
    farthest = points[order[np.flatnonzero(np.diff(sector[order], append=sectors))]]
    outline = farthest[convex_hull(farthest)]
    return np.concatenate([outline, outline[:1]])
