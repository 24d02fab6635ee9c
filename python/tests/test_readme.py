"""The Python that the README shows runs as printed."""

import pathlib
import re

import pytest

README = pathlib.Path(__file__).resolve().parents[2] / "README.md"
BLOCKS = re.findall(r"^```python\n(.*?)^```$", README.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("block", BLOCKS)
def test_block_runs_and_prints_what_it_says(block, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    exec(compile(block, "README.md", "exec"), {"__name__": "__main__"})
    printed = capsys.readouterr().out
    for claim in re.findall(r"^print\(.*\) +# (.*)$", block, re.MULTILINE):
        assert re.search(".*".join(map(re.escape, claim.split("…"))), printed), (claim, printed)


def test_there_is_one():
    assert BLOCKS
