"""``python -m seiche fit``, which the program calls: what it prints, and how it refuses."""

import json
import subprocess
import sys

import numpy as np
import pytest

import seiche
from seiche import __main__ as command
from seiche.__main__ import main

pytest.importorskip("scipy")

CASE = """
[problem]
name = "custom"
fields = ["q", "p"]
H = "p^2/2 + k*q^2/2"
parameters = { k = 1.0, gamma = 0.2 }
D = { p = "gamma" }
initial = { q = 1, p = 0 }
[time]
end = 20.0
"""
WANTED = ["--parameter", "gamma=0.2:0:1", "--parameter", "k=0.9"]


@pytest.fixture
def files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "case.toml").write_text(CASE)
    t = np.linspace(0.2, 20, 100)
    w = np.sqrt(1 - 0.05**2)
    data = np.exp(-0.05 * t) * (np.cos(w * t) + 0.05 / w * np.sin(w * t))
    data += 0.02 * np.random.default_rng(1).standard_normal(100)
    np.savetxt("data.csv", np.column_stack([t, data, 0 * t + 0.02]), delimiter=",", header="t,q,sigma", comments="")
    np.savetxt("two.txt", np.column_stack([t, data]), header="a comment")
    return t, data


def test_it_prints_what_seiche_fit_returns(files, capsys):
    t, data = files
    found = seiche.fit(seiche.load("case.toml"), t, data, {"gamma": (0.2, 0, 1), "k": 0.9}, sigma=0.02)
    lines = repr(found).splitlines()
    assert main(["fit", "case.toml", "data.csv", *WANTED, "--observe", "q"]) == 0
    printed = capsys.readouterr()
    assert printed.out.splitlines() == lines[:-1] and printed.err.splitlines() == [found.message]
    assert main(["fit", "case.toml", "two.txt", *WANTED, "--sigma", "0.02", "--json", "--quiet"]) == 0
    printed = capsys.readouterr()
    document = json.loads(printed.out)
    assert document["parameters"] == found.parameters and document["std"] == found.std and printed.err == ""
    assert document["chi2"] == found.chi2 and len(document["residuals"][0]) == 100


def test_it_runs_as_a_module_and_draws(files, tmp_path):
    words = ["fit", "case.toml", "data.csv", *WANTED, "--plot", "found.png", "--set", "problem.k=0.9"]
    done = subprocess.run([sys.executable, "-m", "seiche", *words], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("gamma = 0.100") and (tmp_path / "found.png").stat().st_size > 1000


def test_one_point_of_a_field_may_be_measured(files, tmp_path, capsys):
    (tmp_path / "wave.toml").write_text(
        '[problem]\nname = "klein_gordon"\npoints = 16\nalpha = 1.0\ngamma = 0.3\n'
        'initial = { u = "exp(-4*(x-1)^2)", v = "0" }\n[time]\nend = 4.0\n'
    )
    t = np.linspace(0.25, 4, 16)
    true = seiche.solve(seiche.load("wave.toml", **{"problem.gamma": 0.1}), method="egc6", h=0.01, t_eval=t)
    np.savetxt("wave.csv", np.column_stack([t, true.field("v")[:, 5]]))
    words = ["fit", "wave.toml", "wave.csv", "--parameter", "gamma=0.3:0:", "--sigma", "1e-4"]
    assert main([*words, "--observe", "v[5]", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["parameters"]["gamma"] == pytest.approx(0.1, abs=1e-4)
    assert main(words) == 2
    assert "u has 16 points: say which was measured, as in --observe u[0]" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ([], "the following arguments are required: CASE, DATA"),
        (["case.toml", "data.csv"], "--parameter is missing"),
        (["nofile", "data.csv", *WANTED], "nofile does not exist"),
        (["case.toml", "nofile", *WANTED], "nofile cannot be read: No such file or directory"),
        (["case.toml", "case.toml", *WANTED], "case.toml:3: 'name' is not a number"),
        (["case.toml", "data.csv", "--parameter", "=2"], "--parameter =2 must be NAME, NAME=GUESS, or NAME=GUESS:LEAST:MOST"),
        (["case.toml", "data.csv", "--parameter", "initial.q"], "initial.q is no number of the problem's own: give a first guess"),
        (["case.toml", "data.csv", "--parameter", "gama"], "parameters: gama is no number; did you mean 'gamma'?"),
        (["case.toml", "data.csv", "--parameter", "H=0.3"], "parameters: H is a formula"),
        (["case.toml", "nan.csv", *WANTED], "nan.csv:3: nan is not finite; leave out what was not measured"),
        (["case.toml", "swapped.csv", *WANTED], "swapped.csv: the first column is that of the time, and the header calls it q"),
        (["case.toml", "back.csv", *WANTED], "back.csv:4: times must ascend, and 0.1 follows 0.2"),
        (["case.toml", "data.csv", "--parameter", "gamma=0.1:0"], "--parameter gamma=0.1:0 must be"),
        (["case.toml", "data.csv", "--parameter", "gama=0.1"], "did you mean 'gamma'"),
        (["case.toml", "data.csv", *WANTED, "--parameter", "k=1"], "--parameter k is given twice"),
        (["case.toml", "data.csv", *WANTED, "--observe", "x"], "--observe x is not a field; custom has q, p"),
        (["case.toml", "data.csv", *WANTED, "--observe", "q[1]"], "there is no such point; they are 0 to 0"),
        (["case.toml", "data.csv", *WANTED, "--sigma", "0.1"], "the third column of data.csv has standard deviations already"),
        (["case.toml", "data.csv", *WANTED, "--sigma", "x"], "invalid float value: 'x'"),
        (["case.toml", "data.csv", *WANTED, "--method", "egc5"], "did you mean 'egc"),
        (["case.toml", "data.csv", *WANTED, "--bar"], "unrecognized arguments: --bar"),
        (["case.toml", "ragged.csv", *WANTED], "ragged.csv:3: 3 columns, which must be 2, as above"),
        (["case.toml", "one.csv", *WANTED], "one.csv:1: 1 column, which must be 2 or 3"),
        (["case.toml", "hole.csv", *WANTED], "hole.csv:2: '' is not a number"),
        (["case.toml", "empty.csv", *WANTED], "empty.csv holds no measurements"),
        (["case.toml", "comma.csv", *WANTED], "comma.csv:2: '0,2': decimals are written with a point"),
        (["case.toml", "first.csv", *WANTED], "first.csv:1: '0,1': decimals are written with a point"),
        (["case.toml", "spaces.csv", *WANTED], "spaces.csv:1: '0,1': decimals are written with a point"),
        (["case.toml", "data.csv", *WANTED, "--plot", "nowhere/found.png"], "nowhere/found.png cannot be written: No such file"),
        (["case.toml", "data.csv", *WANTED, "--plot", "data.csv/found.png"], "data.csv/found.png cannot be written: Not a dir"),
        (["case.toml", "data.csv", *WANTED, "--plot", "folder.png"], "folder.png cannot be written: Is a directory"),
        (["case.toml", "data.csv", *WANTED, "--plot", "found.xyz"], "--plot found.xyz must end in .png, .pdf or .svg"),
    ],
)  # fmt: skip
def test_mistakes_get_one_sentence_and_exit_code_2(words, sentence, files, tmp_path, capsys, monkeypatch):
    texts = {"ragged": "t,q\n0.1,1\n0.2,1,2", "one": "1\n2", "hole": "0.1,1\n0.2,", "empty": "t,q\n"}
    texts |= {"comma": "t;q\n0,2;1", "first": "0,1;1\n0,2;1", "spaces": "0,1\t1,0\n"}
    texts |= {"nan": "t,q\n0.1,1\n0.2,nan\n", "swapped": "q,t\n0.1,1\n0.2,1\n", "back": "t,q\n0.1,1\n0.2,1\n0.1,1\n"}
    (tmp_path / "folder.png").mkdir()
    if "--plot" in words:
        monkeypatch.setattr(command, "fit", lambda *_, **__: pytest.fail("the search began"))
    for name, text in texts.items():
        (tmp_path / f"{name}.csv").write_text(text)
    assert main(["fit", *words]) == 2
    printed = capsys.readouterr()
    assert printed.out == "" and printed.err.startswith("seiche: ") and printed.err.count("\n") == 1
    assert sentence in printed.err


def test_numbers_are_printed_before_a_picture_fails(files, capsys, monkeypatch):
    def fails(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("matplotlib.figure.Figure.savefig", fails)
    assert main(["fit", "case.toml", "data.csv", *WANTED, "--plot", "found.png"]) == 2
    printed = capsys.readouterr()
    assert printed.out.startswith("gamma = 0.100")
    assert printed.err.splitlines()[1] == "seiche: --plot found.png cannot be written: No space left on device"


def test_columns_may_be_parted_by_semicolons(files, tmp_path, capsys):
    t, data = files
    np.savetxt("two.csv", np.column_stack([t, data]), delimiter=" ; ", header="t, in s; q, in m", comments="")
    printed = []
    for name in ("two.csv", "two.txt"):
        assert main(["fit", "case.toml", name, *WANTED, "--quiet"]) == 0
        printed.append(capsys.readouterr().out)
    assert printed[0] == printed[1]


def test_a_run_that_fails_has_exit_code_1(files, tmp_path, capsys):
    (tmp_path / "case.toml").write_text(CASE.replace("k*q^2/2", "q^2/2 - k*q^3"))  # escapes to infinity
    assert main(["fit", "case.toml", "data.csv", "--parameter", "k=5"]) == 1
    assert "the run with the first guess does not reach the end of the data" in capsys.readouterr().err
    assert main(["plot"]) == 2 and "knows one command: fit" in capsys.readouterr().err
