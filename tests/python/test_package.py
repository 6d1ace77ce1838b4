"""The package beside others: it loads fast and late, next to h5py's HDF5, and draws without its compiled module."""

import ast
import inspect
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import rheocyte

PACKAGE = Path(rheocyte.__file__).parent


def run(code, *arguments, **environment):
    said = subprocess.run([sys.executable, "-B", "-c", code, *arguments], capture_output=True, text=True, check=False,
                          env={**os.environ, **environment})
    assert said.returncode == 0, said.stderr
    return said.stdout


def test_importing_loads_neither_pictures_nor_frames():
    loaded = run("import sys, rheocyte; rheocyte.solve, rheocyte.Table; print(*sys.modules)").split()
    assert "rheocyte.lib.native" in loaded and not {"matplotlib", "pandas", "scipy"} & set(loaded)


@pytest.mark.parametrize("order", ["h5py, rheocyte", "rheocyte, h5py"])
def test_two_hdf5_libraries_live_in_one_process(order, tmp_path):
    pytest.importorskip("h5py")
    code = f"""
import sys, numpy as np, {order}
rheocyte.Table
path = sys.argv[1]
with h5py.File(path, "w") as file:
    file["events/area_um"] = np.linspace(50, 150, 100)
    file["events/deform"] = np.linspace(0.01, 0.03, 100)
    file.attrs["setup:channel width"] = 20.0
for _ in range(3):
    frame = rheocyte.extract(path, flow_rate_ul_s=0.04, viscosity_mPas=15, pixel_size_um=0.34)
    with h5py.File(path) as file:
        assert (file["events/area_um"][:] == frame["area_um2"]).all()
print(frame["young_modulus_kPa"].notna().sum() > 50)
"""
    assert run(code, str(tmp_path / "both.rtdc")).strip() == "True"


def test_pictures_need_no_compiled_module(tmp_path):
    for file in PACKAGE.glob("*.py*"):
        (tmp_path / "rheocyte").mkdir(exist_ok=True)
        (tmp_path / "rheocyte" / file.name).write_bytes(file.read_bytes())
    code = """
import sys; sys.path.insert(0, sys.argv[1])
import rheocyte, rheocyte.picture
from rheocyte import colours
try:
    rheocyte.solve
except ImportError as error:
    print("pip install ." in str(error), rheocyte.__file__.startswith(sys.argv[1]))
"""
    assert run(code, str(tmp_path)).split() == ["True", "True"]


def test_pictures_of_events_use_nothing_that_matplotlib_drops(tmp_path):
    """Contours became one collection in matplotlib 3.8, and the list of collections was dropped in 3.10."""
    events = np.random.default_rng(1).normal([80, 0.04], [10, 0.01], (400, 2)).astype("<f4")
    events.tofile(tmp_path / "events.bin")
    line = {"young_modulus_kPa": 1.0, "area_um2": [20, 80, 150], "deformation": [0.01, 0.04, 0.15]}
    panel = {"events_file": "events.bin", "lines": [line], "title": "a", "sample": "", "measured": "", "events": 400,
             "drawable": 400, "width_um": 20, "pixels": True, "table": "LE-2D-26"}
    (tmp_path / "plot.json").write_text(json.dumps({"panels": [panel]}))
    run("""
import sys, warnings
from rheocyte import event_plot, files
warnings.simplefilter("error")
files.save_figure(event_plot.draw(event_plot.read_panels(sys.argv[1])), event_plot.Path(sys.argv[1]) / "a", 50, svg_dpi=50)
""", str(tmp_path))
    assert (tmp_path / "a.png").stat().st_size > 0 and "</svg>" in (tmp_path / "a.svg").read_text()


def test_every_public_name_explains_itself():
    for name in rheocyte.__all__:
        thing = getattr(rheocyte, name)
        assert name in dir(rheocyte)
        if inspect.isclass(thing) or inspect.isfunction(thing):
            assert thing.__doc__ and len(thing.__doc__.splitlines()[0]) > 10, name
    with pytest.raises(AttributeError):
        rheocyte.sovle


def test_docstrings_of_methods_are_there():
    for owner in (rheocyte.Case, rheocyte.Result, rheocyte.Session, rheocyte.Table, rheocyte.Evolution):
        for name, member in vars(owner).items():
            if not name.startswith("_") and (inspect.isfunction(member) or isinstance(member, property)):
                assert inspect.getdoc(member), f"{owner.__name__}.{name}"


def of_stubs(wanted):
    """(what the package has, its node in the stub) of functions and methods of the given kind."""
    for name in rheocyte.__all__:
        here, stub = getattr(rheocyte, name), PACKAGE / f"{rheocyte._MODULES[name]}.pyi"
        nodes = ast.parse(stub.read_text(encoding="utf-8")).body if stub.exists() else []
        for node in nodes:
            if getattr(node, "name", None) != name or name == "Case":
                continue
            for part in node.body if isinstance(node, ast.ClassDef) else [node]:
                if isinstance(part, ast.FunctionDef) and not part.name.startswith("_") and wanted(part):
                    yield getattr(here, part.name) if part is not node else here, part


def test_stubs_state_the_defaults_of_the_package():
    for function, node in of_stubs(lambda node: not node.decorator_list):
        parameters = inspect.signature(function).parameters
        places = node.args.args[len(node.args.args) - len(node.args.defaults):]
        given = [*zip(places, node.args.defaults), *zip(node.args.kwonlyargs, node.args.kw_defaults)]
        for argument, default in given:
            if default is not None:
                assert parameters[argument.arg].default == ast.literal_eval(default), (function, argument.arg)


def test_what_returns_arrays_tells_their_shape():
    for function, node in of_stubs(lambda node: "NDArray" in ast.unparse(node.returns)):
        text = inspect.getdoc(function)
        assert re.search(r"\((n|N|len\(r_um\)|rows), ?[\w()]*", text), f"{node.name}: {text}"
