"""The notebooks run from their first cell to the last, and stand in the tree with what they print."""

import itertools

import pytest
from conftest import TOP

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")
pytest.importorskip("ipykernel")


def kinds(outputs):
    """Of what a cell gives; into how many pieces its text falls depends on the kernel's haste."""
    return [kind for kind, _ in itertools.groupby(output.output_type for output in outputs)]


@pytest.mark.parametrize("path", [pytest.param(path, id=path.stem) for path in sorted((TOP / "examples/notebooks").glob("*.ipynb"))])
def test_a_notebook_runs(path, monkeypatch):
    monkeypatch.setenv("MPLBACKEND", "module://matplotlib_inline.backend_inline")  # as in a notebook that is looked at
    notebook = nbformat.read(path, as_version=4)
    stored = [cell.outputs for cell in notebook.cells if cell.cell_type == "code"]
    assert all(stored), "execute the notebook before it is kept"
    nbclient.NotebookClient(notebook, timeout=600, kernel_name="python3").execute()
    executed = [cell.outputs for cell in notebook.cells if cell.cell_type == "code"]
    assert [kinds(outputs) for outputs in executed] == [kinds(outputs) for outputs in stored]
