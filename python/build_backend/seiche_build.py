"""The build backend of pyproject.toml (PEP 517): CMake builds, and what it installs goes into a wheel.

It stands on Python's standard library, so that `pip install .` needs no network. The build tree is build/wheel, or what
SEICHE_BUILD_DIR names. With the setting bundle=yes (make wheel) the shared libraries go into the wheel as well.
"""

import base64
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile

try:
    import tomllib
except ImportError:
    import tomli as tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
# The command `seiche`: the program inside the package, which draws with the interpreter that the package was installed for.
LAUNCHER = b"""#!python
import importlib.util
import os
import sys

package = importlib.util.find_spec("seiche").submodule_search_locations[0]
os.environ["PATH"] = os.path.dirname(sys.executable) + os.pathsep + os.environ.get("PATH", os.defpath)
os.execv(os.path.join(package, "bin", "seiche"), sys.argv)
"""


def version():
    return re.search(r"^ *VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(), re.MULTILINE)[1]


def _bundled(settings):
    return (settings or {}).get("bundle") == "yes"


def _metadata(bundled):
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    fields = [
        ("Metadata-Version", "2.1"),
        ("Name", project["name"]),
        ("Version", version()),
        ("Summary", project["description"]),
        ("License", project["license"]["text"] + ("; with the libraries inside GPL-3.0-or-later" if bundled else "")),
        ("Author", ", ".join(author["name"] for author in project["authors"])),
        ("Keywords", ",".join(project["keywords"])),
        ("Requires-Python", project["requires-python"]),
        *(("Classifier", classifier) for classifier in project["classifiers"]),
        *(("Requires-Dist", needed) for needed in project["dependencies"]),
    ]
    for extra, packages in project["optional-dependencies"].items():
        fields += [("Provides-Extra", extra), *(("Requires-Dist", f'{name}; extra == "{extra}"') for name in packages)]
    fields.append(("Description-Content-Type", "text/markdown"))
    return "".join(f"{name}: {value}\n" for name, value in fields) + "\n" + (ROOT / "README.md").read_text(encoding="utf-8")


def _say(text):
    """What takes so long, to who waits for it: pip shows what a backend prints only where it failed."""
    print(f"seiche: {text}", file=sys.stderr)
    try:
        with open("/dev/tty", "w") as terminal:
            terminal.write(f"\n  seiche: {text}\n")
    except OSError:
        pass  # there is no terminal


def _cmake(*arguments):
    # pip shows the build an environment of its own; CMake is to see this interpreter as it is.
    clean = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "PYTHONNOUSERSITE")}
    done = subprocess.run(["cmake", *map(str, arguments)], env=clean)
    if done.returncode:
        raise SystemExit("seiche: CMake failed, and says above why")


def _build(staging):
    if not shutil.which("cmake"):
        raise SystemExit("seiche: this compiles C++ with CMake, which is not here; scripts/install-deps --python installs what is needed")
    tree = pathlib.Path(os.environ.get("SEICHE_BUILD_DIR") or ROOT / "build" / "wheel")
    _say(f"compiles the library, the program and the Python package in {tree}; some minutes the first time")
    if not (tree / "CMakeCache.txt").exists():
        options = {
            "CMAKE_BUILD_TYPE": "Release",
            "SEICHE_BUILD_TESTS": "OFF",
            "SEICHE_PYTHON_REQUIRED": "ON",
            "Python_EXECUTABLE": sys.executable,
        }
        _cmake("-S", ROOT, "-B", tree, *(f"-D{key}={value}" for key, value in options.items()))
    _cmake("--build", tree, "--target", "seiche_python", "seiche_cli", "--parallel", os.cpu_count() or 1)
    _cmake("--install", tree, "--component", "python", "--prefix", staging, "--strip")


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    """Without it pip builds a wheel to read these lines, and then another one."""
    info = pathlib.Path(metadata_directory) / f"seiche-{version()}.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(_metadata(_bundled(config_settings)), encoding="utf-8")
    return info.name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    platform, info, data = re.sub("[-.]", "_", sysconfig.get_platform()), f"seiche-{version()}.dist-info", f"seiche-{version()}.data"
    with tempfile.TemporaryDirectory() as folder:
        staging = pathlib.Path(folder)
        _build(staging)
        if _bundled(config_settings):
            import bundle

            platform = bundle.bundle(staging, staging / "seiche.libs", staging / info / "licenses")
        files = {p.relative_to(staging).as_posix(): p.read_bytes() for p in sorted(staging.rglob("*")) if p.is_file()}
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    tag = f"{python}-{python}-{platform}"
    name = f"seiche-{version()}-{tag}.whl"
    files[f"{data}/scripts/seiche"] = LAUNCHER
    files[f"{info}/METADATA"] = _metadata(_bundled(config_settings)).encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: seiche\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    record = ""
    for path, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        record += f"{path},sha256={digest},{len(content)}\n"
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, content in files.items():
            entry = zipfile.ZipInfo(path)
            runs = content.startswith((b"\x7fELF", b"#!"))
            entry.external_attr = (0o100755 if runs else 0o100644) << 16  # pip heeds those of regular files
            entry.compress_type = zipfile.ZIP_DEFLATED
            wheel.writestr(entry, content)
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
        info.write_text(_metadata(bundled=False), encoding="utf-8")
        archive.add(info, f"{stem}/PKG-INFO")
    return f"{stem}.tar.gz"
