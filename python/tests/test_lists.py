"""What there is, and which Seiche computed: as the program says them."""

import json
import os
import subprocess
from pathlib import Path

import pytest
import seiche


def program():
    found = Path(os.environ.get("SEICHE_BUILD_DIR", "nowhere")) / "seiche"
    if not found.exists():
        pytest.skip("SEICHE_BUILD_DIR names no build tree (ctest does)")
    return found


@pytest.mark.parametrize("what", ["methods", "problems", "backends"])
def test_the_lists_are_those_of_the_program(what):
    done = subprocess.run([program(), "list", what, "--json"], capture_output=True, text=True, check=True)
    assert json.loads(done.stdout) == getattr(seiche, what)()


def test_the_lists_name_what_the_other_calls_take():
    methods = {m["name"]: m for m in seiche.methods()}
    assert methods["auto"]["order"] is None and methods["egc4"]["projection"]
    assert "custom" in {p["name"] for p in seiche.problems()}


def test_a_report_has_the_versions_of_summary_json(tmp_path):
    ours = seiche.solve("oscillator", 1.0, method="seisav", h=0.125).report
    assert {"hdf5", "compiler", "instruction_set", "fftw", "ginac", "sleef"} <= set(ours["versions"])
    (tmp_path / "case.toml").write_text('[problem]\nname = "oscillator"\n[method]\nname = "seisav"\nh = 0.125\n[time]\nend = 1\n')
    subprocess.run([program(), "run", "case.toml", "--quiet", "--out", "out"], cwd=tmp_path, check=True)
    theirs = json.loads((tmp_path / "out/summary.json").read_text())
    del theirs["sha256"]  # of files
    assert list(ours) == list(theirs)
    del theirs["versions"]["cli11"]  # which reads a command line
    assert ours["versions"] == theirs["versions"]
