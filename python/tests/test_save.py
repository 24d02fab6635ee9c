"""A result that is saved is a run that the program takes for its own."""

import hashlib
import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
import seiche

h5py = pytest.importorskip("h5py")
WAVE = {"points": 16, "alpha": 1.0, "gamma": "0.1 + 0.05*sin(t)"}


def program(*arguments):
    found = Path(os.environ.get("SEICHE_BUILD_DIR", "nowhere")) / "seiche"
    if not found.exists():
        pytest.skip("SEICHE_BUILD_DIR names no build tree (ctest does)")
    return subprocess.run([found, *arguments], capture_output=True, text=True)


def states(folder, fields):
    with h5py.File(folder / "solution.h5") as file:
        return file["t"][:], np.concatenate([file[name][:].reshape(len(file["t"]), -1) for name in fields], axis=1).T


def duffing():
    return seiche.Problem(
        fields=["q", "p"], H="p^2/2 + q^4/4", D={"p": "c"}, parameters={"c": 0.1}, initial={"q": 1, "p": 0}
    )


RUNS = {
    "a problem of the list": lambda: seiche.solve(seiche.problem("klein_gordon", **WAVE), 2.0, method="egc4", h="1/16"),
    "formulas and a tolerance": lambda: seiche.solve(duffing(), 5.0, method="egc6", tolerance=1e-8),
    "a start of its own": lambda: seiche.solve(duffing(), (1.0, 3.0), [0.3, -1 / 3], h=0.1, record_every=3),
    "a method that was chosen": lambda: seiche.solve(duffing(), 2.0, method="auto", h=0.1, ledger=True),
    "even times": lambda: seiche.solve(duffing(), 4.0, method="egc4", h=0.125, t_eval=np.linspace(0, 4, 9)),
}


@pytest.mark.parametrize("name", RUNS)
def test_the_program_audits_and_draws_what_was_saved(name, tmp_path):
    result = RUNS[name]()
    done = result.save(tmp_path / "run")
    assert done.success and done.folder == tmp_path / "run"
    audit = program("audit", tmp_path / "run", "--json")
    assert audit.returncode == 0, audit.stdout + audit.stderr
    assert json.loads(audit.stdout)["confirms"]
    t, y = states(tmp_path / "run", result.problem.fields)
    assert np.array_equal(t, result.t) and np.array_equal(y, result.y)
    if name == "a start of its own":
        drawn = program("plot", tmp_path / "run", "--format", "png")
        assert drawn.returncode == 0, drawn.stderr
        assert (tmp_path / "run/figures/energy.png").exists() and (tmp_path / "run/report.html").exists()


def test_a_case_with_other_keys_is_saved_with_them(tmp_path):
    (tmp_path / "case.toml").write_text(
        '[problem]\nname = "oscillator"\n[time]\nend = 9.0\n[output]\nsnapshot_interval = 0.5\nenergy_every = 3\n'
    )
    result = seiche.solve(seiche.load(tmp_path / "case.toml"), 2.0, method="egc4", h=0.125)
    result.save(tmp_path / "run")
    t, y = states(tmp_path / "run", ["q", "p"])
    assert np.array_equal(t, result.t) and np.array_equal(y, result.y)
    again = seiche.load(tmp_path / "run/case.toml")
    assert again.t_end == 2.0 and np.array_equal(seiche.solve(again).y, result.y)


def test_uneven_times_leave_the_states_of_steps(tmp_path):
    result = seiche.solve(duffing(), 4.0, method="egc4", h=0.125, t_eval=[0.3, 1.0, 4.0])
    result.save(tmp_path / "run")
    t, y = states(tmp_path / "run", ["q", "p"])
    assert t[-1] == 4.0 and np.array_equal(y[:, -1], result.y[:, -1])


def test_a_found_problem_is_saved_with_what_was_found(tmp_path):
    pytest.importorskip("scipy")
    t = np.linspace(0.5, 10, 20)
    data = seiche.solve(duffing(), 10.0, method="egc6", h=0.05, t_eval=t).y[0] + 1e-3 * np.cos(9 * t)
    found = seiche.fit(duffing(), t, data, {"c": 0.2}, sigma=1e-3)
    seiche.solve(found.results[0].problem, 1.0, h=0.1).save(tmp_path / "run")
    assert f"c = {found.parameters['c']!r}" in (tmp_path / "run/case.toml").read_text()


def crosses(t, y):
    return y[0]


@pytest.mark.parametrize(
    ("result", "sentence"),
    [
        (
            lambda: seiche.solve(seiche.Problem(M=np.eye(2), z0=[1, 0]), 1.0, h=0.1),
            "its problem is stated by its parts: state",
        ),
        (lambda: seiche.solve(duffing(), 1.0, h=0.1, events=crosses), "its events are Python functions"),
        (lambda: seiche.solve(duffing(), (-1.0, 1.0), h=0.1), "it begins at t = -1, and cases at 0 or later"),
        (lambda: seiche.solve(duffing(), 1.0, h=0.1, observer=lambda *_: False), "it was interrupted at t = "),
    ],
)
def test_what_no_case_file_can_say_is_refused_and_leaves_nothing(result, sentence, tmp_path):
    with pytest.raises(ValueError, match=f"^no case file can say this run: {sentence}"):
        result().save(tmp_path / "run")
    assert not (tmp_path / "run").exists()


def test_a_folder_of_others_is_left_alone(tmp_path):
    (tmp_path / "summary.json").write_text("mine")
    with pytest.raises(ValueError, match="Seiche did not write it"):
        seiche.solve(duffing(), 1.0, h=0.1).save(tmp_path)
    assert (tmp_path / "summary.json").read_text() == "mine"


@pytest.mark.parametrize("name", ["summary.json", "case.toml"])
def test_an_initial_file_of_others_is_left_alone(name, tmp_path):
    result = seiche.solve(duffing(), 1.0, [0.5, 0.25], h=0.1)
    for file in ("initial.txt", name):
        (tmp_path / file).write_text("mine")
    with pytest.raises(ValueError, match="Seiche did not write it"):
        result.save(tmp_path)
    assert {file.name: file.read_text() for file in tmp_path.iterdir()} == {"initial.txt": "mine", name: "mine"}
    (tmp_path / name).unlink()
    result.save(tmp_path)
    assert (tmp_path / "initial.txt").read_text() == "mine"
    assert 'initial = { file = "initial_2.txt" }' in (tmp_path / "case.toml").read_text()
    assert np.array_equal(np.loadtxt(tmp_path / "initial_2.txt"), [0.5, 0.25])


def test_a_saved_start_moves_with_its_folder(tmp_path):
    result = seiche.solve(duffing(), 1.0, [0.5, 0.25], h=0.1)
    done = result.save(tmp_path / "run")
    assert 'initial = { file = "initial.txt" }' in (tmp_path / "run/case.toml").read_text()
    assert "initial = { file = &quot;initial.txt&quot; }" in (tmp_path / "run/report.html").read_text()
    hashed = hashlib.sha256((tmp_path / "run/case.toml").read_bytes()).hexdigest()
    assert json.loads((tmp_path / "run/summary.json").read_text())["sha256"] == done["sha256"]
    assert done["sha256"]["case.toml"] == hashed
    result.save(tmp_path / "run")  # the same once more
    assert not (tmp_path / "run/initial_2.txt").exists()
    (tmp_path / "run").rename(tmp_path / "moved")
    assert np.array_equal(seiche.solve(seiche.load(tmp_path / "moved/case.toml")).y, result.y)


@pytest.mark.parametrize("t_eval", [np.linspace(0, 4, 9), [0.3, 1.0, 3.9], [0.01, 4.0]])
@pytest.mark.parametrize("z0", [None, [0.9, 0.1]])
def test_times_beside_a_tolerance_are_saved(t_eval, z0, tmp_path):
    result = seiche.solve(duffing(), 4.0, z0, method="egc6", tolerance=1e-6, t_eval=t_eval)
    done = result.save(tmp_path / "run")
    assert done["steps"] == result.steps and done["energy"]["final"] == result.report["energy"]["final"]
    assert states(tmp_path / "run", ["q", "p"])[0].size == result.steps + 1


@pytest.mark.parametrize("z0", [None, [0.9, 0.1]])
def test_a_run_that_differs_is_not_kept(z0, tmp_path):
    result = seiche.solve(duffing(), 1.0, z0, h=0.1)
    result.y[0, -1] += 1e-15
    with pytest.raises(RuntimeError, match="^a run of the same case differs from this result, which is not saved$"):
        result.save(tmp_path / "run")
    assert not (tmp_path / "run").exists() or not list((tmp_path / "run").iterdir())


def test_what_the_caller_changes_later_is_not_saved(tmp_path):
    z0, times = np.array([0.5, 0.25]), np.array([0.5, 1.0])
    result = seiche.solve(duffing(), 1.0, z0, h=0.125, t_eval=times)
    z0[:], times[:] = 7, 0.1
    result.save(tmp_path / "run")
    assert np.array_equal(states(tmp_path / "run", ["q", "p"])[0], [0, 0.5, 1.0])


def test_an_empty_list_of_events_is_none(tmp_path):
    assert seiche.solve(duffing(), 1.0, h=0.1, events=[]).save(tmp_path / "run").success
