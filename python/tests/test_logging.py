"""What is to be known of a run is in the log, and what may make it inaccurate is a warning."""

import logging
import warnings

import numpy as np
import pytest
import seiche


def test_the_notes_of_a_run_and_how_it_ended_are_logged_at_info(caplog, tmp_path):
    caplog.set_level(logging.INFO, "seiche")
    result = seiche.solve("oscillator", 1.0)
    assert result.notes and [record.getMessage() for record in caplog.records][: len(result.notes)] == result.notes
    assert caplog.messages[-1] == f"oscillator by seisav: {result.message}"
    assert {(record.name, record.levelname) for record in caplog.records} == {("seiche", "INFO")}
    caplog.clear()
    (tmp_path / "case.toml").write_text('[problem]\nname = "oscillator"\n[time]\nend = 1.0\n')
    done = seiche.run(tmp_path / "case.toml", tmp_path / "out")
    assert done.notes and caplog.messages == [*done.notes, f"{tmp_path / 'out'}: {done.message}"]
    caplog.clear()
    wave = seiche.problem("oscillator")
    seiche.solve_ensemble(wave, 1.0, [wave.z0, wave.z0], h=0.1)
    assert caplog.messages[-1] == "2 of 2 members reached t = 1"


def test_warnings_are_not_logged_twice(caplog):
    caplog.set_level(logging.DEBUG, "seiche")
    with pytest.warns(seiche.SeicheWarning):
        seiche.fit(seiche.problem("oscillator", alpha=0.0), [1.0, 2.0, 3.0], [5.0, 5.0, 5.0], {"gamma": 0.1}, sigma=0.1)
    assert not [record for record in caplog.records if record.levelno > logging.INFO]


def test_runs_that_a_fit_tries_are_not_logged(caplog):
    pytest.importorskip("scipy")
    caplog.set_level(logging.INFO, "seiche")
    t = np.linspace(0.5, 10, 20)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = seiche.fit(
            seiche.problem("oscillator", alpha=0.0, gamma=0.2), t, np.cos(t), {"gamma": (0.2, 0, 1)}, sigma=0.1
        )
    assert caplog.messages == [found.message]


def test_a_warning_points_at_the_line_that_asked():
    t = np.linspace(0.5, 10, 20)
    with pytest.warns(seiche.SeicheWarning) as said:
        seiche.fit(seiche.problem("oscillator", alpha=0.0), t, t, {"gamma": (0.2, 0, 1)}, sigma=0.1)
    assert {warning.filename for warning in said} == {__file__}
