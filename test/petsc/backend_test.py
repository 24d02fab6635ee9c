"""Cases on the backend "petsc", on one process and on several, are those on the backend "sparse".

    backend_test.py SEICHE MPIEXEC CASES

Exits with 77 where NumPy is missing.
"""

import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

try:
    import numpy as np
except ImportError:
    print("backend_test: skipped for want of numpy")
    sys.exit(77)

program, mpiexec, cases = sys.argv[1:]
os.chdir(tempfile.mkdtemp())


def command(processes, *words):
    return [*([mpiexec, "-n", str(processes)] if processes > 1 else []), program, *words]


def seiche(*words, processes=1, options="", code=0):
    environment = os.environ | {"PETSC_OPTIONS": options}
    done = subprocess.run(command(processes, *words), capture_output=True, text=True, env=environment, timeout=100)
    assert done.returncode == code, f"{words} on {processes}\n{done.stdout}{done.stderr}"
    return done.stdout + done.stderr


def run(case, folder, *overrides, **how):
    file = case if "/" in case else f"{cases}/{case}.toml"
    return seiche("run", file, "--quiet", "--out", folder, "--set", *overrides, **how)


def final(folder):
    return np.loadtxt(f"{folder}/final.txt")


def near(folder, expected, tolerance=1e-12):
    found = final(folder)
    assert found.shape == expected.shape, (folder, found.shape, expected.shape)
    miss = np.abs(found - expected).max() / np.abs(expected).max()
    assert miss < tolerance, f"{folder}: {miss}"


# Chains, graphs, trusses, files, differences on a line and a plane, waves through layers; V that adds up over points,
# and V that does not.
every = {
    "chain": [], "network": [], "truss": [], "sparse": [], "fput_load": [],
    "klein_gordon": ['problem.discretisation="fd4"'],
    "klein_gordon_2d": ['problem.discretisation="fd2"', "problem.points=[12,10]"],
    "wave": ["problem.points=[10,9]"],
}
for case, overrides in every.items():
    for method in ("seisav", "egc4", "etdrk4"):
        name = pathlib.Path(case).stem + method
        chosen = [f"method.name={method}", "time.end=0.5", *overrides]
        run(case, f"sparse_{name}", "backend.name=sparse", *chosen)
        expected = final(f"sparse_{name}")
        for processes in (1, 2, 3):
            if processes > 1 and method == "etdrk4" and case != "truss":
                continue
            folder = f"petsc_{name}_{processes}"
            run(case, folder, "backend.name=petsc", *chosen, processes=processes)
            near(folder, expected)
            summary = json.loads(pathlib.Path(folder, "summary.json").read_text())
            assert summary["backend"] == "petsc" and summary["energy"]["law"] != "violated", summary
        seiche("audit", folder)

# Rates and forces of the place, friction, S(z), bonds of formulas, and processes without a point.
beyond = {
    "sponge_layer": ('problem.discretisation="fd2"', "seisav", "egc4"), "dry_friction": ("", "seisav"),
    "van_der_pol": ("", "egc4"), "burgers": ('problem.discretisation="fd2"', "egc4"), "rigid_body": ("", "egc4"),
    "driven_duffing": ("", "seisav"), "klein_gordon_driven_damping": ('problem.discretisation="fd4"', "egc4"),
    "toda": ("", "seavf", "egc4"), "frenkel_kontorova": ("", "egc4"), "beta_fpu": ("", "seilm", "egc4"),
}
for case, (override, *chosen_methods) in beyond.items():
    for method in chosen_methods:
        chosen = [f"method.name={method}", "time.end=0.3", *filter(None, [override])]
        run(case, f"sparse_{case}{method}", "backend.name=sparse", *chosen)
        for processes in (1, 3):
            run(case, f"petsc_{case}{method}{processes}", "backend.name=petsc", *chosen, processes=processes)
            near(f"petsc_{case}{method}{processes}", final(f"sparse_{case}{method}"))

# Matrices from files that PETSc has written.
try:
    from petsc4py import PETSc
except ImportError:
    PETSc = None
if PETSc is not None:
    for name in ("M", "D"):
        with open(f"{cases}/beads_{name}.mtx") as file:
            lines = [line for line in file if not line.startswith("%")]
        rows, columns, _ = map(int, lines[0].split())
        matrix = PETSc.Mat().createAIJ((rows, columns))
        matrix.setUp()
        for line in lines[1:]:
            i, j, value = line.split()
            matrix[int(i) - 1, int(j) - 1] = matrix[int(j) - 1, int(i) - 1] = float(value)
        matrix.assemble()
        matrix.view(PETSc.Viewer().createBinary(f"{name}.bin", "w", comm=PETSc.COMM_SELF))
    run("sparse", "from_petsc", "time.end=0.5", *(f"problem.{name}={os.getcwd()}/{name}.bin" for name in ("M", "D")))
    run("sparse", "from_market", "time.end=0.5")
    assert (final("from_petsc") == final("from_market")).all()
else:
    print("backend_test: without matrices of PETSc, for want of petsc4py")

# The law by an iteration that ends early.
for case in ("chain", "network"):
    for processes in (1, 2):
        folder = f"early_{case}_{processes}"
        options = "-seiche_ksp_type gmres -seiche_pc_type bjacobi -seiche_ksp_rtol 1e-6"
        run(case, folder, "backend.name=petsc", "time.end=2", processes=processes, options=options)
        rows = np.genfromtxt(f"{folder}/energy.csv", delimiter=",", names=True)
        kept = rows["H_modified"] if "H_modified" in rows.dtype.names else rows["H"]
        assert np.diff(kept).max() <= 1e-14 * kept[0], folder



def solved(case, folder, options, *overrides, **how):
    """The summary, and what a linear solve took."""
    solver = f'backend.solver="{options}"'
    run(case, folder, "backend.name=petsc", solver, "backend.pade_degree=4", *overrides, **how)
    summary = json.loads(pathlib.Path(folder, "summary.json").read_text())
    return summary, summary["solver"]["iterations"] / (4 * summary["steps"])  # z and ∇V, two pairs of poles each


# PRESB: iterations that hardly grow with h, by any preconditioner of the real system inside, odd degrees too.
wave = ["problem.points=[63,63]", "method.name=seisav", "time.end=0.5"]
for h, most in (("1/64", 24), ("1/2", 48)):
    run("wave", f"wave_{h[2:]}", *wave, f"method.h={h}", "backend.name=sparse", "backend.pade_degree=4")
    for inside in ("", "-presb_fieldsplit_v_pc_type ilu", "-presb_pc_type lu"):
        processes = (1, 2) if inside == "" else (1,)
        for count in processes:
            folder = f"presb_{h[2:]}_{len(inside)}_{count}"
            options = f"-ksp_type gmres -ksp_rtol 1e-11 -presb {inside}"
            summary, iterations = solved("wave", folder, options, *wave, f"method.h={h}", processes=count)
            near(folder, final(f"wave_{h[2:]}"), 1e-8)
            assert inside.endswith("ilu") or iterations < most, (h, inside, iterations)
            assert summary["energy"]["law"] == "holds", summary
_, by_jacobi = solved("wave", "jacobi", "-ksp_type gmres -ksp_rtol 1e-11 -pc_type jacobi", *wave, "method.h=1/2")
assert by_jacobi > 5 * iterations, (by_jacobi, iterations)
run("chain", "odd", "backend.name=petsc", "backend.pade_degree=3", 'backend.solver="-presb -ksp_rtol 1e-12"', "time.end=1")
run("chain", "odd_sparse", "backend.name=sparse", "backend.pade_degree=3", "time.end=1")
near("odd", final("odd_sparse"), 1e-9)

# Processes without a point, which take part in every solver; options of the solvers inside, found before a run begins.
for case, points, processes in (("duffing", [], 3), ("chain", ["problem.points=6"], 4)):
    run(case, f"few_{case}", "backend.name=sparse", "time.end=0.3", *points)
    solver = 'backend.solver="-presb -ksp_rtol 1e-12"'
    run(case, f"few_{case}_{processes}", "backend.name=petsc", solver, "time.end=0.3", *points, processes=processes)
    near(f"few_{case}_{processes}", final(f"few_{case}"), 1e-9)
for options in ("-presb -presb_fieldsplit_v_pc_type lu", "-pc_type bjacobi -sub_pc_type gamg -sub_mg_levels_ksp_max_it 1"):
    run("chain", "inside", "backend.name=petsc", f'backend.solver="{options} -ksp_rtol 1e-10"', "time.end=0.3")

# What the solver has to do with the law: restored, and promised; or not, and said.
early = "-ksp_type gmres -pc_type jacobi -ksp_rtol 1e-4"
for method, promised in (("seisav", True), ("seilm", True), ("seavf", False)):
    chosen = [f"method.name={method}", "time.end=2", "output.ledger=on", "output.energy_every=1"]
    summary, _ = solved("chain", f"share_{method}", early, *chosen)
    rows = np.genfromtxt(f"share_{method}/energy.csv", delimiter=",", names=True)
    missed = np.abs(rows["substep"] + rows["scalar"]).max()  # S is skew: what the solver takes or gives
    assert missed < 1e-14 or not promised, (method, missed)
    assert np.abs(rows["round_off"]).max() < 1e-14, method
    assert summary["solver"]["restored"] > 1e-9, summary
    certificate = summary["certificate"]
    assert certificate["law"]["promised"] == promised and (summary["energy"]["law"] == "holds") == promised, summary
    grade = [found["grade"] for found in certificate["hypotheses"] if found["hypothesis"].startswith("F + F")]
    assert grade == ["verified with margin" if promised else "violated"], certificate
    seiche("audit", f"share_{method}")
run("chain", "factors", "backend.name=petsc", "time.end=1")
assert "solver" not in json.loads(pathlib.Path("factors/summary.json").read_text())

# Block Lanczos iteration: S, M and the solver of M are all it takes, whose tolerance is no matter for the law.
lanczos = ["backend.exponential=lanczos", "time.end=0.5"]
small = {"wave": ["problem.points=[24,23]"], "chain": []}
for case, points in small.items():
    for method in ("seisav", "seilm", "seavf"):
        chosen = [f"method.name={method}", *lanczos, *points]
        run(case, f"lanczos_{case}{method}", "backend.name=sparse", *chosen)
        for processes in (1, 3):
            folder = f"lanczos_{case}{method}{processes}"
            run(case, folder, "backend.name=petsc", *chosen, processes=processes)
            near(folder, final(f"lanczos_{case}{method}"))
for method in ("seisav", "seilm"):
    for dimension in (0, 4):
        folder = f"lanczos_early_{method}{dimension}"
        solver = 'backend.solver="-ksp_type cg -pc_type jacobi -ksp_rtol 1e-4"'
        chosen = [*lanczos, *small["wave"], f"method.name={method}", f"backend.lanczos_dimension={dimension}"]
        ledger = ["output.ledger=on", "output.energy_every=1"]
        run("wave", folder, "backend.name=petsc", solver, *chosen, *ledger, processes=2)
        rows = np.genfromtxt(f"{folder}/energy.csv", delimiter=",", names=True)
        missed = np.abs(rows["substep"] + rows["scalar"]).max() / rows["H"][0]
        summary = json.loads(pathlib.Path(folder, "summary.json").read_text())
        assert missed < 1e-14 and summary["energy"]["law"] == "holds", (folder, missed)
        assert summary["solver"]["iterations"] > 1000 and summary["certificate"]["law"]["promised"], summary
        miss = np.abs(final(folder) - final("lanczos_waveseisav")).max()
        assert 1e-9 < miss < 1e-3 or dimension == 4 and method == "seisav", (folder, miss)

# Stopped on three, resumed on two.
long = ["backend.name=petsc", "time.end=100", "output.snapshot_every=64",
        'backend.solver="-ksp_type gmres -pc_type jacobi -ksp_rtol 1e-13"']
run("network", "whole", *long)
words = command(3, "run", f"{cases}/network.toml", "--quiet", "--out", "stopped", "--set", *long)
environment = dict(os.environ)  # without what MPI has set beside it for petsc4py
process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=environment)
while process.poll() is None and not list(pathlib.Path("stopped").glob("*")):
    time.sleep(0.05)
time.sleep(2.0)
process.send_signal(signal.SIGTERM)
process.wait(60)
assert list(pathlib.Path("stopped").glob("checkpoint*")), os.listdir("stopped")
seiche("resume", "stopped", processes=2)
near("stopped", final("whole"), 1e-8)
taken = [json.loads(pathlib.Path(f, "summary.json").read_text())["solver"]["iterations"] for f in ("whole", "stopped")]
assert abs(taken[1] - taken[0]) < 0.1 * taken[0], taken

refused = {
    "depends on the place, and has to be made for the points of one process": (
        "dry_friction", ['problem.friction={ kind="formula", r="(1+0.5*sin(x))*v" }'], 2),
    "needs a skew S": ("chain", ["method.name=sav", *lanczos], 2),  # with the damping merged into it
    "needs M positive definite, but there is a direction z with zᵀMz ≤ 0": (
        "wave", ['problem.boundary="periodic"', *lanczos], 2),
    "the backends modal and petsc run on several processes": ("chain", ["backend.name=sparse"], 2),
    'use discretisation "fd2" or "fd4"': ("klein_gordon_2d", [], 2),
    'is for the backend petsc, and this is sparse': (
        "chain", ["backend.name=sparse", 'backend.solver="-ksp_type cg"'], 1),
}
for sentence, (case, overrides, processes) in refused.items():
    said = run(case, "refused", "backend.name=petsc", "time.end=0.1", *overrides, processes=processes, code=2)
    assert sentence in said, said
ensemble = ["backend.name=petsc", 'problem.discretisation="fd2"', "ensemble.members=20", "time.end=0.1"]
file = f"{cases}/klein_gordon_ensemble.toml"
said = seiche("run", file, "--threads", "2", "--out", "refused", "--set", *ensemble, code=2)
assert "the backend petsc is for one thread of a program" in said, said
seiche("run", file, "--quiet", "--threads", "1", "--out", "members", "--set", *ensemble)
for options, sentence in {
    "-ksp_typ gmres": "no linear solver here looks for the option -ksp_typ of backend.solver",
    "-ksp_type gmres -pc_typ ilu": "no linear solver here looks for the option -pc_typ of backend.solver",
    "ksp_type gmres": "must be a list of options of PETSc",
    "-presb -pc_type lu": "two preconditioners",
    "-options_file missing.txt": "Unable to open options file",
}.items():
    said = run("chain", "options", "backend.name=petsc", f'backend.solver="{options}"', code=2)
    assert sentence in said and not os.path.exists("options"), said
said = run("chain", "refused", "backend.name=petsc", options="-seiche_ksp_type nonsense", code=2)
assert "PETSc could not go on: " in said and "nonsense" in said, said
print("backend_test: all is as it should be")
