"""Tables by other people's engines: the same files as by threads, also where a worker is lost."""

import concurrent.futures
import os
import signal

import pytest

import rheocyte

SPEC = {"channel.width_um": 20.0, "flow.rate_ul_per_s": 0.04, "flow.viscosity_mPas": 15.0, "cell.bulk.law": "linear",
        "table.identifier": "TEST", "table.min_area_um2": 60, "table.max_area_um2": 120, "table.max_deformation": 0.002,
        "table.radii": 4, "table.rows_per_radius": 10, "table.accuracy": 1e-3}


@pytest.fixture(scope="module")
def by_threads(tmp_path_factory):
    folder = tmp_path_factory.mktemp("by-threads") / "table"
    rheocyte.table(SPEC, folder)
    return contents(folder)


def contents(folder):
    return {file.name: file.read_bytes() for file in folder.iterdir() if file.is_file()}


def test_a_process_pool_makes_the_table_of_threads(tmp_path, by_threads):
    fractions = []
    with concurrent.futures.ProcessPoolExecutor(2) as pool:
        table = rheocyte.table(SPEC, tmp_path / "table", executor=pool, progress=fractions.append)
    assert table.identifier == "TEST" and fractions[-1] == 1 and fractions == sorted(fractions)
    assert contents(tmp_path / "table") == by_threads


def test_a_cluster_of_dask_that_loses_a_worker_makes_it_too(tmp_path, by_threads):
    distributed = pytest.importorskip("distributed", reason="dask's distributed is not installed")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            victim = sorted(client.run(os.getpid).values())[0]

            def kill_once(fraction, killed=[]):
                if fraction < 1 and not killed:
                    killed.append(victim)
                    os.kill(victim, signal.SIGKILL)

            rheocyte.table(SPEC, tmp_path / "table", executor=client.get_executor(), progress=kill_once)
    assert contents(tmp_path / "table") == by_threads


def test_a_pool_that_breaks_down_is_told_and_the_table_goes_on(tmp_path, by_threads):
    with concurrent.futures.ProcessPoolExecutor(1, initializer=os._exit, initargs=(1,)) as pool:
        with pytest.raises(rheocyte.UserError, match="executor has broken down.*call again"):
            rheocyte.table(SPEC, tmp_path / "table", executor=pool)
    rheocyte.table(SPEC, tmp_path / "table")
    assert contents(tmp_path / "table") == by_threads


def test_jobs_are_those_of_the_executor(tmp_path):
    with concurrent.futures.ProcessPoolExecutor(1) as pool:
        with pytest.raises(rheocyte.UserError, match="give executor or jobs"):
            rheocyte.table(SPEC, tmp_path / "table", executor=pool, jobs=2)
