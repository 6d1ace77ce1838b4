"""The files of fields as VTK reads them: at random points of each element VTK finds what the state says.

    vtk_test.py PROBES      PROBES is the program of vtk_probes.cc; exit code 77 where Python has no VTK
"""
import csv
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import vtk
except ImportError:
    print("skipped: this Python has no VTK (pip install vtk)")
    sys.exit(77)

PROBES = sys.argv.pop()
# Both sides are polynomials of the same degree; what is left is the rounding of VTK's shape functions.
TOLERANCE = 1e-9


def read_grid(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def probes(path):
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.reader(file):
            yield int(row[0]), [float(value) for value in row[1:]]


def value_at(grid, cell, weights, name):
    """A field at a point of a cell, all components."""
    array = grid.GetPointData().GetArray(name)
    total = [0.0] * array.GetNumberOfComponents()
    for node in range(cell.GetNumberOfPoints()):
        for c, part in enumerate(array.GetTuple(cell.GetPointId(node))):
            total[c] += weights[node] * part
    return total


class Fields(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        subprocess.run([PROBES, cls.folder.name], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def check(self, name, dim, fields):
        """`fields`: name and components of each field behind the place."""
        grid = read_grid(Path(self.folder.name, name + ".vtu"))
        checked = 0
        for element, numbers in probes(Path(self.folder.name, name + ".csv")):
            cell = grid.GetCell(element)
            xi, expected = numbers[:dim] + [0] * (3 - dim), numbers[dim:]
            place, weights = [0.0] * 3, [0.0] * cell.GetNumberOfPoints()
            cell.EvaluateLocation(vtk.reference(0), xi, place, weights)
            found = place[:dim]
            for field, components in fields:
                found += value_at(grid, cell, weights, field)[:components]
            for a, b in zip(found, expected, strict=True):
                self.assertAlmostEqual(a, b, delta=TOLERANCE * max(1, abs(b)))
            checked += 1
        self.assertGreater(checked, grid.GetNumberOfCells())

    def test_the_channel_at_several_degrees(self):
        for degree in (2, 4, 7):
            self.check(f"channel-{degree}", 2, (("velocity", 2), ("displacement", 2), ("pressure", 1)))

    def test_hexahedra_at_several_degrees(self):
        for degree in (2, 3, 4):
            self.check(f"hexahedra-{degree}", 3, (("field", 1),))

    def test_every_named_field_is_there(self):
        data = read_grid(Path(self.folder.name, "channel-4.vtu")).GetPointData()
        for name in ("velocity", "velocity_relative", "pressure", "stress", "shear_stress", "displacement", "region"):
            self.assertIsNotNone(data.GetArray(name), name)


if __name__ == "__main__":
    unittest.main()
