"""How far a run is, told to a function or drawn as a bar."""

import io
import re
import sys

import numpy as np
import pytest
import seiche
from seiche import _progress

LONG = {"t_span": 400.0, "h": 1e-4, "record_every": 10000}  # takes most of a second, where a step takes 0.2 µs


def test_a_function_is_told_where_a_run_is_and_where_it_ends():
    told = []
    result = seiche.solve("oscillator", **LONG, progress=lambda *where: told.append(where))
    t, ends, steps = zip(*told)
    assert len(told) > 2 and set(ends) == {400.0}
    assert list(t) == sorted(t) and list(steps) == sorted(steps)
    assert told[-1] == (400.0, 400.0, result.steps)
    assert np.allclose(np.array(steps) * 1e-4, t)


def test_a_run_is_the_same_with_and_without_progress():
    kept = {"method": "egc4", "tolerance": 1e-7, "t_eval": np.linspace(0, 30, 31)}
    alone = seiche.solve("oscillator", 30.0, **kept)
    told = seiche.solve("oscillator", 30.0, **kept, progress=lambda *where: None)
    assert np.array_equal(alone.y, told.y) and alone.steps == told.steps


def test_a_run_that_an_event_ends_is_told_where():
    def passes(t, y):
        return y[0]

    passes.terminal = True
    told = []
    result = seiche.solve("oscillator", 30.0, h=0.01, events=passes, progress=lambda *where: told.append(where))
    assert told[-1] == (result.t[-1], 30.0, result.steps)


def test_what_a_function_raises_ends_the_run():
    def refuse(*where):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        seiche.solve("oscillator", **LONG, progress=refuse)
    with pytest.raises(ValueError, match=r"progress = 3 must be True, False, or a function of \(t, t_end, steps\)"):
        seiche.solve("oscillator", 1.0, progress=3)


def test_a_case_and_an_ensemble_that_leave_files_tell_where_they_are(tmp_path):
    text = '[problem]\nname = "oscillator"\n[method]\nh = 1e-3\n[time]\nend = 400.0\n[output]\nenergy_every = 1000\n'
    (tmp_path / "one.toml").write_text(text)
    (tmp_path / "many.toml").write_text(text + "[ensemble]\nmembers = 2\ngamma = { uniform = [0.1, 0.2] }\n")
    for name in ("one", "many"):
        told = []
        done = seiche.run(tmp_path / f"{name}.toml", tmp_path / name, progress=lambda *where: told.append(where))
        assert len(told) > 1 and told[-1] == (400.0, 400.0, 400_000)
        assert [where[0] for where in told] == sorted(where[0] for where in told)
        assert done.success


def test_an_ensemble_and_a_fit_tell_how_far_they_are():
    told = []
    wave = seiche.problem("oscillator", alpha=1.0)
    held = seiche.solve_ensemble(
        wave,
        200.0,
        np.outer([0.5, 1.0], wave.z0),
        h=1e-3,
        energy_every=1000,
        progress=lambda *where: told.append(where),
    )
    assert told[-1] == (200.0, 200.0, 200_000) and held.success
    pytest.importorskip("scipy")
    tried = []
    t = np.linspace(0.5, 10, 20)
    found = seiche.fit(
        seiche.problem("oscillator", alpha=0.0, gamma=0.2), t, np.cos(t), {"gamma": (0.2, 0, 1)}, sigma=0.1,
        progress=lambda *where: tried.append(where),
    )  # fmt: skip
    assert [count for count, _ in tried] == list(range(1, len(tried) + 1)) and len(tried) >= found.nfev
    assert min(chi2 for _, chi2 in tried) == pytest.approx(found.chi2, rel=1e-6)


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_a_bar_on_a_terminal_is_drawn_over_itself_and_wiped(monkeypatch):
    monkeypatch.setattr(sys, "stderr", Terminal())
    monkeypatch.setenv("TERM", "xterm")
    seiche.solve("oscillator", **LONG, progress=True)
    shown = sys.stderr.getvalue().split("\r")
    assert re.match(r" *\d+ % ━* +t = \S+ +\S+ steps/s, \d+:\d\d left *$", shown[1]), shown
    assert "\n" not in sys.stderr.getvalue() and not shown[-2].strip() and shown[-1] == ""


def test_a_bar_in_a_file_is_a_line_now_and_then(monkeypatch):
    monkeypatch.setattr(sys, "stderr", io.StringIO())
    seiche.solve("oscillator", **LONG, progress=True)
    assert sys.stderr.getvalue() == ""  # ten seconds apart
    monkeypatch.setattr(_progress, "_SELDOM", 0.1)
    seiche.solve("oscillator", **LONG, progress=True)
    assert all(re.match(r" *\d+ % ", line) for line in sys.stderr.getvalue().splitlines())
    assert "\r" not in sys.stderr.getvalue() and sys.stderr.getvalue().endswith("left\n")


@pytest.mark.parametrize("progress", [True, np.True_, np.False_])
def test_a_bar_needs_a_place(progress, monkeypatch):
    monkeypatch.setattr(sys, "stderr", None)
    assert seiche.solve("oscillator", **LONG, progress=progress).success
    monkeypatch.setattr(sys, "stderr", Terminal())
    monkeypatch.setenv("TERM", "xterm")
    seiche.solve("oscillator", **LONG, progress=progress)
    assert bool(sys.stderr.getvalue()) == bool(progress)


def test_without_progress_a_run_is_silent(capfd):
    seiche.solve("oscillator", **LONG)
    assert capfd.readouterr() == ("", "")
