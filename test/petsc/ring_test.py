"""The examples in C and Python print the same solution, whatever the method, and that of PETSc's own steppers.

    ring_test.py libseiche_ts.so RING ring.py

Exits with 77 where petsc4py is missing.
"""

import re
import subprocess
import sys

library, ring, script = sys.argv[1:]
if subprocess.run([sys.executable, "-c", "import petsc4py"], capture_output=True).returncode != 0:
    print("ring_test: skipped for want of petsc4py")
    sys.exit(77)


def run(program, *options):
    command = [*program, "-dll_append", library, *options]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, f"{' '.join(command)}\n{done.stdout}{done.stderr}"
    return done.stdout


def numbers(text):
    line = re.search(r"H/dx from (\S+) to (\S+), \|u\| = (\S+)", text)
    return [float(number) for number in line.groups()]


def near(found, expected, tolerance, what):
    miss = max(abs(a - b) for a, b in zip(found, expected))
    assert miss <= tolerance, f"{what}: {found} and {expected}"


in_c, in_python = [ring], [sys.executable, script]
reference = numbers(run(in_c, "-ts_type", "egc8", "-ts_dt", "0.02"))
# C states friction by S and V by F − ½uᵀMu; Python by D and V. Schemes that split D off are others then.
for method, tolerance in (("egc4", 1e-8), ("crkn6", 1e-9), ("egc6", 1e-9), ("seisav", 3e-4), ("seilm", 3e-4)):
    for program in (in_c, in_python):
        near(numbers(run(program, "-ts_type", method)), reference, tolerance, f"{program[-1]} {method}")

# A stepper of PETSc's own, which knows nothing of ours.
cells = ("-n", "8", "-ts_dt", "0.1", "-ts_max_time", "1")
own = numbers(run(in_c, "-ts_type", "discgrad", "-ts_discgrad_gonzalez", *cells))
near(numbers(run(in_c, "-ts_type", "egc6", *cells)), own, 5e-2, "discgrad")

# By PETSc's solvers: the same solution by factors, and the law to round-off also where an iteration ends early.
for method in ("seisav", "sav", "ssav"):
    near(numbers(run(in_c, "-ts_type", method, "-ts_seiche_ksp")), numbers(run(in_c, "-ts_type", method)), 1e-10, method)
early = ("-ts_seiche_ksp", "-seiche_ksp_type", "gmres", "-seiche_pc_type", "bjacobi", "-seiche_ksp_rtol", "1e-8")
for method, how in (
    *((method, early) for method in ("seisav", "seilm", "seidm", "seavf")),
    *((method, (*early[:-1], "1e-3")) for method in ("seisav", "seilm", "seidm")),
    ("seisav", ("-ts_seiche_ksp", "-seiche_pc_type", "jacobi")),  # which goes with GMRES
    ("seisav", ("-ts_seiche_ksp", "-seiche_presb", "-seiche_ksp_rtol", "1e-8")),
    *((method, (*early[:-1], "1e-3", "-ts_seiche_exponential", "lanczos")) for method in ("seilm", "seidm", "seavf")),
    ("seisav", (*early[:-1], "1e-3", "-ts_seiche_exponential", "lanczos")),
):
    view = run(in_c, "-ts_type", method, "-gamma", "0", "-ts_dt", "0.1", "-ts_view", *how)
    kept = float(re.search(r"H = \S+, \S+ = (\S+)", view).group(1))
    assert abs(kept - 9.41479406902969) < 50 * 2.2e-16 * 9.5 * 2, f"{method}: {kept}"
    assert ("the contract of propagators restored by" in view) == ("lanczos" not in how or method != "seisav"), view
    assert ("energy law promised" in view) == (method != "seavf"), view
stuck = [ring, "-dll_append", library, "-ts_type", "seisav", *early, "-seiche_ksp_max_it", "1"]
assert "the linear solver of the options -seiche_ksp_… stopped after 1 iterations" in subprocess.run(
    stuck, capture_output=True, text=True
).stderr

# What is printed of every step: the energy that seisav keeps never rises.
lines = [line.split() for line in run(in_c, "-ts_type", "seisav", "-ts_seiche_monitor").splitlines() if " TS time " in line]
assert len(lines) == 401, len(lines)
kept = [float(line[-1]) for line in lines]
assert all(b <= a + 1e-12 for a, b in zip(kept, kept[1:])), "H_modified rises"

view = run(in_c, "-ts_type", "egc4", "-ts_view")
for part in ("type: egc4", "order 4, exponential propagator, keeps the energy law of H", "energy law promised"):
    assert part in view, view
# A type that PETSc does not know is PETSc's to refuse.
wrong = subprocess.run([ring, "-dll_append", library, "-ts_type", "seisaw"], capture_output=True, text=True)
assert wrong.returncode != 0 and "seisaw" in wrong.stderr, wrong.stderr
print("ring_test: all is as it should be")
