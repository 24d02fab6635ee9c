"""Problems, cases and results go to other processes and come back."""

import copy
import pickle

import numpy as np
import pytest
import seiche


def cubic(u):
    return u**3


def quartic(u):
    return float(np.sum(u**4) / 4)


def made(tmp_path):
    case = tmp_path / "case.toml"
    case.write_text('[problem]\nname = "oscillator"\n[method]\nname = "egc4"\nh = 0.1\n[time]\nend = 1.0\n')
    yield seiche.problem("klein_gordon", points=8)
    yield seiche.Problem(fields=["q", "p"], H="p^2/2 + q^4/4", D={"p": 0.1}, initial={"q": 1, "p": 0})
    yield seiche.Problem(M=np.eye(4), V=quartic, gradient=cubic, gamma=0.1, z0=[1, 0, 0, 0.5])
    yield seiche.load(case, **{"problem.gamma": 0.2})
    yield seiche.load(case).problem


def test_problems_and_cases_are_copied_and_pickled(tmp_path):
    for given in made(tmp_path):
        expected = seiche.solve(given, 1.0, h=0.1)
        for again in (pickle.loads(pickle.dumps(given)), copy.deepcopy(given), copy.copy(given)):
            assert type(again) is type(given)
            assert np.array_equal(seiche.solve(again, 1.0, h=0.1).y, expected.y)


def test_a_problem_is_pickled_as_it_was_made():
    M, z0 = np.eye(2), np.array([1.0, 0.0])
    p = seiche.Problem(M=M, V="u^4/4", z0=z0)
    M[0, 0] = z0[0] = 7.0
    assert np.array_equal(pickle.loads(pickle.dumps(p)).z0, [1.0, 0.0])


def test_results_are_pickled_but_for_a_dense_output():
    wave = seiche.problem("klein_gordon", points=8)
    r = seiche.solve(wave, 1.0, h=0.1)
    again = pickle.loads(pickle.dumps(r))
    assert np.array_equal(again.y, r.y) and again.status == "success" and again.to_xarray is not None
    with pytest.raises(TypeError, match="dense output lives in one process"):
        pickle.dumps(seiche.solve(wave, 1.0, h=0.1, dense_output=True))
    e = seiche.solve_ensemble(wave, 1.0, np.outer([1.0, 0.5], wave.z0), h=0.1)
    assert np.array_equal(pickle.loads(pickle.dumps(e)).y, e.y)
