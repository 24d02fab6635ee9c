"""Ensembles: what they refuse, and their arrays by member."""

import numpy as np
import pytest
import seiche


def by_parts(**changes):
    return seiche.Problem(**({"M": np.eye(2), "V": "u^4/4"} | changes))


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: seiche.solve_ensemble(by_parts(), 1.0, h=0.1), "^z0 is missing: give it to seiche.Problem or to seiche.solve_ensemble$"),
        (lambda: seiche.solve_ensemble([by_parts(z0=[1, 0]), by_parts()], 1.0, h=0.1), "^z0 is missing"),
        (
            lambda: seiche.solve_ensemble(seiche.Problem(fields=["q", "p"], H="p^2/2 + q^4/4"), 1.0, h=0.1),
            "^the initial state is missing: give initial to seiche.Problem, or z0 to seiche.solve_ensemble$",
        ),
        (lambda: seiche.solve_ensemble([], 1.0, h=0.1), "^the list of problems is empty: give one for each member$"),
        (
            lambda: seiche.solve_ensemble([seiche.problem("klein_gordon", points=n) for n in (8, 8, 16)], 1.0, h=0.1),
            "^the members of an ensemble have one size, but the state of problem 0 has 16 numbers and that of problem 2 has 32$",
        ),
        (
            lambda: seiche.solve_ensemble([by_parts(z0=[1, 0]), seiche.problem("oscillator")], 1.0, h=0.1),
            "^the members of an ensemble have the same fields and points, but problem 0 has u, v at 1 and problem 1 has q, p at 1$",
        ),
    ],
)
def test_what_is_no_ensemble_is_said_in_a_sentence(call, sentence):
    with pytest.raises(ValueError, match=sentence):
        call()


def test_a_state_of_zeros_may_be_given():
    assert seiche.solve_ensemble(by_parts(), 1.0, [[0, 0], [1, 0]], h=0.1).success


def ensemble(points, members=3, **more):
    wave = seiche.problem("klein_gordon", points=points, **({"alpha": 1.0, "gamma": 0.1} | more))
    return wave, seiche.solve_ensemble(wave, 1.0, np.outer(np.arange(1.0, 1 + members), wave.z0), h=1 / 32)


def test_fields_are_those_of_the_last_states():
    wave, e = ensemble([8, 6])
    assert e.field("v").shape == (3, 8, 6) and np.shares_memory(e.field("v"), e.y)
    assert np.array_equal(e.field("v")[2].ravel(), e.y[2, wave.size // 2 :])
    with pytest.raises(ValueError, match="has no field 'w'; it has u, v"):
        e.field("w")
    assert not isinstance(e, seiche.Result)


def test_ensembles_as_xarray():
    wave, e = ensemble(8)
    data = e.to_xarray()
    assert data["u"].dims == ("member", "x") and data["H"].dims == ("statistic", "t")
    assert np.array_equal(data["v"], e.field("v")) and np.array_equal(data["x"], wave.axes[0])
    assert np.array_equal(data["H"].sel(statistic="mean"), e.energy["mean"])
    assert np.array_equal(data["final_energy"], e.final_energy)
    assert list(data["member"]) == [0, 1, 2] and list(data["law"]) == ["holds"] * 3
    assert "H_modified" in data and data.attrs["method"] == "seisav"
    oscillators = seiche.solve_ensemble("oscillator", 1.0, [[1, 0], [2, 0]], method="seavf", h=0.1).to_xarray()
    assert oscillators["q"].dims == ("member",) and "H_modified" not in oscillators


def test_members_on_grids_of_different_lengths_have_no_common_places():
    waves = [seiche.problem("klein_gordon", points=8, length=length) for length in (2.0, 3.0)]
    data = seiche.solve_ensemble(waves, 1.0, h=1 / 32).to_xarray()
    assert data["u"].dims == ("member", "x") and "x" not in data.coords


def test_parameters_are_coordinates_of_the_members(tmp_path):
    file = tmp_path / "case.toml"
    file.write_text(
        '[problem]\nname = "klein_gordon"\npoints = 8\n[method]\nh = "1/16"\n[time]\nend = 1.0\n'
        "[ensemble]\nmembers = 4\nalpha = { uniform = [0.5, 1.5] }\n"
    )
    e = seiche.solve_ensemble(seiche.load(file))
    data = e.to_xarray()
    assert data["alpha"].dims == ("member",) and np.array_equal(data.coords["alpha"], e.parameters["alpha"])
    with pytest.raises(ValueError, match=r"case.toml has a section \[ensemble\]: call seiche.solve_ensemble, or give its problem"):
        seiche.solve(seiche.load(file))
    assert seiche.solve(seiche.load(file).problem, 1.0, h=0.1).success


def test_of_a_member_that_never_started_nothing_is_claimed():
    wave = seiche.problem("klein_gordon", points=8)
    e = seiche.solve_ensemble(wave, 1.0, np.outer([1.0, np.nan, 0.5], wave.z0), h=0.1)
    assert e.status == ["success", "failed", "success"] and e.law == ["holds", "not promised", "holds"]
    assert list(np.isnan(e.final_energy)) == [False, True, False] and np.isnan(e.y[1]).all()
