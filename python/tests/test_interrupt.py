"""Ctrl-C returns what is there."""

import os
import signal
import subprocess
import sys
import textwrap

import pytest

PROGRAM = """
import _thread, os, signal, threading
import numpy as np
import seiche
{problem}
threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
r = seiche.solve(problem, 1e6, h=1e-3, record_every=1000{more})
assert r.status == "interrupted" and r.status == 2 and not r.success, r
assert 0 < r.t[-1] < 1e6 and np.isfinite(r.y).all() and r.y.shape[1] == len(r.t)
print("interrupted", r.message)
"""

BY_NAME = 'problem = seiche.problem("oscillator")'
BY_PARTS = """problem = seiche.Problem(M=np.eye(2), V=lambda u: float(np.sum(u**4) / 4), gradient=lambda u: u**3, z0=[1, 0])"""


@pytest.mark.parametrize("problem", [BY_NAME, BY_PARTS])
@pytest.mark.parametrize("more", ["", ", observer=lambda t, y, energy: None"])
def test_ctrl_c_returns_what_is_there(problem, more):
    program = textwrap.dedent(PROGRAM).format(problem=problem, more=more)
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60, env=os.environ)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("interrupted stopped at t =") or "interrupted" in done.stdout


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
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)
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
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)
    assert done.stdout.endswith("raised\n") or "interrupted" in done.stdout, done.stderr


def test_a_study_can_be_interrupted():
    program = """
import os, seiche, signal, threading, time
threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
begin = time.time()
try:
    seiche.converge(seiche.problem("klein_gordon", points=64), ["seavf"], [2.0**-k for k in range(4, 15)], t_end=50.0)
except KeyboardInterrupt:
    print("raised", time.time() - begin < 20)
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)
    assert done.stdout == "raised True\n", done.stderr


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
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)
    assert done.stdout == "interrupted True\n", done.stderr
