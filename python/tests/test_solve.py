"""Runs from Python are those of the library, with SciPy's shapes."""

import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import seiche


@pytest.fixture(scope="module")
def wave():
    return seiche.problem("klein_gordon", points=16, alpha=1.0, gamma="0.1 + 0.05*sin(t)")


def oscillator(**parameters):
    return seiche.problem("oscillator", **({"alpha": 0.0, "gamma": 0.0} | parameters))


def test_shapes_are_those_of_scipy(wave):
    r = seiche.solve(wave, 2.0, h="1/32")
    assert r.t.shape == (65,) and r.y.shape == (32, 65) and r.energy.shape == (65,)
    assert r.t[0] == 0 and r.t[-1] == 2
    assert r.success and r.status == 0 and r.status == "success" and r.steps == 64
    assert np.abs(r.y[:, 0] - wave.z0).max() < 1e-15
    assert r.law == "holds" and np.all(np.diff(r.modified_energy) <= 1e-12)
    assert r["message"] == r.message
    assert r.nfev > 0 and r.sol is None and r.t_events is None
    assert r.certificate["law"]["promised"]
    assert r.report["steps"] == 64 and r.report["status"] == "success"
    assert r.field("u").shape == (65, 16)
    assert np.array_equal(r.field("v")[3], r.y[16:, 3])


def test_arrays_are_views_that_outlive_everything_else(wave):
    r = seiche.solve(wave, 1.0, h=0.1)
    assert not r.y.flags.owndata and np.shares_memory(r.y, r.field("u"))
    y, first = r.y, r.y.copy()
    del r
    for _ in range(50):
        seiche.solve(wave, 1.0, h=0.1)
    assert np.array_equal(y, first)


@pytest.mark.parametrize("method", [m["name"] for m in seiche.methods()])
def test_every_method_follows_a_damped_oscillator(method):
    problem = oscillator(gamma=0.2)
    r = seiche.solve(problem, 3.0, method=method, h=1 / 256)
    omega = np.sqrt(0.99)
    exact = np.exp(-0.1 * r.t) * (np.cos(omega * r.t) + 0.1 / omega * np.sin(omega * r.t))
    assert r.success, r.message
    assert np.abs(r.y[0] - exact).max() < 2e-5


@pytest.mark.parametrize("backend", [b["name"] for b in seiche.backends()])
def test_every_backend_gives_the_same_solution(wave, backend):
    r = seiche.solve(wave, 1.0, method="egc4", h=1 / 32, backend=backend)
    s = seiche.solve(wave, 1.0, method="egc4", h=1 / 32)
    assert r.backend == backend
    assert np.abs(r.y - s.y).max() < 1e-11


def test_a_tolerance_is_met_and_asked_times_are_recorded():
    t = np.linspace(0, 10, 41)
    for method in ("egc6", "crkn6", "etdrk4", "auto"):
        r = seiche.solve(oscillator(), 10.0, method=method, tolerance=1e-8, t_eval=t)
        assert np.array_equal(r.t, t)
        assert np.abs(r.y[0] - np.cos(t)).max() < 1e-7
    assert r.method != "auto" and any("auto" in note for note in r.notes)


def test_start_time_and_state():
    r = seiche.solve(oscillator(), (2.0, 5.0), z0=[0.0, 1.0], method="egc4", h=1 / 16)
    assert r.t[0] == 2 and r.t[-1] == 5
    assert abs(r.y[0, -1] - np.sin(3)) < 1e-9


@pytest.mark.parametrize("step", [{"h": 1 / 32}, {"tolerance": 1e-9}])
def test_dense_output_is_the_solution_everywhere(step):
    r = seiche.solve(oscillator(), 6.0, method="egc4", dense_output=True, **step)
    t = np.random.default_rng(1).uniform(0, 6, 100)
    assert r.sol(t).shape == (2, 100) and r.sol(1.5).shape == (2,)
    assert np.abs(r.sol(t)[0] - np.cos(t)).max() < 1e-7
    assert np.abs(r.sol(r.t) - r.y).max() < 1e-12
    with pytest.raises(ValueError, match="outside the run"):
        r.sol(7.0)


@pytest.mark.parametrize("step", [{"h": 1 / 32}, {"tolerance": 1e-9}])
def test_events_end_the_run_or_act(step):
    def crossing(t, y):
        return y[0]

    crossing.direction = -1
    crossing.terminal = 2
    r = seiche.solve(oscillator(), 20.0, method="egc6", events=[crossing, lambda t, y: y[1]], **step)
    assert r.status == 1 and r.status == "event" and r.success
    assert np.allclose(r.t_events[0], [np.pi / 2, 5 * np.pi / 2], atol=1e-7)
    assert np.allclose(r.t_events[1], [0, np.pi, 2 * np.pi], atol=1e-7)  # at rest at the start, which SciPy counts too
    assert r.y_events[0].shape == (2, 2) and np.abs(r.y_events[0][:, 0]).max() < 1e-8
    assert r.t[-1] == r.t_events[0][-1]

    def bounce(t, y):
        return y[0]

    bounce.direction = -1
    bounce.action = lambda t, y: y * [1, -1]
    r = seiche.solve(oscillator(), 10.0, method="egc6", events=bounce, **step)
    assert len(r.t_events[0]) == 3
    assert abs(r.y[0, -1] - abs(np.cos(10))) < 1e-6


def test_an_observer_sees_every_step_and_may_stop():
    seen = []

    def watch(t, y, energy):
        seen.append((t, y.copy(), energy))
        return len(seen) < 5

    r = seiche.solve(oscillator(), 1.0, h=0.1, observer=watch)
    assert r.status == "interrupted" and not r.success
    assert [t for t, _, _ in seen] == list(r.t[:5])
    assert np.array_equal(seen[3][1], r.y[:, 3])


@pytest.mark.parametrize("answer", [lambda q: q > 0, lambda q: bool(q > 0), lambda q: np.array(q > 0)])
def test_an_observer_may_answer_as_numpy_does(answer):
    r = seiche.solve(oscillator(), 20.0, h=0.1, observer=lambda t, y, energy: answer(y[0]))
    assert r.status == "interrupted" and abs(r.t[-1] - np.pi / 2) < 0.1
    assert seiche.solve(oscillator(), 1.0, h=0.1, observer=lambda t, y, energy: energy * 0).success


def test_the_ledger_adds_up(wave):
    r = seiche.solve(wave, 1.0, method="egc4", h=1 / 16, ledger=True)
    assert np.allclose(sum(r.ledger.values()), r.energy - r.energy[0], atol=1e-12)


def test_noise_is_counted_by_seed_and_refused_where_it_cannot_be(wave):
    def end(**options):
        return seiche.solve(wave, (0, 1), method="seisav", h="1/64", temperature=0.1, **options).y[:, -1]

    assert np.array_equal(end(), end(seed=1))
    assert not np.array_equal(end(), end(seed=2))
    result = seiche.solve(wave, (0, 1), method="seisav", h="1/64", temperature=0.1, ledger=True)
    assert result.law == "not promised"
    assert result.ledger["heat"][-1] > 0
    with pytest.raises(ValueError, match="temperature = -1 must be ≥ 0"):
        seiche.solve(wave, (0, 1), h="1/64", temperature=-1)
    with pytest.raises(ValueError, match="noise needs steps of one size"):
        seiche.solve(wave, (0, 1), tolerance=1e-3, temperature=0.1)
    with pytest.raises(ValueError, match="known at the ends of steps alone"):
        seiche.solve(wave, (0, 1), h="1/64", temperature=0.1, dense_output=True)
    with pytest.raises(ValueError, match="converge looks at solutions without noise"):
        seiche.converge(wave, ["seisav"], [1 / 8, 1 / 16], temperature=0.1)


def test_a_computation_that_fails_is_a_status():
    focusing = seiche.problem("klein_gordon", points=20, alpha=-1.0, gamma=0.0)
    r = seiche.solve(focusing, 20.0, method="egc6", tolerance=1e-6)
    assert not r.success and r.status == -1 and r.status == "failed"
    assert 12 < r.t[-1] < 13


def test_cases(tmp_path):
    file = tmp_path / "case.toml"
    file.write_text('[problem]\nname = "oscillator"\n[method]\nh = "1/8"\n[time]\nend = 2.0\n')
    case = seiche.load(file, **{"method.name": "egc4"})
    r = seiche.solve(case)
    assert r.method == "egc4" and r.steps == 16
    assert seiche.solve(case, h="1/16", t_span=1.0).steps == 16
    assert 'name = "egc4"' in case.text
    with pytest.raises(ValueError, match=r"case.toml:4:5: method.h = -1 must be > 0"):
        file.write_text('[problem]\nname = "oscillator"\n[method]\nh = -1\n')
        seiche.load(file)


def test_a_case_stays_as_it_was_read(tmp_path, monkeypatch):
    file = tmp_path / "case.toml"
    text = '[problem]\nname = "oscillator"\nalpha = {}\n[method]\nname = "egc4"\nh = {}\n[time]\nend = 1.0\n'
    file.write_text(text.format(1.0, 0.125))
    case = seiche.load(file)
    before = seiche.solve(case)
    file.write_text(text.format(5.0, 0.25))
    after = seiche.solve(case)
    assert after.steps == 8 and np.array_equal(after.y, before.y)
    assert seiche.solve(case, h="1/32").steps == 32
    assert seiche.solve(seiche.load(file)).steps == 4
    file.unlink()
    assert np.array_equal(seiche.solve(case).y, before.y)
    with pytest.raises(ValueError, match="the case file .*case.toml does not exist"):
        seiche.load(file)


def test_a_status_has_a_hash_for_none_of_what_it_equals():
    status = seiche.solve(oscillator(), 1.0, h=0.1).status
    assert status == 0 == int(status) and status == "success" == status.word
    with pytest.raises(TypeError, match="a status equals a number and a word, and has no hash: take status.word"):
        hash(status)
    assert {status.word: 1} == {"success": 1}


def test_fields_as_xarray(wave):
    data = seiche.solve(wave, 1.0, h=0.125).to_xarray()
    assert data["u"].dims == ("t", "x") and data.sizes == {"t": 9, "x": 16}
    assert float(data["H"][0]) > 0 and data.attrs["method"] == "seisav"
    plane = seiche.problem("klein_gordon", points=[8, 6], length=2.0)
    data = seiche.solve(plane, 0.5, h=0.125).to_xarray()
    assert data["v"].dims == ("t", "x", "y") and data["v"].shape == (5, 8, 6)


@pytest.mark.parametrize("name, settings", [
    ("klein_gordon", {"points": 16}),
    ("klein_gordon", {"points": [8, 6], "length": 2.0}),
    ("truss", {}),
    ("oscillator", {}),
    ("oscillator", {"points": 3}),
])  # fmt: skip
def test_xarray_has_the_dimensions_and_attributes_of_the_program(tmp_path, name, settings):
    h5py = pytest.importorskip("h5py")
    program = Path(os.environ.get("SEICHE_BUILD_DIR", tmp_path)) / "seiche"
    if not program.exists():
        pytest.skip("SEICHE_BUILD_DIR names no build tree (ctest does)")
    data = seiche.solve(seiche.problem(name, **settings), 0.5, method="seisav", h=0.125).to_xarray()
    (tmp_path / "case.toml").write_text(f'[problem]\nname = "{name}"\n[method]\nh = 0.125\n[time]\nend = 0.5\n')
    overrides = [f"problem.{key}={value}" for key, value in settings.items()] + ["output.snapshot_every=1"]
    command = [program, "run", "case.toml", "--quiet", "--out", "out", "--set", "method.name=seisav", *overrides]
    subprocess.run(command, cwd=tmp_path, check=True)
    with h5py.File(tmp_path / "out/solution.h5") as file:
        fields = file.attrs["fields"].split()
        assert set(data.data_vars) == {*fields, "H", "H_modified"}
        for variable in (*data.data_vars, *data.coords):
            written = file[variable]
            assert np.allclose(data[variable], written, atol=1e-12), variable
            for attribute in ("long_name", "units"):
                assert data[variable].attrs[attribute] == written.attrs[attribute], variable
        for field in fields:
            assert list(data[field].dims) == [axis[0].name[1:] for axis in file[field].dims]
    pytest.importorskip("h5netcdf")
    with pytest.importorskip("xarray").open_dataset(tmp_path / "out/solution.h5") as opened:
        for field in fields:
            assert opened[field].dims == data[field].dims and np.allclose(opened[field], data[field], atol=1e-12)


def test_ensembles():
    wave = seiche.problem("klein_gordon", points=8, alpha=1.0, gamma=0.1)
    z0 = np.outer(np.linspace(0.5, 1.5, 20), wave.z0)
    e = seiche.solve_ensemble(wave, 1.0, z0, method="seisav", h=1 / 32, threads=2)
    assert e.success and e.y.shape == (20, 16) and set(e.law) == {"holds"} and e.side_by_side
    alone = seiche.solve(wave, 1.0, z0[7], h=1 / 32)
    assert np.abs(e.y[7] - alone.y[:, -1]).max() < 1e-13
    assert e.energy["mean"].shape == e.t.shape
    several = [seiche.problem("klein_gordon", points=8, alpha=a) for a in (0.5, 1.0)]
    assert seiche.solve_ensemble(several, 1.0, h=1 / 32).y.shape == (2, 16)
    with pytest.raises(ValueError, match="the state of problem 0 has 16 numbers and that of problem 1 has 32"):
        seiche.solve_ensemble([wave, seiche.problem("klein_gordon", points=16)], 1.0, h=1 / 32)


def test_ensembles_of_cases(tmp_path):
    file = tmp_path / "case.toml"
    file.write_text(
        '[problem]\nname = "oscillator"\n[method]\nh = "1/16"\n[time]\nend = 2.0\n'
        "[ensemble]\nmembers = 40\nalpha = { uniform = [0.5, 1.5] }\nperturb_initial = 0.01\n"
    )
    e = seiche.solve_ensemble(seiche.load(file), threads=2)
    assert e.success and e.y.shape == (40, 2) and e.parameters["alpha"].shape == (40,)
    assert np.all((e.parameters["alpha"] >= 0.5) & (e.parameters["alpha"] <= 1.5))
    assert np.array_equal(seiche.solve_ensemble(seiche.load(file)).y, e.y)


def test_what_there_is():
    assert {"seisav", "seilm", "egc4", "crkn6"} <= {m["name"] for m in seiche.methods()}
    assert {"klein_gordon", "gkdv", "nls"} <= {p["name"] for p in seiche.problems()}
    assert {"dense", "modal", "sparse"} <= {b["name"] for b in seiche.backends()}
    law = seiche.check("klein_gordon", t_end=10.0, method="seisav")["law"]
    assert law["promised"]


def test_names_of_scipy_are_taken():
    ours = seiche.solve("oscillator", 2.0, [0.5, 0.1], tolerance=1e-6, h_max=0.05)
    theirs = seiche.solve("oscillator", 2.0, y0=[0.5, 0.1], tolerance=1e-6, max_step=0.05)
    assert np.array_equal(ours.y, theirs.y) and ours.steps >= 40


def test_a_result_is_a_table_in_notebooks():
    shown = seiche.solve("oscillator", 1.0)._repr_html_()
    assert shown.startswith("<table><tr><th>t</th>") and "array of shape" in shown
    assert shown.count("<tr>") == len(seiche.solve("oscillator", 1.0))


CHECKPOINTED = """
import os, signal, sys, threading
import numpy as np
import seiche

def bounce(t, y):
    return y[0] + 0.25

bounce.direction = -1
bounce.action = lambda t, y: [y[0], -y[1]]
problem = seiche.Problem(M=np.eye(2), V=lambda q: float(np.sum(q**4) / 4), gradient=lambda q: q**3, z0=[1, 0])

def solve(end, **more):
    return seiche.solve(problem, end, h=1e-3, record_every=100, events=bounce, **more)
"""


def test_a_call_goes_on_from_its_checkpoint(tmp_path):
    stopped = f"""{CHECKPOINTED}
threading.Timer(1.0, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
r = solve(1e6, checkpoint={str(tmp_path / "kept")!r})
assert r.status == "interrupted", r
assert "the same call goes on from" in r.message, r.message
print(r.report["t"])
"""
    done = subprocess.run([sys.executable, "-c", stopped], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    end = float(done.stdout) + 0.5
    for other, said in {"seiche.resume": "a call of seiche.solve", "seiche.read": "a call of seiche.solve"}.items():
        with pytest.raises(ValueError, match=said):
            {"seiche.resume": seiche.resume, "seiche.read": seiche.read}[other](tmp_path / "kept")
    goes_on = f"""{CHECKPOINTED}
one, other = solve({end!r}), solve({end!r}, checkpoint={str(tmp_path / "kept")!r})
assert other.success and any("went on from checkpoint.seiche" in note for note in other.notes), other
for name in ("t", "y", "energy"):
    assert np.array_equal(getattr(one, name), getattr(other, name)), name
assert np.array_equal(one.t_events[0], other.t_events[0]) and len(one.t_events[0]) > 1
assert not os.listdir({str(tmp_path / "kept")!r})
"""
    done = subprocess.run([sys.executable, "-c", goes_on], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr


def test_the_checkpoint_of_another_call_is_refused(tmp_path):
    seconds = time.monotonic() + 0.3
    seiche.solve("oscillator", 1e6, h=1e-3, record_every=1000, checkpoint=tmp_path, observer=lambda t, y, energy: time.monotonic() < seconds)
    assert (tmp_path / "checkpoint.seiche").exists()
    with pytest.raises(ValueError, match="another call of seiche.solve"):
        seiche.solve("oscillator", 1e6, h=1e-2, checkpoint=tmp_path)
    with pytest.raises(ValueError, match="t_span ends at 0.002"):
        seiche.solve("oscillator", 0.002, h=1e-3, record_every=1000, checkpoint=tmp_path)
    with pytest.raises(ValueError, match="its z0 has other numbers"):
        seiche.solve("oscillator", 1e6, [2, 0], h=1e-3, record_every=1000, checkpoint=tmp_path)


def test_by_parts_it_is_the_numbers_that_tell_calls_apart(tmp_path):
    def stopped(M, D, **more):
        seconds = time.monotonic() + 0.2
        problem = seiche.Problem(M=M, D=D, V="0.25*u^4", z0=[1, 0])
        return seiche.solve(problem, 1e6, h=1e-3, record_every=1000, checkpoint=tmp_path, **more)

    seconds = time.monotonic() + 0.3
    watch = lambda t, y, energy: time.monotonic() < seconds
    assert stopped(np.eye(2), np.diag([0, 0.1]), observer=watch).status == "interrupted"
    with pytest.raises(ValueError, match="its equation .* has other numbers"):
        stopped(np.diag([9.0, 1.0]), np.zeros((2, 2)))
