"""Problems by parts: the user's matrices and functions, against SciPy."""

import gc
import resource
import threading
import time

import numpy as np
import pytest
import scipy.integrate
import scipy.sparse
import seiche

N = 6


def pendulums(**changes):
    """A chain of damped pendulums: u'' = −Ku − sin(u) − Dv."""
    K = scipy.sparse.diags([-1.0, 2.0, -1.0], [-1, 0, 1], shape=(N, N))
    parts = {
        "M": scipy.sparse.block_diag([K, scipy.sparse.identity(N)]),
        "D": scipy.sparse.block_diag([0 * K, 0.1 * scipy.sparse.identity(N)]),
        "V": lambda u: np.sum(1 - np.cos(u)),
        "gradient": np.sin,
        "z0": np.concatenate([np.linspace(0.5, 2, N), np.zeros(N)]),
    }
    return seiche.Problem(**(parts | changes))


def right_hand_side(t, z):
    u, v = z[:N], z[N:]
    force = 2 * u + np.sin(u)
    force[1:] -= u[:-1]
    force[:-1] -= u[1:]
    return np.concatenate([v, -force - 0.1 * v])


@pytest.fixture(scope="module")
def exact():
    z0 = np.concatenate([np.linspace(0.5, 2, N), np.zeros(N)])
    return scipy.integrate.solve_ivp(right_hand_side, (0, 10), z0, "DOP853", rtol=1e-12, atol=1e-14, dense_output=True)


def test_high_order_agrees_with_dop853(exact):
    for method in ("egc6", "egc8", "crkn6"):
        r = seiche.solve(pendulums(), 10.0, method=method, tolerance=1e-10, dense_output=True)
        assert r.success and r.law == "holds", r.message
        t = np.linspace(0, 10, 57)
        assert np.abs(r.sol(t) - exact.sol(t)).max() < 1e-9
        assert np.all(np.diff(r.energy) <= 1e-12)


@pytest.mark.parametrize("method", [m["name"] for m in seiche.methods()])
def test_every_method_takes_own_functions(method, exact):
    errors = []
    for h in (1 / 32, 1 / 64):
        r = seiche.solve(pendulums(), 2.0, method=method, h=h)
        assert r.success and r.law == "holds", r.message
        errors.append(np.abs(r.y[:, -1] - exact.sol(2.0)).max())
    assert errors[1] < 2e-3 and (errors[1] < errors[0] / 3 or errors[1] < 1e-10)


@pytest.mark.parametrize(
    ("formula", "V", "gradient"),
    [
        ("1 - cos(u)", lambda u: np.sum(1 - np.cos(u)), np.sin),
        ("u^4/4 - u^2/8", lambda u: np.sum(u**4 / 4 - u**2 / 8), lambda u: u**3 - u / 4),
    ],
)
def test_a_formula_is_the_same_as_its_functions(formula, V, gradient):
    by_formula = pendulums(V=formula, gradient=None)
    by_functions = pendulums(V=V, gradient=gradient)
    for method in ("seavf", "seisav", "seilm", "egc4"):
        a, b = (seiche.solve(p, 2.0, method=method, h=1 / 32) for p in (by_formula, by_functions))
        assert a.law == b.law == "holds" and np.abs(a.y - b.y).max() < 1e-10


def test_problems_by_formulas():
    duffing = seiche.Problem(
        fields=["q", "p"], H="p^2/2 + q^2/2 + alpha/4*q^4", D={"p": 0.1}, parameters={"alpha": 1.0}, initial={"q": 1, "p": 0}
    )
    named = seiche.problem("oscillator", omega_squared=1.0, alpha=1.0, gamma=0.1)
    a, b = (seiche.solve(p, 5.0, method="egc4", h=1 / 32) for p in (duffing, named))
    assert a.law == "holds" and np.abs(a.y - b.y).max() < 1e-12
    wave = seiche.Problem(
        H="v^2/2 + 0.02*u_x^2 + 0.1*u^2 + u^4/4", D={"v": "0.1 + 0.05*sin(t)"}, points=16, length=2.0, initial={"u": "sin(pi*x)", "v": 0}
    )
    named = seiche.problem(
        "klein_gordon", points=16, length=2.0, kappa=0.04, omega_squared=0.2, alpha=1.0, gamma="0.1 + 0.05*sin(t)",
        initial={"u": "sin(pi*x)", "v": "0"},
    )
    a, b = (seiche.solve(p, 2.0, h=1 / 32) for p in (wave, named))
    assert a.field("u").shape == (65, 16) and np.abs(a.y - b.y).max() < 1e-11
    with pytest.raises(ValueError, match="unknown name"):
        seiche.Problem(fields=["q", "p"], H="p^2/2 + w3^2", initial={"q": 1, "p": 0})
    with pytest.raises(ValueError, match="gradient belongs to a problem by parts"):
        seiche.Problem(H="p^2/2 + q^4", gradient=np.sin)
    with pytest.raises(ValueError, match="needs M, or H"):
        seiche.Problem(z0=[1, 0])


def test_full_and_sparse_matrices_are_the_same():
    M = pendulums()
    sparse = seiche.solve(M, 1.0, h=1 / 32)
    K = 2 * np.eye(N) - np.eye(N, k=1) - np.eye(N, k=-1)
    zero = np.zeros((N, N))
    full = pendulums(
        M=np.block([[K, zero], [zero, np.eye(N)]]),
        D=np.block([[zero, zero], [zero, 0.1 * np.eye(N)]]),
        S=np.block([[zero, np.eye(N)], [-np.eye(N), zero]]),
    )
    assert np.array_equal(seiche.solve(full, 1.0, h=1 / 32).y, sparse.y)


def test_a_rate_by_formula_and_one_field():
    rotor = seiche.Problem(  # q' = p, p' = −q³ − γ(t)p, with V of all of z
        M=np.zeros((2, 2)),
        S=[[0, 1], [-1, 0]],
        fields=1,
        V=lambda z: z[0] ** 4 / 4 + z[1] ** 2 / 2,
        gradient=lambda z: np.array([z[0] ** 3, z[1]]),
        z0=[1.0, 0.0],
    )
    r = seiche.solve(rotor, 5.0, method="egc6", tolerance=1e-9)
    ref = scipy.integrate.solve_ivp(lambda t, z: [z[1], -z[0] ** 3], (0, 5), [1, 0], "DOP853", rtol=1e-12, atol=1e-14)
    assert np.abs(r.y[:, -1] - ref.y[:, -1]).max() < 1e-8
    damped = pendulums(D=None, gamma="0.1 + 0.05*sin(t)")
    assert seiche.solve(damped, 5.0, h=1 / 32).law == "holds"


def test_exceptions_of_functions_come_out():
    class Mine(Exception):
        pass

    calls = 0

    def gradient(u):
        nonlocal calls
        calls += 1
        if calls > 50:
            raise Mine("enough")
        return np.sin(u)

    with pytest.raises(Mine, match="enough"):
        seiche.solve(pendulums(gradient=gradient), 10.0, h=0.01)

    def event(t, y):
        raise Mine("event")

    with pytest.raises(Mine, match="event"):
        seiche.solve(pendulums(), 10.0, h=0.01, events=event)

    def observer(t, y, energy):
        raise Mine("observer")

    with pytest.raises(Mine, match="observer"):
        seiche.solve(pendulums(), 10.0, method="egc4", tolerance=1e-6, observer=observer)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"gradient": None}, "V and gradient come together"),
        ({"V": "1 - cos(u)"}, "leave gradient out"),
        ({"V": "1 - cos(q)", "gradient": None}, "V: .*unknown name 'q'"),
        ({"gradient": np.cos}, "the gradient is not that of V"),
        ({"gradient": lambda u: np.sin(u) * (np.arange(N) != 2)}, r"its component 2 \(from 0\) is 0, and differences of V"),
        ({"z0": None, "gradient": lambda u: u}, "at a random state of the size 1, its component 0"),
        ({"gradient": lambda u: u[:2]}, "gradient returned 2 numbers, but 6 are needed"),
        ({"gradient": lambda u: u * (1 + 0j)}, "gradient returned complex numbers; it must return real ones"),
        ({"M": np.eye(6) * (1 + 1j)}, "M is complex; it must be real"),
        ({"z0": np.zeros(3)}, "z0 has 3 entries, but M is 12 × 12"),
        ({"M": np.ones((2, 3))}, "^M is 2 × 3 and must be square$"),
        ({"gamma": "0.1 + sin(q)"}, "^gamma: formula, column 11: unknown name 'q'. Allowed: t, pi"),
    ],
)
def test_mistakes_are_value_errors(changes, sentence):
    with pytest.raises(ValueError, match=sentence):
        pendulums(**changes)


def test_a_structure_that_feeds_is_solved_and_promised_nothing():
    J = np.block([[np.zeros((N, N)), np.eye(N)], [-np.eye(N), np.zeros((N, N))]])
    S = J + 0.2 * np.eye(2 * N)
    K = np.diag(2.0 * np.ones(N)) - np.diag(np.ones(N - 1), 1) - np.diag(np.ones(N - 1), -1)

    def right_hand_side(t, z):
        return S @ np.concatenate([K @ z[:N] + np.sin(z[:N]), z[N:]])

    fed = pendulums(S=S, D=None)
    exact = scipy.integrate.solve_ivp(right_hand_side, (0, 1), fed.z0, "DOP853", rtol=1e-12, atol=1e-13)
    for method in ("egc6", "seisav"):
        r = seiche.solve(fed, 1.0, method=method, h=1 / 512)
        assert r.success and np.abs(r.y[:, -1] - exact.y[:, -1]).max() < 2e-5
        assert "sym(S) is not negative semidefinite" in r.message, r.message
        assert r.energy[-1] > r.energy[0]


def test_a_function_that_does_not_return_a_number_is_a_type_error():
    with pytest.raises(TypeError, match="V must return a number, but it returned <class 'str'>"):
        pendulums(V=lambda u: "x")


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda p: seiche.solve(p, 1.0), "give a step size h, or a tolerance"),
        (lambda p: seiche.solve(p, 1.0, h=0.1, method="seisv"), "unknown method 'seisv'; did you mean 'seisav'"),
        (lambda p: seiche.solve(p, 1.0, h=-1), "^h = -1 must be > 0"),
        (lambda p: seiche.solve(p, (1.0, 0.0), h=0.1), "must ascend"),
        (lambda p: seiche.solve(p, 1.0, np.zeros(5), h=0.1), "z0 has 5 entries, but the state of the problem has 12"),
        (lambda p: seiche.solve(p, 1.0, h=0.1, t_eval=[0.5, 3.0]), "t_eval holds 3"),
        (lambda p: seiche.solve(p, 1.0, h=0.1, nonsense=3), "unknown argument 'nonsense'"),
        (lambda p: seiche.solve(p, 1.0, rtol=1e-6), "^unknown argument 'rtol'; did you mean 'tolerance'"),
        (lambda p: seiche.solve(p, 1.0, atol=1e-6), "^unknown argument 'atol'; did you mean 'tolerance'"),
        (lambda p: seiche.solve("oscillator", 1.0, tol=1e-6), "^unknown argument 'tol'; did you mean 'tolerance'"),
        (lambda p: seiche.solve(p, 1.0, dt=0.1), "^unknown argument 'dt'; did you mean 'h'"),
        (lambda p: seiche.solve(p, 1.0, h=0.1, t_evl=[1]), "^unknown argument 't_evl'; did you mean 't_eval'"),
        (lambda p: seiche.solve(p, 1.0, h=0.1, event=len), "^unknown argument 'event'; did you mean 'events'"),
        (lambda p: seiche.solve("oscillator", 1.0, step=0.1), "^unknown argument 'step'; did you mean 'h'"),
        (lambda p: seiche.solve(p, 1.0, tolerance=1e-3, h_max=0.1, max_step=0.1), "h_max and max_step are one argument"),
        (lambda p: seiche.solve(p, t_end=1.0, h=0.1), "^unknown argument 't_end'; did you mean 't_span'"),
        (lambda p: seiche.solve(p, 1.0, np.zeros(12), y0=np.zeros(12), h=0.1), "z0 and y0 are one argument"),
        (lambda p: seiche.spectrum("klein_gordon", tolerance=1e-6), "spectrum looks at one step: give h"),
        (lambda p: seiche.problem("klein_gordn"), "unknown problem.*did you mean 'klein_gordon'"),
        (lambda p: seiche.problem("klein_gordon", alhpa=1.0), "did you mean 'alpha'"),
        (lambda p: seiche.problem("klein_gordon", points=-3), "^points = -3 must be"),
        (lambda p: seiche.solve(pendulums(z0=None), 1.0, h=0.1), "z0 is missing"),
    ],
)
def test_sentences(call, sentence):
    with pytest.raises(ValueError, match=sentence):
        call(pendulums())


def test_other_threads_run_while_it_steps():
    wave = seiche.problem("klein_gordon", points=512)
    count, running = 0, True

    def spin():
        nonlocal count
        while running:
            count += 1
            time.sleep(0)

    thread = threading.Thread(target=spin)
    thread.start()
    before = count
    r = seiche.solve(wave, 8.0, method="seavf", h=1 / 512, record_every=512, z0=0.1 * wave.z0)
    during = count - before
    running = False
    thread.join()
    assert r.success and during > 100


def test_two_threads_solve_at_once():
    results = {}
    wave = seiche.problem("klein_gordon", points=32, alpha=1.0)

    def work(name, method):
        results[name] = seiche.solve(wave, 2.0, method=method, h=1 / 64)

    threads = [threading.Thread(target=work, args=(i, "egc4")) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(np.array_equal(results[i].y, results[0].y) for i in range(4))


def test_a_thousand_runs_leave_no_memory_behind():
    problem = pendulums()

    def round_of(runs):
        for _ in range(runs):
            r = seiche.solve(
                problem, 1.0, method="seisav", h=0.02, dense_output=True, events=lambda t, y: y[0] - 100, z0=problem.z0
            )
            r.sol(0.33)
        gc.collect()
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    first = round_of(200)
    assert round_of(1000) - first < 4096  # kilobytes
