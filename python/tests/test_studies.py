"""check, spectrum and converge: the documents that they promise, and how they are called."""

import re

import numpy as np
import pytest
import seiche


def by_parts(**changes):
    return seiche.Problem(**({"M": np.eye(2), "V": "u^4/4", "z0": [1, 0]} | changes))


def test_the_document_of_check_has_the_keys_that_its_docstring_names():
    promised = re.search(r"\{\"hypotheses\": \[\{(.*?), …\], (.*)\}\.", seiche.check.__doc__)
    of_hypothesis, of_law = (re.findall(r'"(\w+)"', part) for part in promised.groups())
    for problem in ("klein_gordon", "rigid_body"):
        document = seiche.check(problem, t_end=1.0, method="egc4")
        assert list(document) == ["hypotheses", of_law[0]]
        assert list(document["law"]) == of_law[1:]
        assert all(list(hypothesis) == of_hypothesis for hypothesis in document["hypotheses"])


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: seiche.check(by_parts()), "^t_end is missing: give the end"),
        (lambda: seiche.converge(by_parts(), ["seavf"], [0.1]), "^t_end is missing: give the end"),
        (lambda: seiche.check(by_parts(z0=None), 1.0), "^z0 is missing: give it to seiche.Problem$"),
        (lambda: seiche.converge(by_parts(z0=None), ["seavf"], [0.1], 1.0), "^z0 is missing"),
        (lambda: seiche.check(seiche.Problem(fields=["q", "p"], H="p^2/2 + q^4/4"), 1.0), "^the initial state is missing: give initial to seiche.Problem$"),
        (lambda: seiche.spectrum(by_parts()), "^h is missing, and spectrum looks at one step"),
        (lambda: seiche.converge("oscillator", ["seavf"], ["1/a"], 1.0), "^h = .1/a. "),
        (lambda: seiche.converge("oscillator", ["seavf"], [-0.1], 1.0), "^h = -0.1 must be > 0"),
        (lambda: seiche.converge("oscillator", ["seavf"], [], 1.0), "^there must be at least one step size$"),
        (lambda: seiche.converge("oscillator", [], [0.1], 1.0), "^there must be at least one method$"),
    ],
)  # fmt: skip
def test_what_a_study_needs_is_asked_for(call, sentence):
    with pytest.raises(ValueError, match=sentence):
        call()


def test_what_the_oscillator_of_the_examples_does_is_not_said_of_another_problem():
    assert seiche.check(by_parts(gamma="2 - t"), 1.0)["law"]["promised"]
    assert not seiche.check(by_parts(gamma="2 - t"), 3.0)["law"]["promised"]


def test_a_step_size_and_a_method_need_no_list_and_fractions_may_be_texts():
    def rows(methods, h):
        return [(row["method"], row["h"], row["error"]) for row in seiche.converge("oscillator", methods, h, 1.0, timed=False)["rows"]]

    wanted = rows(["seavf"], [1 / 64])
    assert wanted[0][:2] == ("seavf", 1 / 64)
    assert rows("seavf", 1 / 64) == rows("seavf", "1/64") == rows(["seavf"], ["1/64"]) == rows(("seavf",), np.array([1 / 64])) == wanted
