"""Ctrl-C returns what is there."""

import os
import re
import signal
import subprocess
import sys
import textwrap

import pytest

import seiche

PROGRAM = """
import _thread, os, signal, threading
import numpy as np
import seiche
{problem}
threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
r = seiche.solve(problem, 1e6, h=1e-3, record_every=1000{more})
assert r.status == "interrupted" and r.status == 2 and not r.success, r
assert 0 < r.t[-1] < 1e6 and np.isfinite(r.y).all() and r.y.shape[1] == len(r.t)
print(r.message)
"""

BY_NAME = 'problem = seiche.problem("oscillator")'
BY_PARTS = (
    """problem = seiche.Problem(M=np.eye(2), V=lambda u: float(np.sum(u**4) / 4), gradient=lambda u: u**3, z0=[1, 0])"""
)


@pytest.mark.parametrize("problem", [BY_NAME, BY_PARTS])
@pytest.mark.parametrize("more", ["", ", observer=lambda t, y, energy: None", ", progress=lambda *where: None"])
def test_ctrl_c_returns_what_is_there(problem, more):
    program = textwrap.dedent(PROGRAM).format(problem=problem, more=more)
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=300, env=os.environ)
    assert done.returncode == 0, done.stderr
    between_steps = r"stopped at t = \S+ \(step \d+\) of 1000000\n"
    inside = r"the run stopped after t = \S+ \(step \d+\): interrupted inside a Python function\n"
    calls_python = problem == BY_PARTS  # inside a step
    assert re.fullmatch(f"{between_steps}|{inside}" if calls_python else between_steps, done.stdout), done.stdout


@pytest.mark.parametrize("problem", [BY_NAME, BY_PARTS])
@pytest.mark.parametrize(
    "steps", ["h=1e-3", 'method="egc4", tolerance=1e-9, h_max=1e-3', "h=1e-3, observer=lambda t, y, energy: None"]
)
def test_ctrl_c_keeps_the_state_where_it_came_whatever_times_were_asked_for(problem, steps):
    program = f"""
import os, signal, threading
import numpy as np
import seiche
{problem}
threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
r = seiche.solve(problem, 1e6, t_eval=[0.0, 0.5, 1e6], {steps})
assert r.status == "interrupted", r
assert r.t.shape == (3,) and r.y.shape == (2, 3) and list(r.t[:2]) == [0.0, 0.5]
assert 0.5 < r.t[2] < 1e6 and r.t[2] == r.report["t"]
assert np.isfinite(r.y).all() and np.isclose(r.energy[2], r.report["energy"]["final"], rtol=1e-2)
print("kept")
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=300)
    assert done.stdout == "kept\n", done.stdout + done.stderr


def test_other_signal_handlers_raise():
    program = """
import os, signal, threading, seiche
class Mine(Exception): pass
def handler(number, frame): raise Mine
signal.signal(signal.SIGALRM, handler)
signal.setitimer(signal.ITIMER_REAL, 0.3)
try:
    seiche.solve("oscillator", 1e6, h=1e-3, record_every=1000)
except Mine:
    print("mine")
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=300)
    assert done.stdout == "mine\n", done.stderr


@pytest.mark.parametrize("call", ["seiche.solve(problem, 1.0, h=0.01)", "r.sol(0.1)"])
def test_ctrl_c_where_nothing_is_there_yet_raises(call):
    program = f"""
import numpy as np, os, signal, seiche
armed = False
def V(u):
    if armed: os.kill(os.getpid(), signal.SIGINT)
    return float(np.sum(u**4) / 4)
problem = seiche.Problem(M=np.eye(2), V=V, gradient=lambda u: u**3, z0=[1, 0])
r = seiche.solve(problem, 1.0, h=0.25, dense_output=True)
armed = True
try:
    print({call})
except KeyboardInterrupt:
    print("raised")
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=300)
    assert done.stdout == "raised\n", done.stdout + done.stderr


CONVERGE = (
    'seiche.converge(seiche.problem("klein_gordon", points=64), ["seavf"], [2.0**-k for k in range(4, 15)], t_end=50.0)'
)
# The damping moves what V depends on, and is sampled along a solution; the longest, which is cut, takes minutes.
CHECK = 'seiche.check(seiche.problem("gkdv", points=512, mu=1e-6), t_end=1e6)'
# A step with a projection is not linear, and modes are stepped one at a time. A million of them take minutes: 8000 take a
# second or a few, and on a fast machine the study might end before Ctrl-C comes.
SPECTRUM = 'seiche.spectrum(seiche.problem("klein_gordon", points=1000000, gamma=0.1), method="egc6", h=8.0)'


@pytest.mark.parametrize("study", [CONVERGE, CHECK, SPECTRUM])
def test_a_study_can_be_interrupted(study):
    program = f"""
import os, seiche, signal, threading, time
def interrupt():
    global sent
    sent = time.process_time()  # one step of a study of a million modes takes seconds, and minutes are a failure
    os.kill(os.getpid(), signal.SIGINT)
threading.Timer(0.5, interrupt).start()
try:
    {study}
except KeyboardInterrupt:
    print("raised", time.process_time() - sent < 20)
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=300)
    assert done.stdout == "raised True\n", done.stderr


@pytest.mark.parametrize("call", ["seiche.solve(inner, 1.0, h=0.1)", "seiche.check(inner, 1.0)"])
def test_ctrl_c_inside_a_run_inside_an_observer_ends_both(call):
    program = f"""
import os, seiche, signal, threading
inner = seiche.problem("oscillator")
seen = 0
def observer(t, y, energy):
    global seen
    seen += 1
    if seen == 3:
        threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        stopped = seiche.solve(inner, 1e6, h=1e-3, record_every=1000)
        assert stopped.status == "interrupted", stopped
    {call}
r = seiche.solve("oscillator", 1e4, h=1e-3, record_every=1000, observer=observer)
print(r.status, r.t[-1] < 10)
print(seiche.solve(inner, 1.0, h=0.1).status)
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=300)
    assert done.stdout == "interrupted True\nsuccess\n", done.stdout + done.stderr


def test_a_dense_output_can_be_interrupted():
    program = """
import os, signal, threading, time, seiche
import numpy as np
r = seiche.solve("klein_gordon", 10.0, h=0.1, dense_output=True)
threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
try:
    r.sol(np.linspace(0, 10, 3_000_000))
except KeyboardInterrupt:
    print("raised")
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=300)
    assert done.stdout == "raised\n", done.stderr


def test_an_ensemble_stops_between_its_records():
    program = """
import os, signal, threading, time, seiche
import numpy as np
wave = seiche.problem("klein_gordon", points=8, alpha=1.0)
threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
begin = time.time()
try:
    e = seiche.solve_ensemble(wave, 1e7, np.outer([0.5, 1.0], wave.z0), method="seisav", h=1e-3, energy_every=10**9)
    print("interrupted" if set(e.status) == {"interrupted"} else e.status, time.time() - begin < 20)
except KeyboardInterrupt:
    print("interrupted", time.time() - begin < 20)
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=300)
    assert done.stdout == "interrupted True\n", done.stderr


@pytest.mark.parametrize("problem", [BY_NAME, BY_PARTS])
@pytest.mark.parametrize("more", ["", ", observer=lambda t, y, energy: None"])
def test_a_run_on_a_daemon_thread_does_not_abort_the_end_of_the_interpreter(problem, more):
    program = f"""
        import threading, time
        import numpy as np
        import seiche
        {problem}
        run = lambda: seiche.solve(problem, 1e6, h=1e-3, record_every=1000{more})
        threading.Thread(target=run, daemon=True).start()
        time.sleep(0.5)
        print("the end")
    """
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(program)], capture_output=True, text=True, timeout=300)
    assert (done.returncode, done.stdout) == (0, "the end\n"), done.stderr


def test_ctrl_c_in_an_observer_ends_with_its_step():
    calls = []

    def observer(t, y, energy):
        calls.append(t)
        if t == 0.5:
            raise KeyboardInterrupt

    r = seiche.solve("oscillator", 1.0, h=0.125, observer=observer)
    assert r.status == "interrupted" and calls[-1] == 0.5 and r.t[-1] == 0.5 and r.report["t"] == 0.5


def test_one_ctrl_c_leaves_all_files_of_a_run(tmp_path):
    program = f"""
import os, signal, threading, seiche
threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
(__import__("pathlib").Path({str(tmp_path)!r}) / "case.toml").write_text(
    '[problem]\\nname = "klein_gordon"\\n[time]\\nend = 1e6\\n[output]\\nenergy_every = 1000\\n')
r = seiche.run({str(tmp_path / "case.toml")!r}, {str(tmp_path / "out")!r})
assert r.status == "interrupted", r
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0 and "stopped before" not in done.stderr, done.stderr
    assert {"solution.xdmf", "report.html", "checkpoint.seiche"} <= {file.name for file in (tmp_path / "out").iterdir()}
