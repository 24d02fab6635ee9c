"""Parameters from measurements: found, with standard deviations that are true, and refused where data say nothing."""

import pickle
import warnings

import numpy as np
import pytest

import seiche

pytest.importorskip("scipy")


def oscillator(gamma=0.1, k=1.0, q=1.0):
    return seiche.Problem(
        fields=["q", "p"],
        H="p^2/2 + k*q^2/2",
        parameters={"k": k, "gamma": gamma},
        D={"p": "gamma"},
        initial={"q": q, "p": 0},
    )


def exact(t, gamma=0.1, k=1.0, q=1.0):
    w = np.sqrt(k - gamma**2 / 4)
    return q * np.exp(-gamma * t / 2) * (np.cos(w * t) + gamma / (2 * w) * np.sin(w * t))


T = np.linspace(0.2, 20, 100)


def noise(seed, size=T.size, sigma=0.02):
    return sigma * np.random.default_rng(seed).standard_normal(size)


def test_exact_data_give_the_parameters_back():
    found = seiche.fit(
        oscillator(0.3, 0.8, 0.9), T, exact(T), {"gamma": (0.3, 0, 1), "k": (0.8, 0.1, 3), "initial.q": 0.9}, sigma=1e-6
    )
    assert found.success
    for name, value in {"gamma": 0.1, "k": 1.0, "initial.q": 1.0}.items():
        assert found.parameters[name] == pytest.approx(value, abs=1e-6)
    assert "gamma" in repr(found) and "±" in repr(found)


def test_standard_deviations_are_those_of_many_repetitions():
    pulls, chi2 = [], []
    for seed in range(40):
        found = seiche.fit(
            oscillator(0.12, 0.9), T, exact(T) + noise(seed), {"gamma": (0.12, 0, 1), "k": 0.9}, sigma=0.02
        )
        pulls.append(
            [(found.parameters["gamma"] - 0.1) / found.std["gamma"], (found.parameters["k"] - 1) / found.std["k"]]
        )
        chi2.append(found.chi2)
    pulls = np.array(pulls)
    # Of 40 draws of N(0, 1) the mean is within 4/√40 of 0 and Σ² within [15, 80], but for one in some ten thousand.
    assert (np.abs(pulls.mean(axis=0)) < 4 / np.sqrt(40)).all()
    assert ((15 < (pulls**2).sum(axis=0)) & ((pulls**2).sum(axis=0) < 80)).all()
    assert found.dof == 98 and abs(np.mean(chi2) - 98) < 4 * np.sqrt(2 * 98 / 40)


def test_sigma_is_estimated_where_it_is_not_given():
    given, estimated = (
        seiche.fit(oscillator(0.2), T, exact(T) + noise(3), {"gamma": (0.2, 0, 1)}, sigma=sigma)
        for sigma in (0.02, None)
    )
    assert estimated.sigma[0][0] == pytest.approx(0.02, rel=0.25)
    assert estimated.p_value is None and 0 < given.p_value < 1
    assert estimated.parameters["gamma"] == pytest.approx(given.parameters["gamma"], abs=1e-6)
    assert estimated.std["gamma"] == pytest.approx(given.std["gamma"] * estimated.sigma[0][0] / 0.02, rel=1e-3)


def test_several_records_share_parameters_and_keep_their_own():
    t = [T, T[:60]]
    data = [exact(T, q=1.0) + noise(1), exact(T[:60], q=2.0) + noise(2, 60)]
    found = seiche.fit(
        oscillator(0.2, q=1.5), t, data, {"gamma": (0.2, 0, 1), "initial.q[0]": 1.5, "initial.q[1]": 1.5}, sigma=0.02
    )
    assert found.parameters["initial.q[0]"] == pytest.approx(1.0, abs=5 * found.std["initial.q[0]"])
    assert found.parameters["initial.q[1]"] == pytest.approx(2.0, abs=5 * found.std["initial.q[1]"])
    assert [r.shape for r in found.residuals] == [(100,), (60,)]
    assert len(found.results) == 2


def test_a_function_observes_what_was_measured():
    problem = oscillator(0.3)
    fine = seiche.solve(oscillator(0.1), 20.0, method="egc8", tolerance=1e-12, t_eval=T)
    data = np.array([fine.y[0] ** 2, fine.y[1]])
    found = seiche.fit(problem, T, data, {"gamma": (0.3, 0, 1)}, lambda t, y: [y[0] ** 2, y[1]], sigma=1e-5)
    assert found.parameters["gamma"] == pytest.approx(0.1, abs=1e-6)
    assert found.residuals[0].shape == (2, 100)
    found = seiche.fit(problem, T, fine.y[1], {"gamma": (0.3, 0, 1)}, "p", sigma=1e-5)
    assert found.parameters["gamma"] == pytest.approx(0.1, abs=1e-6)


def test_a_field_on_a_grid_and_a_parameter_of_a_case_file(tmp_path):
    text = (
        '[problem]\nname = "klein_gordon"\npoints = 16\nalpha = 1.0\ngamma = 0.3\n'
        'initial = { u = "exp(-4*(x-1)^2)", v = "0" }\n[time]\nend = 4.0\n'
    )
    (tmp_path / "case.toml").write_text(text)
    case = seiche.load(tmp_path / "case.toml")
    t = np.linspace(0.5, 4, 8)
    true = seiche.solve(seiche.load(tmp_path / "case.toml", **{"problem.gamma": 0.1}), method="egc6", h=0.01, t_eval=t)
    found = seiche.fit(case, t, true.field("u").reshape(8, 16).T, {"gamma": (0.3, 0, 1)}, sigma=1e-5)
    assert found.parameters["gamma"] == pytest.approx(0.1, abs=1e-5)


def test_what_the_data_cannot_tell_is_said():
    stated = seiche.Problem(
        fields=["q", "p"], H="p^2/2 + q^2/2", parameters={"a": 0.1, "b": 0.1, "c": 1.0}, D={"p": "a + b"},
        initial={"q": 1, "p": 0},
    )  # fmt: skip
    with pytest.warns(seiche.SeicheWarning, match="the data do not tell a and b apart") as said:
        found = seiche.fit(stated, T, exact(T) + noise(1), {"a": 0.1, "b": 0.1}, sigma=0.02)
    assert len(said) == 1
    assert found.std == {"a": np.inf, "b": np.inf} and np.isnan(found.covariance).all()
    assert found.parameters["a"] + found.parameters["b"] == pytest.approx(0.1, abs=0.02)
    with pytest.warns(seiche.SeicheWarning, match="the data do not depend on initial.p"):
        found = seiche.fit(
            oscillator(), T, T * 0 + 1, {"initial.p": 0.0, "k": 0.9}, lambda t, y: 0 * y[0] + 1 / 0.9, sigma=1.0
        )
    with pytest.warns(seiche.SeicheWarning, match="hardly tell a from b: their correlation is -0.99"):
        stated = seiche.Problem(
            fields=["q", "p"], H="p^2/2 + q^2/2", parameters={"a": 0.1, "b": 0.1}, D={"p": "a + b*(1 + t/1000)"},
            initial={"q": 1, "p": 0},
        )  # fmt: skip
        seiche.fit(stated, T, exact(T) + noise(1), {"a": 0.1, "b": 0.1}, sigma=0.02)


@pytest.mark.parametrize("size", [1e-9, 1e-3, 1.0, 1e9])
@pytest.mark.parametrize("sigma", [None, 0.02])
def test_data_of_any_size_are_fitted_alike(size, sigma):
    data = size * (exact(T) + noise(1))
    given = None if sigma is None else sigma * size
    found = seiche.fit(
        oscillator(0.3), T, data, {"gamma": (0.3, 0, 1), "k": 0.9}, lambda t, y: size * y[0], sigma=given
    )
    one = seiche.fit(oscillator(0.3), T, data / size, {"gamma": (0.3, 0, 1), "k": 0.9}, sigma=sigma)
    assert found.parameters["gamma"] == pytest.approx(one.parameters["gamma"], abs=0.05 * one.std["gamma"])
    assert found.std["gamma"] == pytest.approx(one.std["gamma"], rel=0.02)
    small = seiche.fit(oscillator(0.3, q=size), T, data, {"gamma": (0.3, 0, 1), "k": 0.9}, sigma=given)
    assert small.parameters["gamma"] == pytest.approx(one.parameters["gamma"], abs=0.1 * one.std["gamma"])


@pytest.mark.parametrize("guess", [0.0, 0.1, (0.1, -2, 2), (0.0, -2, 2), 1e-6])
def test_a_guess_of_zero_or_of_the_wrong_sign_is_left(guess):
    stated = seiche.Problem(fields=["q", "p"], H="p^2/2 + q^2/2", D={"p": 0.1}, initial={"q": 1, "p": -0.5})
    true = seiche.solve(stated, 20.0, method="egc8", tolerance=1e-11, t_eval=T).y[0]
    found = seiche.fit(stated, T, true + noise(1), {"initial.p": guess}, sigma=0.02)
    assert found.parameters["initial.p"] == pytest.approx(-0.5, abs=5 * found.std["initial.p"])
    assert found.std["initial.p"] < 0.01


def test_a_bound_of_zero_is_said_and_refused_values_are_not_tried_again():
    with pytest.warns(seiche.SeicheWarning, match="k2 ended at its bound 0"):
        stated = seiche.Problem(
            fields=["q", "p"],
            H="p^2/2 + q^2/2 + k2*q^4",
            parameters={"k2": 0.1},
            D={"p": 0.1},
            initial={"q": 1, "p": 0},
        )
        found = seiche.fit(stated, T, exact(T, k=0.9) + noise(1), {"k2": (0.1, 0, 1)}, sigma=0.02)
    assert found.parameters["k2"] == pytest.approx(0, abs=1e-6)
    drag = seiche.Problem(
        fields=["q", "p"],
        H="p^2/2 + q^2/2",
        friction={"kind": "quadratic", "coefficient": 0.1},
        initial={"q": 1, "p": 0},
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = seiche.fit(drag, T, np.cos(T), {"friction.coefficient": 0.1}, sigma=0.02)
    assert 0 <= found.parameters["friction.coefficient"] < 1e-3


def test_runs_that_fail_on_the_way_are_no_answer():
    stated = seiche.Problem(
        fields=["q", "p"], H="p^2/2 + q^2/2 - a*q^3/3", parameters={"a": 0.5}, initial={"q": 0.9, "p": 0}
    )  # escapes to infinity where a > 1.1
    true = seiche.solve(stated, 20.0, method="egc8", tolerance=1e-11, t_eval=T).y[0]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = seiche.fit(stated, T, 1e9 * true, {"a": (0.9, 0, 10)}, lambda t, y: 1e9 * y[0])
    assert found.parameters["a"] == pytest.approx(0.5, abs=1e-4)
    with pytest.raises(ValueError, match="the run with the first guess does not reach the end of the data"):
        seiche.fit(stated, T, true, {"a": (5, 0, 10)})


def test_neighbours_are_compared_in_standard_deviations():
    t = np.linspace(0.1, 20, 400)
    sigma = np.full(400, 0.02)
    sigma[200:202] = 20.0
    for seed in range(6):  # of these, unweighted, two were called no noise
        data = exact(t) + sigma * np.random.default_rng(seed).standard_normal(400)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            seiche.fit(oscillator(0.2), t, data, {"gamma": (0.2, 0, 1)}, sigma=sigma)


def test_a_perfect_fit_has_no_complaint():
    data = seiche.solve(oscillator(0.1), 20.0, method="egc4", h=0.1, t_eval=T).y[0]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = seiche.fit(oscillator(0.1), T, data, {"gamma": 0.1}, h=0.1)
        assert found.chi2 == found.dof
        found = seiche.fit(oscillator(0.12), T, data, {"gamma": 0.12}, h=0.1)
    assert found.parameters["gamma"] == pytest.approx(0.1, abs=1e-9)


def test_steps_that_stay_too_long_are_said():
    stiff = seiche.Problem(fields=["q", "p"], H="p^2/2 + 1 - cos(q)", D={"p": 0.1}, initial={"q": 2, "p": 0})
    data = seiche.solve(stiff, 20.0, method="egc8", tolerance=1e-12, t_eval=T).y[0] + noise(1, sigma=1e-9)
    found = seiche.fit(stiff, T, data, {"initial.q": 1.9}, sigma=1e-9, method="egc8")
    assert found.parameters["initial.q"] == pytest.approx(2, abs=1e-8)
    assert found.chi2 == pytest.approx(np.sum((found.residuals[0] / 1e-9) ** 2), rel=1e-6)
    with pytest.warns(seiche.SeicheWarning, match="steps of .* add errors of up to"):
        found = seiche.fit(stiff, T, data, {"initial.q": 1.9}, sigma=1e-12, method="seisav")
    assert found.chi2 == pytest.approx(np.sum((found.residuals[0] / 1e-12) ** 2), rel=1e-6)


def test_a_bound_that_was_reached_and_a_model_that_does_not_fit_are_said():
    with pytest.warns(seiche.SeicheWarning) as said:
        found = seiche.fit(oscillator(0.3), T, exact(T) + noise(1), {"gamma": (0.3, 0.2, 1)}, sigma=0.02)
    assert found.parameters["gamma"] == pytest.approx(0.2, abs=1e-6)
    assert "gamma ended at its bound 0.2" in found.message and "the model does not fit" in found.message
    assert len(said) == 2
    with pytest.warns(seiche.SeicheWarning, match="residuals are no noise"):
        seiche.fit(oscillator(0.3), T, exact(T, k=1.1) + noise(1), {"gamma": (0.3, 0, 1)})
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        seiche.fit(oscillator(0.3), T, exact(T) + noise(1), {"gamma": (0.3, 0, 1)})


def test_steps_are_short_enough_for_the_noise():
    coarse = seiche.fit(oscillator(0.2), T, exact(T) + noise(1), {"gamma": (0.2, 0, 1)}, sigma=0.02)
    fine = seiche.fit(oscillator(0.2), T, exact(T) + noise(1), {"gamma": (0.2, 0, 1)}, sigma=0.02, h=0.01)
    assert abs(coarse.parameters["gamma"] - fine.parameters["gamma"]) < 0.2 * fine.std["gamma"]
    assert coarse.h > 0.05


def test_a_picture_has_data_fit_and_band():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    found = seiche.fit(oscillator(0.2), T, exact(T) + noise(1), {"gamma": (0.2, 0, 1)}, sigma=0.02)
    axes = found.plot()
    measured, fitted = axes.get_lines()
    assert np.allclose(fitted.get_ydata(), exact(T), atol=0.02)
    assert np.allclose(measured.get_ydata() - fitted.get_ydata(), found.residuals[0])
    assert len(axes.collections) == 1


BAD = [
    ((T, exact(T)), {}, "parameters must name"),
    ((T, exact(T)), {"gamma": (0.1, 0)}, "must be a first guess, or"),
    ((T, exact(T)), {"gamma": (2, 0, 1)}, "least ≤ guess ≤ most"),
    ((T, exact(T)), {"gama": 0.1}, "did you mean 'gamma'"),
    ((T, exact(T)), {"gamma[1]": 0.1}, "is of record 1, and there are 1"),
    ((T, exact(T)[:-1]), {"gamma": 0.1}, "its last axis must have the 100 times"),
    ((T[::-1], exact(T)), {"gamma": 0.1}, "t must ascend: t[1] = "),
    ((T - 1, exact(T)), {"gamma": 0.1}, "before the run, which begins at 0"),
    ((T, np.where(T > 19.9, np.nan, 1)), {"gamma": 0.1}, "data[99] is nan; leave out"),
    ((T[:2], exact(T)[:2]), {"gamma": 0.1, "k": 1.0}, "2 measurements cannot determine 2 parameters"),
    (([T, T], [exact(T)]), {"gamma": 0.1}, "data must be a list of as many"),
    ((T, 0 * T), {"gamma": 0.1}, "data are all zero"),
    ((T, exact(T)), {"gamma": 0.1, "gamma[0]": 0.1}, "gamma is one of all records, or one of each"),
    ((T, exact(T)), {"D": 0.1}, "D = 0.1 must be a table such as"),
    ((T, exact(T)), {"initial": 0.1}, "initial = 0.1 must be a preset (zero), "),
    ((T, exact(T)), {"a b": 0.1}, "'a b' is no name"),
    ((T, exact(T)), {"method.h": 0.1}, "unknown key in [problem] custom 'method'."),
]


@pytest.mark.parametrize("data, parameters, sentence", BAD, ids=lambda value: value if isinstance(value, str) else "")
def test_bad_data_get_one_sentence(data, parameters, sentence):
    with pytest.raises(ValueError) as refused:
        seiche.fit(oscillator(), *data, parameters)
    assert sentence in str(refused.value)
    assert "\n" not in str(refused.value)


def test_what_cannot_change_a_little_is_no_parameter():
    wave = seiche.problem("klein_gordon", points=16)
    with pytest.raises(ValueError, match=r"^parameters: points is a whole number, and what is looked for changes"):
        seiche.fit(wave, T, exact(T), {"points": 16}, lambda t, y: y[0])
    with pytest.raises(ValueError, match="^parameters: H is a formula; look for a number in it"):
        seiche.fit(oscillator(), T, exact(T), {"H": 0.1})
    with pytest.raises(ValueError, match="^parameters: initial.q is no number of the problem's own: give a first guess$"):
        seiche.fit(oscillator(), T, exact(T), ["gamma", "initial.q"])


def test_a_search_may_begin_with_the_value_of_the_problem():
    begins = seiche.fit(oscillator(0.2), T, exact(T) + noise(1), {"gamma": 0.2}, sigma=0.02)
    for parameters in (["gamma"], {"gamma": None}):
        assert seiche.fit(oscillator(0.2), T, exact(T) + noise(1), parameters, sigma=0.02).parameters == begins.parameters


def test_parameters_of_all_sizes_are_found_side_by_side():
    stated = seiche.Problem(
        fields=["q", "p"], H="p^2/2 + large*q^2/2e9", parameters={"small": 3e-9, "large": 0.8e9}, D={"p": "1e9*small/30"},
        initial={"q": 1, "p": 0},
    )  # fmt: skip
    found = seiche.fit(stated, T, exact(T) + noise(1), {"small": 9e-9, "large": 0.9e9}, sigma=0.02)
    same = seiche.fit(oscillator(), T, exact(T) + noise(1), {"gamma": 0.3, "k": 0.9}, sigma=0.02)
    for name, ours, unit in [("small", "gamma", 3e-8), ("large", "k", 1e9)]:
        assert found.parameters[name] / unit == pytest.approx(same.parameters[ours], abs=0.01 * same.std[ours])
        assert found.std[name] / unit == pytest.approx(same.std[ours], rel=1e-3)


def test_the_search_ends_alike_whatever_round_off_does():
    found = []
    for seed in range(5):
        data = (exact(T) + noise(1)) * (1 + 1e-12 * np.random.default_rng(seed).standard_normal(T.size))
        found.append(seiche.fit(oscillator(0.3), T, data, {"gamma": (0.3, 0, 1), "k": 0.9}, sigma=0.02))
    assert len({one.nfev for one in found}) == 1 and found[0].nfev < 12
    assert np.ptp([one.parameters["gamma"] for one in found]) < 1e-6 * found[0].std["gamma"]


def test_a_found_problem_keeps_its_values_where_it_is_sent():
    found = seiche.fit(
        oscillator(0.2, q=0.9), T, exact(T) + noise(1), {"gamma": (0.2, 0, 1), "initial.q": 0.9}, sigma=0.02
    )
    there = pickle.loads(pickle.dumps(found.results[0].problem))
    assert there.z0[0] == found.parameters["initial.q"]
    again = seiche.solve(there, T[-1], h=found.h, method="egc4", t_eval=T)
    assert np.array_equal(again.y, found.results[0].y)


def test_other_arguments_get_one_sentence():
    for arguments, sentence in [
        ({"observe": "x"}, "observe = 'x' is no field; custom has q, p"),
        ({"sigma": 0.0}, "sigma must be finite and > 0"),
        ({"observe": lambda t, y: y}, "observe returns the shape (2, 100); data have (1, 100)"),
        ({"tolerance": 1e-6}, "fit chooses tolerance itself"),
        ({"observe": lambda t, y: y[0] / 0}, "observe returns a value that is no finite number"),
    ]:
        with pytest.raises(ValueError) as refused:
            seiche.fit(oscillator(), T, exact(T), {"gamma": 0.1}, **arguments)
        assert sentence in str(refused.value)
    with pytest.raises(ValueError, match="sigma must be given for all records, or for none"):
        seiche.fit(oscillator(), [T, T], [exact(T)] * 2, {"gamma": 0.1}, sigma=[0.02, None])
    parts = seiche.Problem(M=np.eye(2), z0=[1, 0])
    with pytest.raises(ValueError, match="by formulas, or by its name"):
        seiche.fit(parts, T, exact(T), {"gamma": 0.1})


@pytest.mark.parametrize(
    ("section", "taken"),
    [
        ('[method]\nname = "seisav"\nC = 2.0\n', "seisav"),
        ('[method] # how\nh = 0.1\n\n  name = "savf"\n', "savf"),
        ('method = { C = 2.0, name = "seisav" }\n', "seisav"),
        ('method.name = "egc6"\n', "egc6"),
        ('[method]\nname = "auto"\n', "egc4"),
        ("[method]\nh = 0.1\n", "egc4"),
        ("", "egc4"),
    ],
)
def test_the_method_of_the_case_is_taken(section, taken, tmp_path):
    problem = (
        '[problem]\nname = "custom"\nfields = ["q", "p"]\nH = "p^2/2 + q^2/2"\nD = { p = "c" }\n'
        "parameters = { c = 0.2 }\ninitial = { q = 1, p = 0 }\n"
    )
    at_top = section.startswith("method")
    (tmp_path / "case.toml").write_text(section + problem if at_top else problem + section + "[time]\nend = 20.0\n")
    case = seiche.load(tmp_path / "case.toml")
    found = seiche.fit(case, T, exact(T) + noise(1), {"c": (0.2, 0, 1)}, sigma=0.02)
    assert {result.method for result in found.results} == {taken}
    assert found.parameters["c"] == pytest.approx(0.1, abs=0.02)
    if "C =" not in section:
        assert (
            seiche.fit(case, T, exact(T) + noise(1), {"c": 0.2}, sigma=0.02, method="egc2").results[0].method == "egc2"
        )
    if section == "":
        case = seiche.load(tmp_path / "case.toml", **{"method.name": "egc6"})
        assert seiche.fit(case, T, exact(T) + noise(1), {"c": 0.2}, sigma=0.02).results[0].method == "egc6"


def test_an_ensemble_is_no_record(tmp_path):
    (tmp_path / "case.toml").write_text(
        '[problem]\nname = "oscillator"\n[time]\nend = 20.0\n[ensemble]\nmembers = 2\ngamma = { uniform = [0.1, 0.2] }\n'
    )
    with pytest.raises(ValueError, match=r"^fit takes one run: remove \[ensemble\] from .*case\.toml$"):
        seiche.fit(seiche.load(tmp_path / "case.toml"), T, exact(T), {"gamma": 0.1})
