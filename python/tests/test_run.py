"""A case run to its folder is the run of the program."""

import json
import os
import subprocess
import sys
import textwrap
import time
from pathlib import Path

import numpy as np
import pytest
import seiche

CASE = """
[problem]
name = "klein_gordon"
[method]
name = "seisav"
h = "1/16"
[time]
end = 2.0
[output]
snapshot_every = 8
"""


@pytest.fixture
def case(tmp_path):
    file = tmp_path / "case.toml"
    file.write_text(CASE)
    return file


def test_a_case_leaves_the_files_of_the_program(case, tmp_path):
    run = seiche.run(case, tmp_path / "out")
    names = {path.name for path in (tmp_path / "out").iterdir()}
    assert {"case.toml", "energy.csv", "final.txt", "solution.h5", "solution.xdmf", "summary.json", "report.html"} <= names
    assert run.success and run.status == "success" and run.steps == 32 and run.folder == tmp_path / "out"
    assert json.loads((tmp_path / "out" / "summary.json").read_text()) == {k: v for k, v in run.items() if k not in ("notes", "folder")}


def test_it_takes_the_steps_of_solve(case, tmp_path):
    seiche.run(case, tmp_path / "out")
    final = np.loadtxt(tmp_path / "out" / "final.txt").ravel()
    result = seiche.solve(seiche.load(case))
    assert (final == result.y[:, -1]).all()


def test_keys_are_replaced_by_name(case, tmp_path):
    assert seiche.run(case, tmp_path / "out", **{"time.end": 1.0}).steps == 16
    assert seiche.run(seiche.load(case, **{"time.end": 0.5}), tmp_path / "other").steps == 8
    with pytest.raises(ValueError, match="time.end: give keys to replace to seiche.load"):
        seiche.run(seiche.load(case), tmp_path / "third", **{"time.end": 0.5})


def test_an_ensemble_leaves_its_tables(case, tmp_path):
    case.write_text(CASE.replace("snapshot_every = 8", "") + "[ensemble]\nmembers = 3\nperturb_initial = 1e-3\n")
    run = seiche.run(case, tmp_path / "out", threads=2)
    assert run.members == 3 and run.statuses["success"] == 3 and run.notes == []
    assert {"members.csv", "finals.csv", "energy.csv"} <= {path.name for path in (tmp_path / "out").iterdir()}


def test_a_folder_of_others_is_refused(case, tmp_path):
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "energy.csv").write_text("mine")
    with pytest.raises(ValueError, match="energy.csv"):
        seiche.run(case, tmp_path / "out")


def test_a_failure_is_a_status_with_what_was_computed(case, tmp_path):
    blow_up = 'initial = { u = "5", v = "0" }\n[method]'  # in finite time: V is unbounded below
    case.write_text(CASE.replace("[method]", blow_up).replace("end = 2.0", "end = 50.0"))
    run = seiche.run(case, tmp_path / "out")
    assert run.status == "failed" and not run.success and 0 < run.t < 50
    assert (tmp_path / "out" / "final.txt").exists()


def test_ctrl_c_ends_it_with_whole_files(case, tmp_path):
    program = """
    import os, signal, threading, time, seiche
    def interrupt():
        while not os.path.exists(os.path.join(FOLDER, "case.toml")):
            time.sleep(0.01)
        time.sleep(0.5)
        os.kill(os.getpid(), signal.SIGINT)
    threading.Thread(target=interrupt, daemon=True).start()
    run = seiche.run(CASE, FOLDER, **{"time.end": 1e7, "output.energy_every": 100000, "output.snapshot_every": 1000000})
    print(run.status, run.steps > 0)
    """
    text = textwrap.dedent(program).replace("CASE", repr(os.fspath(case))).replace("FOLDER", repr(os.fspath(tmp_path / "out")))
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, timeout=300, env=os.environ)
    assert done.stdout == "interrupted True\n", done.stderr
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["status"] == "interrupted"


def test_resume_leaves_what_an_unbroken_run_leaves(case, tmp_path):
    keys = {"time.end": 200, "output.snapshot_every": 64}
    seiche.run(case, tmp_path / "whole", **keys)
    stopped = seiche.run(case, tmp_path / "out", max_hours=1e-9, **keys)
    assert stopped.status == "interrupted" and stopped.t < 200 and "seiche resume" in stopped.message
    with pytest.raises(ValueError, match="holds a checkpoint"):
        seiche.run(case, tmp_path / "out", **keys)
    done = seiche.resume(tmp_path / "out", threads=2)
    assert done.success and done.t == 200 and done.resumed_at == [stopped.t]
    for name in ("energy.csv", "final.txt", "solution.xdmf"):
        assert (tmp_path / "out" / name).read_bytes() == (tmp_path / "whole" / name).read_bytes(), name


def test_resume_refuses_a_folder_without_a_checkpoint(case, tmp_path):
    seiche.run(case, tmp_path / "out")
    with pytest.raises(ValueError, match="holds no checkpoint"):
        seiche.resume(tmp_path / "out")
    with pytest.raises(ValueError, match="max_hours = 0 must be > 0"):
        seiche.resume(tmp_path / "out", max_hours=0)


def test_a_run_is_read_as_far_as_it_has_come(case, tmp_path):
    pytest.importorskip("xarray")
    pytest.importorskip("h5netcdf")
    program = Path(os.environ.get("SEICHE_BUILD_DIR", "nowhere")) / "seiche"
    if not program.exists():
        pytest.skip("SEICHE_BUILD_DIR names no build tree (ctest does)")
    whole = seiche.read(seiche.run(case, tmp_path / "whole"))
    assert whole.attrs["status"] == "success" and list(whole.t.values) == [0, 0.5, 1, 1.5, 2]

    folder = tmp_path / "out"
    more = ["time.end=1e7", "output.energy_every=100", "checkpoint.every_seconds=0.1"]
    words = ["run", case, "--quiet", "--out", folder, "--set", *more]
    with subprocess.Popen([program, *words]) as running:
        try:
            while not (folder / "checkpoint.seiche").exists():
                assert running.poll() is None
                time.sleep(0.01)
            begun = seiche.read(folder)
            assert begun.attrs["message"].startswith("still running, up to t = ")
            assert running.poll() is None
        finally:
            running.kill()
    assert len(begun.t) > 5 and (begun.u[:5].values == whole.u.values).all() and (begun.H[:5].values == whole.H.values).all()
    farther = seiche.read(folder)
    assert len(farther.t) >= len(begun.t) and farther.attrs["message"].startswith("not finished, up to t = ")
    with pytest.raises(ValueError, match="no directory of a finished run"):
        seiche.read(tmp_path)
