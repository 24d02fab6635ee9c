"""The build backend of pyproject.toml (PEP 517): CMake builds, and what it installs goes into a wheel.

It stands on Python's standard library alone, so that `pip install .` needs no network. The build tree is build/wheel, or
what SEICHE_BUILD_DIR names.
"""

import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
METADATA = """Metadata-Version: 2.1
Name: seiche
Version: {version}
Summary: Energy-stable integrators for damped Hamiltonian systems
License: BSD-3-Clause
Requires-Python: >=3.9
Requires-Dist: numpy
Provides-Extra: plot
Requires-Dist: matplotlib; extra == "plot"
Provides-Extra: xarray
Requires-Dist: xarray; extra == "xarray"
Provides-Extra: test
Requires-Dist: pytest; extra == "test"
Requires-Dist: scipy; extra == "test"
Requires-Dist: matplotlib; extra == "test"
Requires-Dist: h5py; extra == "test"
Requires-Dist: xarray; extra == "test"
Description-Content-Type: text/markdown

{readme}"""


def version():
    return re.search(r"^ *VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(), re.MULTILINE)[1]


def _metadata():
    return METADATA.format(version=version(), readme=(ROOT / "README.md").read_text(encoding="utf-8"))


def _cmake(*arguments):
    # pip shows the build an environment of its own; CMake is to see this interpreter as it is.
    clean = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "PYTHONNOUSERSITE")}
    subprocess.run(["cmake", *map(str, arguments)], check=True, env=clean)


def _build(staging):
    tree = pathlib.Path(os.environ.get("SEICHE_BUILD_DIR") or ROOT / "build" / "wheel")
    if not (tree / "CMakeCache.txt").exists():
        options = {
            "CMAKE_BUILD_TYPE": "Release",
            "SEICHE_BUILD_PROGRAM": "OFF",
            "SEICHE_BUILD_TESTS": "OFF",
            "SEICHE_PYTHON_REQUIRED": "ON",
            "Python_EXECUTABLE": sys.executable,
        }
        _cmake("-S", ROOT, "-B", tree, *(f"-D{key}={value}" for key, value in options.items()))
    _cmake("--build", tree, "--target", "seiche_python", "--parallel", os.cpu_count() or 1)
    _cmake("--install", tree, "--component", "python", "--prefix", staging)


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    tag = f"{python}-{python}-{re.sub('[-.]', '_', sysconfig.get_platform())}"
    info = f"seiche-{version()}.dist-info"
    name = f"seiche-{version()}-{tag}.whl"
    with tempfile.TemporaryDirectory() as folder:
        staging = pathlib.Path(folder)
        _build(staging)
        files = {p.relative_to(staging).as_posix(): p.read_bytes() for p in sorted(staging.rglob("*")) if p.is_file()}
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: seiche\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    record = ""
    for path, data in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        record += f"{path},sha256={digest},{len(data)}\n"
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, data in files.items():
            entry = zipfile.ZipInfo(path)
            entry.external_attr = (0o755 if path.endswith(".so") else 0o644) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(entry, data)
    return name


def build_sdist(sdist_directory, config_settings=None):
    stem = f"seiche-{version()}"
    with tempfile.TemporaryDirectory() as folder, tarfile.open(
        pathlib.Path(sdist_directory) / f"{stem}.tar.gz", "w:gz", format=tarfile.PAX_FORMAT
    ) as archive:
        listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
        for path in filter(None, listed.split("\0")):
            archive.add(ROOT / path, f"{stem}/{path}", recursive=False)
        info = pathlib.Path(folder) / "PKG-INFO"
        info.write_text(_metadata(), encoding="utf-8")
        archive.add(info, f"{stem}/PKG-INFO")
    return f"{stem}.tar.gz"
