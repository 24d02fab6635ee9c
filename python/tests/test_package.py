"""What is installed: the wheel is whole, and the stubs speak of what there is."""

import ast
import base64
import csv
import email
import hashlib
import importlib
import inspect
import io
import os
import pathlib
import subprocess
import sys
import zipfile

import pytest
import seiche

PYTHON = pathlib.Path(__file__).resolve().parents[1]


@pytest.mark.skipif("SEICHE_BUILD_DIR" not in os.environ, reason="SEICHE_BUILD_DIR names no build tree (ctest does)")
def test_a_wheel_is_whole_and_can_be_imported(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(PYTHON / "build_backend"))
    name = importlib.import_module("seiche_build").build_wheel(tmp_path)
    with zipfile.ZipFile(tmp_path / name) as wheel:
        names = set(wheel.namelist())
        info = f"seiche-{seiche.__version__}.dist-info"
        record = list(csv.reader(io.StringIO(wheel.read(f"{info}/RECORD").decode())))
        assert {row[0] for row in record} == names
        for path, digest, size in record:
            if digest:
                data = wheel.read(path)
                sha = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
                assert digest == f"sha256={sha}" and int(size) == len(data)
        assert {"seiche/__init__.py", "seiche/_core.pyi", "seiche/py.typed", "seiche/plot.py", "seiche/bin/seiche"} <= names
        assert f"seiche-{seiche.__version__}.data/scripts/seiche" in names
        metadata = email.message_from_bytes(wheel.read(f"{info}/METADATA"))
        assert (metadata["Name"], metadata["Version"]) == ("seiche", seiche.__version__)
        assert "numpy" in metadata.get_all("Requires-Dist") and 'h5py; extra == "plot"' in metadata.get_all("Requires-Dist")
        wheel.extractall(tmp_path / "unpacked")
    program = "import seiche; print(seiche.__file__, seiche.solve('oscillator', 1.0, h=0.1).status == 'success')"
    done = subprocess.run(
        [sys.executable, "-c", program],
        cwd=tmp_path,  # the folder that Python starts in comes first on its path
        env={**os.environ, "PYTHONPATH": str(tmp_path / "unpacked")},
        capture_output=True,
        text=True,
    )
    assert done.stdout.split() == [str(tmp_path / "unpacked/seiche/__init__.py"), "True"], done.stderr


def test_the_stub_of_the_compiled_part_names_what_there_is():
    from seiche import _core

    tree = ast.parse((PYTHON / "seiche" / "_core.pyi").read_text())
    stated = {n.name: n for n in tree.body if isinstance(n, (ast.ClassDef, ast.FunctionDef))}
    assert set(stated) == {name for name in vars(_core) if not name.startswith("__")}
    for name, node in stated.items():
        if isinstance(node, ast.ClassDef):
            members = {n.name for n in node.body if isinstance(n, ast.FunctionDef) and n.name != "__init__"}
            members |= {n.target.id for n in node.body if isinstance(n, ast.AnnAssign)}
            assert members == {m for m in vars(getattr(_core, name)) if not m.startswith("_")}


def test_everything_public_is_documented():
    for name in seiche.__all__:
        if name != "__version__":
            assert inspect.getdoc(getattr(seiche, name)), name
    for name in seiche.plot.__all__:
        assert inspect.getdoc(getattr(seiche.plot, name)), name
