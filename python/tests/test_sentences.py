"""What is said of calls that cannot mean anything, and of habits from other programs."""

import warnings

import numpy as np
import pytest
import seiche


def duffing(**changes):
    parts = {"fields": ["q", "p"], "H": "p^2/2 + q^4/4", "D": {"p": 0.1}, "initial": {"q": 1, "p": 0}}
    return seiche.Problem(**(parts | changes))


def event(**attributes):
    def g(t, y):
        return y[0]

    g.__dict__.update(attributes)
    return g


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda p: seiche.solve(p, 1.0, t_eval=[]), "^t_eval is empty: give the times"),
        (lambda p: seiche.solve(p, 1.0, t_eval=[1j]), "^t_eval is complex; it must be real"),
        (lambda p: seiche.solve(p, 1.0, t_eval=[-np.nan]), "^t_eval holds a time that is no finite number"),
        (lambda p: seiche.Problem(M=np.eye(2), gamma=-np.nan), "a finite number, not nan$"),
        (lambda p: seiche.Problem(M=-np.nan * np.eye(2)), r"the entry .1, 1. = nan, which"),
        (lambda p: duffing(initial={"q": np.nan, "p": 0}), "there is no 'nan': numbers in formulas are finite"),
        (lambda p: seiche.solve(p, 1.0, t_eval="a"), "^t_eval = 'a' must be an array of numbers"),
        (lambda p: seiche.solve(p, 1j), "^t_span is complex"),
        (lambda p: seiche.solve(p, 1.0, z0=[1j, 0]), "^z0 is complex; it must be real"),
        (lambda p: seiche.solve_ensemble(p, 1.0, z0=[[1j, 0]]), "^z0 is complex"),
        (lambda p: seiche.Problem(M=np.eye(2), z0=[1j, 0]), "^z0 is complex"),
        (lambda p: seiche.solve(p, 1.0, h=0.1, record_every=2.5), "^record_every = 2.5 must be a whole number"),
        (lambda p: seiche.solve(p, 1.0, h=0.1, record_every=10**30), "^record_every = 10+ must be ≤ "),
        (lambda p: seiche.solve(p, 1.0, h=0.1, ledger="no"), "^ledger = 'no' must be True or False"),
        (lambda p: seiche.solve(p, 1.0, h=0.1, dense_output=1), "^dense_output = 1 must be True or False"),
        (lambda p: seiche.solve(p, 1.0, h=0.1, threads=10**10), "^threads = 10000000000 must be ≤ "),
        (lambda p: seiche.solve(p, 1.0, h=0.1, events=event(direction="up")), "^the direction of an event is 'up'"),
        (lambda p: seiche.solve(p, 1.0, h=0.1, events=event(terminal="yes")), "^terminal of an event is 'yes'"),
        (lambda p: seiche.solve_ensemble(p, 1.0, h=0.1, events=event()), "^unknown argument 'events'"),
        (lambda p: seiche.Problem(M=np.eye(2), fields=2.0), "^fields = 2.0 must be 1 or 2"),
        (lambda p: seiche.solve(p, 1.0, threads=0), "^threads = 0 must be ≥ 1"),
        (lambda p: seiche.solve(p, 1.0, h=0.1, threads=65536), "^threads = 65536 must be ≤ 1024$"),
        (lambda p: seiche.solve_ensemble(p, 1.0, z0=[[1, 0]], h=0.1, threads=65536), "^threads = 65536 must be ≤ 1024$"),
        (lambda p: seiche.solve(p, 1.0, threads=-3), "^threads = -3 must be ≥ 1"),
        (lambda p: seiche.solve(p, 1.0, threads=1.5), "^threads = 1.5 must be a whole number"),
        (lambda p: seiche.solve_ensemble(p, 1.0, z0=[[1, 0]], threads=0), "^threads = 0 must be ≥ 1"),
        (lambda p: seiche.solve(p, 1.0, foo=1), "^unknown argument 'foo'. Allowed: method, h, tolerance"),
        (lambda p: duffing(foo=1), "^unknown key in .problem. custom 'foo'. Allowed: initial, friction"),
        (lambda p: duffing(z0=[1.0, 0.0]), "^z0 belongs to a problem by parts; with H by a formula write initial by formulas, or give"),
        (lambda p: duffing(grows_outward=True), "^grows_outward belongs to a problem by parts; of formulas it is found out$"),
        (lambda p: seiche.solve(p, 1.0, h=0.1, dense_output=True).sol(1j), "^t is complex; it must be real$"),
        (lambda p: seiche.solve(p, 1.0, h=0.1, dense_output=True).sol("a"), "^t = 'a' must be an array of numbers$"),
        (lambda p: duffing(initial={"q": 1}), "no formula for the field p; write p = 0 beside"),
    ],
)
def test_what_makes_no_sense_is_a_value_error_in_a_sentence(call, sentence):
    with pytest.raises(ValueError, match=sentence):
        call(duffing())


def function(*arguments):
    return arguments[0]


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: duffing(H=lambda q, p: p**2 / 2), 'H is a formula in quotes, .*; for Python functions give M, V and gradient'),
        (lambda: seiche.Problem(H=function), "H is a formula in quotes"),
        (lambda: duffing(D=function), r'D is a constant matrix, or by formulas a table, as in D={"p": "0.1\*\(1 \+ sin\(t\)\^2\)"}'),
        (lambda: duffing(D={"p": function}), "D is a constant matrix, or by formulas a table"),
        (lambda: seiche.Problem(M=np.eye(2), D=function), "D is a constant matrix"),
        (lambda: duffing(gamma=function), "gamma is a number, or a formula of the time in quotes"),
        (lambda: seiche.Problem(M=np.eye(2), gamma=np.sin), "gamma is a number, or a formula of the time in quotes"),
        (lambda: seiche.problem("oscillator", gamma=function), "gamma is a number, or a formula of the time in quotes"),
        (lambda: seiche.Problem(M=function), "M is a matrix, or by formulas a table"),
        (lambda: seiche.Problem(fields=["q", "p"], M={"p": 1}, V=function), "V as a Python function goes with matrices"),
        (lambda: duffing(initial={"q": np.sin, "p": 0}), "initial takes numbers and formulas in quotes, and no Python function"),
    ],
)
def test_a_function_where_a_formula_belongs_is_told_what_to_write(call, sentence):
    with pytest.raises(TypeError, match=f"^{sentence}") as refused:
        call()
    assert "\n" not in str(refused.value) and "0x" not in str(refused.value)


@pytest.mark.parametrize(
    "call",
    [
        lambda: duffing(H="p^2/2 + sqrt(q)", initial={"q": -1, "p": 0}),
        lambda: duffing(H="p^2/2 + 1/q", initial={"q": 0, "p": 0}),
        lambda: seiche.problem("klein_gordon", initial={"u": "log(-x)", "v": 0}),
        lambda: duffing(friction={"kind": "cubik"}),
    ],
)
def test_no_sentence_speaks_of_a_file_that_was_never_written(call):
    with pytest.raises(ValueError) as refused:
        call()
    assert "keywords" not in str(refused.value)


@pytest.mark.parametrize(
    "call",
    [
        lambda f: seiche.solve(f, (0, 10), [1.0]),
        lambda f: seiche.solve_ensemble(f, 10.0, [[1.0]]),
        lambda f: seiche.check(f),
        lambda f: seiche.Problem(f),
    ],
)
def test_a_right_hand_side_is_answered_with_what_is_wanted_instead(call):
    with pytest.raises(TypeError, match="not a right-hand side.*S∇H.*seiche.Problem\\(fields=.*H=.*M=.*S=.*D=.*V="):
        call(lambda t, z: -z)


def stiff(**parameters):
    """Duffing, which steps of half a period leave with a modified energy that has nothing to do with H."""
    return seiche.problem("oscillator", **({"omega_squared": 1, "alpha": 100, "gamma": 0.01} | parameters))


def test_what_may_be_inaccurate_is_a_warning():
    with pytest.warns(seiche.SeicheWarning, match="H itself rose from .* although no solution of the equation") as caught:
        result = seiche.solve(stiff(), 50.0, [2, 0], h=0.5)
    assert caught[0].filename == __file__
    assert result.success and str(caught[0].message) in result.message
    with pytest.warns(seiche.SeicheWarning, match="2 of 2 members may be inaccurate, the first of them member 0: .*H itself rose"):
        seiche.solve_ensemble(stiff(), 50.0, [[2, 0], [2.1, 0]], h=0.5)
    with pytest.warns(seiche.SeicheWarning, match="no solution was found"):
        seiche.solve(seiche.problem("klein_gordon", points=64, alpha=1), 10.0, method="crkn4", linear="explicit", h=0.5)


def test_a_run_without_fault_warns_of_nothing():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        seiche.solve(stiff(), 1.0, [2, 0], h=1 / 256)
        seiche.solve_ensemble(stiff(), 1.0, [[2, 0], [2.1, 0]], h=1 / 256)


def test_a_long_message_is_printed_whole():
    with pytest.warns(seiche.SeicheWarning):
        result = seiche.solve(stiff(), 50.0, [2, 0], h=0.5)
    assert len(result.message) > 200
    printed = repr(result).splitlines()
    assert max(map(len, printed)) < 130
    assert result.message in " ".join(line.strip() for line in printed)


def test_a_step_size_that_was_not_given_is_said(tmp_path):
    (tmp_path / "case.toml").write_text('[problem]\nname = "oscillator"\n[time]\nend = 1.0\n')
    assert any("h is not given" in note for note in seiche.solve(seiche.load(tmp_path / "case.toml")).notes)
    assert any("h is not given: steps of 0.015625" in note for note in seiche.solve(duffing(), 1.0).notes)
    assert not any("not given" in note for note in seiche.solve(duffing(), 1.0, h=0.1).notes)
    assert not any("not given" in note for note in seiche.solve(duffing(), 1.0, tolerance=1e-6).notes)


def test_a_law_of_friction_may_name_the_fields():
    by_fields = duffing(friction={"kind": "formula", "r": "0.3*p^3*(1 + q^2)"})
    by_letters = duffing(friction={"kind": "formula", "r": "0.3*v^3*(1 + u^2)"})
    runs = [seiche.solve(p, 5.0, h=0.1, method="egc4").y for p in (by_fields, by_letters)]
    assert np.array_equal(*runs)


def test_a_few_degrees_of_freedom_have_no_points():
    assert repr(duffing()) == "<seiche.Problem custom: q, p>"
    assert "at 64 points" in repr(seiche.problem("klein_gordon", points=64))


def test_one_step_is_singular():
    assert seiche.solve_ensemble(duffing(), 0.1, [[1, 0]], h=0.1).message == ["reached t = 0.1 in 1 step"]


def test_keys_of_a_case_file_are_called_as_they_are_written_there(tmp_path):
    case = tmp_path / "case.toml"
    case.write_text('[problem]\nname = "oscillator"\n')
    with pytest.raises(ValueError, match=r"^unknown key in \[method\] 'hh'; did you mean 'h'\? Allowed: name, h"):
        seiche.load(case, **{"method.hh": 1})


def test_complex_numbers_are_refused_from_functions_too():
    with pytest.raises(ValueError, match="^V returned a complex number; it must return a real one"):
        seiche.Problem(M=np.eye(2), V=lambda u: np.sum(u**2) / 2 + np.complex128(1e3j), gradient=lambda u: u, z0=[1, 0])


# Else the interpreter dies: whoever parses such a text goes down one call for each level.
@pytest.mark.parametrize("text", ["a" + ".a" * 40_000 + " = 1", "[a" + ".a" * 40_000 + "]", "a = " + "[" * 40_000])
def test_a_case_file_without_end_is_refused_in_a_line(text, tmp_path):
    (tmp_path / "deep.toml").write_text(text + "\n")
    with pytest.raises(ValueError, match="deep.toml:1:[0-9]+: .*more than 16 ") as refusal:
        seiche.load(tmp_path / "deep.toml")
    assert len(str(refusal.value).encode()) <= 400 and "\n" not in str(refusal.value)


def test_a_sentence_stays_short_whatever_was_given(tmp_path):
    for make in (
        lambda: duffing(H="p^2/2 + " + "x" * 3000),
        lambda: seiche.load(tmp_path / ("x" * 3000)),
        lambda: seiche.solve(duffing(), 1.0, method="x" * 100_000),
    ):
        with pytest.raises(ValueError) as refusal:
            make()
        assert len(str(refusal.value).encode()) <= 400 and "\n" not in str(refusal.value)
