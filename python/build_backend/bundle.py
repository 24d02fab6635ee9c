"""Puts the shared libraries that a wheel needs into it, as auditwheel does, with ldd and patchelf."""

import hashlib
import os
import platform
import re
import shutil
import subprocess

# What every system has: the C library by the version in the name of the wheel, and the compiler's run time.
SYSTEM = re.compile(r"(ld-linux.*|lib(c|m|dl|rt|pthread|resolv|util|anl|stdc\+\+|gcc_s))\.so")
# The oldest C library of a distribution whose libstdc++ has GLIBCXX_3.4.N: Ubuntu 21.10, 22.04, 24.04, Debian 13.
LIBSTDCXX = {29: 34, 30: 35, 32: 39, 33: 41}


def _printed(*command):
    done = subprocess.run(list(map(str, command)), stdout=subprocess.PIPE, text=True)
    if done.returncode:
        raise SystemExit(f"seiche: {' '.join(map(str, command))} failed")
    return done.stdout


def _newest(name, files):
    return max(int(n) for file in files for n in re.findall(name + rb"(\d+)", file.read_bytes()) or [0])


def bundle(staging, libraries, licences):
    """Copies them and their licences into the folders, and returns the platform for the wheel's name."""
    for tool in ("ldd", "patchelf", "dpkg"):  # dpkg knows whose file a library is, and so its licence
        if not shutil.which(tool):
            raise SystemExit(f"seiche: a wheel with its libraries inside needs {tool}; scripts/install-deps --package installs it")
    ours = [path for path in staging.rglob("*") if path.is_file() and path.read_bytes()[:4] == b"\x7fELF"]
    found = {}
    for path in ours:
        for line in _printed("ldd", path).splitlines():
            name, _, place = line.strip().partition(" => ")
            if place == "not found":
                raise SystemExit(f"seiche: {path.name} needs {name}, which is not found")
            if place and not SYSTEM.match(name):
                found[name] = os.path.realpath(place.split(" (")[0])
    libraries.mkdir()
    licences.mkdir(parents=True)
    new = {}
    for name, place in found.items():
        # A name that no other library has: what an interpreter has loaded under the old one may be another version.
        with open(place, "rb") as file:
            digest = hashlib.sha256(file.read()).hexdigest()[:8]
        new[name] = name.replace(".so", f"-{digest}.so", 1)
        shutil.copyfile(place, libraries / new[name])
        package = _printed("dpkg", "-S", f"*/{os.path.basename(place)}").split(":")[0]
        shutil.copyfile(f"/usr/share/doc/{package}/copyright", licences / f"{package}.txt")
    everything = ours + [libraries / name for name in new.values()]
    for path in everything:
        _printed("patchelf", "--set-rpath", os.path.join("$ORIGIN", os.path.relpath(libraries, path.parent)), path)
        if path not in ours:
            _printed("patchelf", "--set-soname", path.name, path)
        for needed in sorted(set(_printed("patchelf", "--print-needed", path).split()) & set(new)):
            # One at a time: patchelf 0.14 mistakes the libraries of the symbols' versions where it renames several.
            _printed("patchelf", "--replace-needed", needed, new[needed], path)
    runtime = _newest(rb"GLIBCXX_3\.4\.", everything)
    here = int(platform.libc_ver()[1].split(".")[1])
    glibc = max(_newest(rb"GLIBC_2\.", everything), min((g for n, g in LIBSTDCXX.items() if n >= runtime), default=here))
    return f"manylinux_2_{glibc}_{platform.machine()}"
