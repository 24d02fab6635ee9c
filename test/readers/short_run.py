"""Short runs of case files, for the checks beside this file, which are called as CHECK.py SEICHE CASES FOLDER."""
import pathlib
import shutil
import subprocess
import sys

program, cases, folder = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
shutil.rmtree(folder, ignore_errors=True)


def run(case, *overrides):
    out = folder / case
    settings = ["time.end=0.5", "method.h=1/32", "output.snapshot_every=4", *overrides]
    subprocess.run([program, "run", cases / f"{case}.toml", "--quiet", "--out", out, "--set", *settings], check=True)
    return out


def check(condition, what):
    if not condition:
        sys.exit(f"failed: {what}")
