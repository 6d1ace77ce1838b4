"""The cell's surface in a square channel, from the fields of one eighth of it."""

import numpy as np

# (layer, row, column) of the faces of a hexahedron.
FACES = [(slice(None), slice(None), 0), (slice(None), slice(None), -1), (slice(None), 0, slice(None)),
         (slice(None), -1, slice(None)), (0, slice(None), slice(None)), (-1, slice(None), slice(None))]
# The square's symmetries: what they do to (y, z).
IMAGES = [np.array([[a, 0], [0, b]]) @ swap for a in (1, -1) for b in (1, -1)
          for swap in (np.eye(2), np.array([[0, 1], [1, 0]]))]


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


def refined(faces, count):
    """Points and outward normals (m, count, count, 3) of the polynomial faces."""
    degree = faces.shape[1] - 1
    equidistant, fine = np.linspace(0, 1, degree + 1), np.linspace(0, 1, count)
    powers = np.arange(degree + 1)
    to_powers = np.linalg.inv(np.vander(equidistant, increasing=True))
    value = fine[:, None] ** powers @ to_powers
    slope = powers * fine[:, None] ** np.maximum(powers - 1, 0) @ to_powers
    points = np.einsum("ai,bj,mijc->mabc", value, value, faces)
    normals = np.cross(np.einsum("ai,bj,mijc->mabc", value, slope, faces), np.einsum("ai,bj,mijc->mabc", slope, value, faces))
    normals /= np.maximum(np.linalg.norm(normals, axis=-1, keepdims=True), 1e-30)
    centre = np.array([(faces[..., 0].min() + faces[..., 0].max()) / 2, 0, 0])
    inward = np.einsum("mabc,mabc->m", normals, points - centre) < 0
    normals[inward] *= -1
    return points, normals


def whole(points):
    """All eight images of an eighth, (8 n, 3)."""
    flat = points.reshape(-1, 3)
    return np.concatenate([np.column_stack([flat[:, 0], flat[:, 1:] @ image.T]) for image in IMAGES])


def silhouettes(faces):
    """Meridians (n, 2) of x and the distance from the axis, front pole first: seen from the side and along the diagonal."""
    points = refined(faces, 24)[0].reshape(-1, 3)
    x, y, z = points.T
    distance, middle = np.hypot(y, z), (x.min() + x.max()) / 2
    tolerance = 1e-9 * np.ptp(x)

    def meridian(chosen):
        order = np.argsort(np.arctan2(distance[chosen], x[chosen] - middle), kind="stable")
        return np.stack([x[chosen], distance[chosen]], axis=1)[order]

    return {"side": meridian(np.abs(z) < tolerance), "diagonal": meridian(np.abs(y - z) < tolerance)}


def front_view(faces):
    """Outline (n, 2) in y and z of the cell seen along the channel; convex, as such cells are."""
    from rheocyte.contour import convex_hull

    points = whole(refined(faces, 24)[0])[:, 1:]
    outline = points[convex_hull(points)]
    return np.concatenate([outline, outline[:1]])
