"""Solving in Python gives what the command line gives, keeps Python's lock free, and ends by Ctrl-C."""

import concurrent.futures
import json
import multiprocessing
import subprocess
import sys
import threading

import numpy as np
import pandas
import pytest

import rheocyte
from rheocyte import Case, NoStateError, Session, UserError
from rheocyte.worker_threads import threads_of


def test_the_result_has_the_numbers_of_result_json(state):
    written = state.to_dict()
    assert state.converged and state.status == "converged"
    assert {"deformation", "area_um2", "cell_velocity_m_per_s", "estimated_error", "case_hash"} <= set(state.keys())
    for name, value in written.items():
        if name != "case":
            assert getattr(state, name) == state[name] == value
    assert "deformation" in dir(state)
    with pytest.raises(AttributeError, match="deformaton"):
        state.deformaton


def test_the_command_line_gives_the_same_numbers(state, program, tmp_path):
    (tmp_path / "case.toml").write_text(state.problem.to_toml())
    subprocess.run([program, "solve", tmp_path / "case.toml", "-o", tmp_path / "r", "--quiet", "--no-picture"], check=True)
    other = json.loads((tmp_path / "r" / "result.json").read_text())
    for name in ("deformation", "area_um2", "pressure_drop_Pa", "case_hash"):
        assert other[name] == state[name]  # one library, one case, any number of threads: equal to the last bit
    table = np.genfromtxt(tmp_path / "r" / "contour.csv", delimiter=",", names=True)
    assert np.allclose(state.contour[:, 0], table["x_um"], rtol=1e-9, atol=1e-9)  # ten digits in the file


def test_the_contour_encloses_the_volume_of_the_sphere(state):
    x, r = state.contour.T
    assert np.abs(r[[0, -1]]).max() < 1e-12 and (r >= 0).all() and x[0] > x[-1]  # poles up to rounding
    volume = -np.pi * np.trapezoid(r**2, x) if hasattr(np, "trapezoid") else -np.pi * np.trapz(r**2, x)
    assert volume == pytest.approx(4 / 3 * np.pi * 7.66**3, rel=1e-3)  # trapezoids on some hundred points


@pytest.mark.parametrize("offset_um, names", [([0, 0], {"side", "diagonal"}), ([0, 1], {"offset"})])
def test_what_else_is_seen_of_a_cell_in_a_duct_are_the_files_of_the_command(state, program, tmp_path, offset_um, names):
    case = {"channel": {"section": "square", "width_um": 20}, "flow": {"rate_ul_per_s": 0.04, "viscosity_mPas": 6},
            "cell": {"radius_um": 6, "offset_um": offset_um, "bulk": {"young_modulus_kPa": 4}}, "numerics": {"accuracy": 0.1}}
    seen = rheocyte.solve(case)
    assert {*state.outlines} == set() and {*seen.outlines} == names
    (tmp_path / "case.toml").write_text(seen.problem.to_toml())
    subprocess.run([program, "solve", "case.toml", "--quiet", "--no-picture", "-o", "out"], cwd=tmp_path, check=True)
    for name, outline in seen.outlines.items():
        columns = pandas.read_csv(tmp_path / "out" / f"contour_{name}.csv")
        assert outline == pytest.approx(columns[["x_um", "y_um" if name == "offset" else "r_um"]].to_numpy(), abs=1e-8)


def test_fields_on_a_grid_vanish_at_the_wall_and_move_with_the_cell(state):
    mesh = state.fields()
    assert set(mesh.data) >= {"velocity", "pressure", "stress", "displacement"}
    radius = state.tube_radius_um
    grid = state.fields(np.linspace(-5, 5, 41), np.linspace(0, 0.999 * radius, 50))
    assert grid["velocity"].shape == (50, 41, 2) and grid["pressure"].shape == (50, 41)
    assert grid["region"][0, 20] == pytest.approx(1)
    assert grid["velocity"][0, 20, 0] == pytest.approx(state.cell_velocity_m_per_s, rel=1e-6)
    assert np.abs(grid["velocity"][-1]).max() < 0.01 * state.cell_velocity_m_per_s
    for x in (None, [0, 1, 3], [1, 0], ["a", "b"]):
        with pytest.raises(UserError):
            state.fields(x, np.linspace(0, 5, 5))


def test_a_session_starts_from_its_states_and_answers_the_same(paper):
    session, case = Session(), Case(paper)
    for modulus in (4.0, 4.1, 4.2):
        case.cell.bulk.young_modulus_kPa = modulus
        warm = session.solve(case)
    cold = rheocyte.solve(case)
    assert session.warm_starts == 2 and session.memory_bytes > 0
    assert warm.deformation == pytest.approx(cold.deformation, rel=2e-3)  # the accuracy that the case asks for
    assert warm.case["cell"]["bulk"]["young_modulus_kPa"] == 4.2


def test_all_numbers_of_a_session_are_those_of_a_state_from_nothing(paper):
    session, case = Session(), Case(paper)
    for radius, modulus in [(6.9, 4.0), (6.2, 4.0), (5.6, 4.2), (5.8, 4.1)]:
        case.cell.radius_um, case.cell.bulk.young_modulus_kPa = radius, modulus
        warm, cold = session.solve(case), rheocyte.solve(case)
        for name, error in warm.errors.items():
            if error is not None:
                assert warm[name] == pytest.approx(cold[name], rel=1e-9, abs=error), name  # rounding, or the stated error
    assert session.warm_starts == 3


def test_a_state_that_does_not_exist_is_a_result_and_raises_on_check(paper):
    paper["cell"]["bulk"] = {"young_modulus_kPa": 0.2}
    result = rheocyte.solve(paper)
    assert not result.converged and 0 < result.reached < 1 and result.message
    assert np.isfinite(result.contour).all()
    with pytest.raises(NoStateError) as caught:
        rheocyte.solve(paper, check=True)
    assert caught.value.result.status == result.status and result.status in str(caught.value)


def test_progress_is_told_and_its_exceptions_come_through(paper):
    steps = []
    rheocyte.solve(paper, progress=steps.append)
    assert steps[-1]["compliance"] == 1 and steps[-1]["deformation"] > 0

    def fail(step):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        rheocyte.solve(paper, progress=fail)


def test_threads_solve_side_by_side(paper):
    cases = [Case(paper, young_modulus_kPa=modulus) for modulus in (4, 8)]
    alone = [rheocyte.solve(case).deformation for case in cases]
    found = [None, None]

    def work(i):
        found[i] = rheocyte.solve(cases[i]).deformation

    threads = [threading.Thread(target=work, args=(i,)) for i in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == alone


def test_a_case_in_time_is_not_solved_and_a_stationary_one_not_followed(paper):
    with pytest.raises(UserError, match="evolve"):
        rheocyte.solve(paper, time__end_us=10, cell__viscosity_mPas=15)
    with pytest.raises(UserError, match="time.end_us"):
        rheocyte.evolve(paper)


def test_states_in_time_come_one_by_one(paper):
    way = rheocyte.evolve(paper, time__end_us=20, time__output_every_us=10, cell__viscosity_mPas=15, time__degree=4)
    states = list(way)
    assert [round(s.t_us, 9) for s in states] == [0, 10, 20]
    assert states[0].deformation == pytest.approx(0, abs=1e-6)  # the sphere
    assert states[2].deformation > states[1].deformation > 0 and states[2].contour.shape[1] == 2
    assert way.result.converged and way.check() is way
    assert way.history["t_us"].iloc[-1] == pytest.approx(20) and "deformation" in way.history


def test_a_way_that_ends_beyond_the_limit_of_stability_has_not_converged(paper):
    # A shell without tension, slack at its rear: the status of `rheocyte solve`, and no state for check().
    way = rheocyte.evolve(paper, cell__bulk__law="none", cell__cortex__law="neo-hookean", cell__viscosity_mPas=15,
                          cell__cortex__modulus_mN_per_m=20, time__end_us=5, time__degree=3)
    assert way.result.status == "surface-unstable" and way.result.stability_margin < 0
    assert "also so at the end" in way.result.message
    with pytest.raises(NoStateError, match="surface-unstable"):
        way.check()


def test_a_way_that_is_stopped_keeps_what_was_computed(paper):
    way = rheocyte.evolve(paper, time__end_us=1e5, time__output_every_us=1e3, cell__viscosity_mPas=15, time__degree=4)
    first = next(way)
    way.stop()
    assert first.t_us == 0 and way.result.status == "stopped"
    with pytest.raises(NoStateError, match="stopped"):
        way.check()


INTERRUPTED = """
import os, signal, sys, rheocyte
signal.signal(signal.SIGINT, signal.default_int_handler)  # shells start what runs in the background without it
case = rheocyte.Case(sys.argv[1], numerics__accuracy=1e-7)
sent = []
def interrupt_once(step):
    if not sent:
        sent.append(step)
        os.kill(os.getpid(), signal.SIGINT)
try:
    rheocyte.solve(case, progress=interrupt_once)
except KeyboardInterrupt:
    print("interrupted")
print(rheocyte.solve(case, numerics__accuracy=1e-3).converged)
"""


def test_ctrl_c_ends_a_computation_and_python_goes_on(paper, tmp_path):
    (tmp_path / "case.toml").write_text(Case(paper).to_toml())
    said = subprocess.run([sys.executable, "-c", INTERRUPTED, tmp_path / "case.toml"], capture_output=True, text=True)
    assert (said.stdout.split(), said.stderr) == (["interrupted", "True"], "")


def test_the_picture_stands_in_notebooks(state):
    html = state._repr_html_()
    assert html.startswith("<img") and "base64" in html
    assert state.plot().axes


def test_fields_are_saved_as_the_command_line_writes_them(state, tmp_path):
    from rheocyte.vtu import read_vtu

    state.save_fields(tmp_path / "fields.vtu")
    again = read_vtu(tmp_path / "fields.vtu", ["pressure"])
    assert np.array_equal(again.data["pressure"], state.fields().data["pressure"])
    with pytest.raises(UserError, match="cannot be written"):
        state.save_fields(tmp_path / "nowhere" / "fields.vtu")
    for wrong in (None, 1, "a\0b"):  # 1 would be standard output
        with pytest.raises(UserError, match="not a path"):
            state.save_fields(wrong)


def test_gradients_are_those_of_the_numbers():
    flow = {"rate_ul_per_s": 0.04, "viscosity_mPas": 15}
    cell = {"radius_um": 6.0, "bulk": {"young_modulus_kPa": 2.0}}
    case = Case({"channel": {"width_um": 20}, "flow": flow, "cell": cell, "numerics": {"accuracy": 1e-4}})
    state = rheocyte.solve(case, gradient=["cell.radius_um", "cell.bulk.young_modulus_kPa"])
    assert list(state.gradient) == ["cell.radius_um", "cell.bulk.young_modulus_kPa"]
    step = 1e-3
    larger = rheocyte.solve(case, **{"cell.radius_um": 6 + step})
    smaller = rheocyte.solve(case, **{"cell.radius_um": 6 - step})
    slope = (larger.deformation - smaller.deformation) / (2 * step)
    assert state.gradient["cell.radius_um"]["deformation"] == pytest.approx(slope, rel=1e-5)
    assert state.gradient["cell.radius_um"]["drift_velocity_m_per_s"] is None
    moved = state.surface_gradient("cell.radius_um")
    assert np.allclose(moved["r_um"], (larger.surface["r_um"] - smaller.surface["r_um"]) / (2 * step), atol=1e-5)
    assert list(rheocyte.solve(case, gradient="cell.radius_um").gradient) == ["cell.radius_um"]
    assert rheocyte.solve(case).gradient == {}
    with pytest.raises(UserError, match="did you mean cell.radius_um"):
        rheocyte.solve(case, gradient=["cell.radius"])
    with pytest.raises(UserError, match="no gradient by 'flow.rate_ul_per_s'"):
        state.surface_gradient("flow.rate_ul_per_s")


@pytest.mark.parametrize("section, accuracy", [("square", 0.02), ("tube", 1e-4)])
def test_the_numbers_do_not_depend_on_the_number_of_threads(section, accuracy):
    case = Case({"channel": {"width_um": 20, "section": section}, "flow": {"rate_ul_per_s": 0.04, "viscosity_mPas": 15},
                 "cell": {"radius_um": 6}}, young_modulus_kPa=8, numerics__accuracy=accuracy)
    alone, together, by_default = (rheocyte.solve(case, threads=threads) for threads in (1, 3, None))
    assert alone.converged
    assert alone.deformation == together.deformation == by_default.deformation
    assert (alone.contour == together.contour).all() and (alone.contour == by_default.contour).all()


@pytest.mark.parametrize("threads", [0, -1, 1.5, "many"])
def test_a_number_of_threads_is_a_whole_one_from_1_on(paper, threads):
    with pytest.raises(UserError, match="threads is"):
        rheocyte.solve(paper, threads=threads)


def test_workers_of_pools_take_one_thread_each():
    assert threads_of(None) == 0  # all processors
    with concurrent.futures.ThreadPoolExecutor(1) as pool:
        assert pool.submit(threads_of, None).result() == 1
        assert pool.submit(threads_of, 3).result() == 3
    with concurrent.futures.ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        assert pool.submit(threads_of, None).result() == 1
