"""Steps of one's own are those of a run."""

import numpy as np
import pytest

import seiche


@pytest.fixture
def pendulum():
    return seiche.Problem(fields=["q", "p"], H="p^2/2 + 1 - cos(q)", D={"p": 0.1}, initial={"q": 2, "p": 0.3})


@pytest.mark.parametrize("method", ["seisav", "seilm", "egc4", "crkn6"])
@pytest.mark.parametrize("backend", ["dense", "modal"])
def test_steps_are_those_of_a_run_to_the_bit(method, backend):
    wave = seiche.problem("klein_gordon", points=16, alpha=1.0, gamma=0.1, initial={"u": "exp(-4*(x-1)^2)", "v": "0"})
    run = seiche.solve(wave, 1.0, method=method, h=1 / 16, backend=backend)
    simulation = seiche.Simulation(wave, method, backend=backend)
    for k in range(16):
        assert simulation.step(1 / 16) is simulation
        assert (simulation.y == run.y[:, k + 1]).all()
        assert simulation.energy == run.energy[k + 1]
    if run.modified_energy is not None:
        assert simulation.modified_energy == run.modified_energy[-1]
    assert simulation.steps == 16 and simulation.t == 1.0
    assert (simulation.method, simulation.backend) == (method, backend)
    assert simulation.field("u").shape == (16,)
    assert (seiche.Simulation(wave, method, backend=backend).step(1 / 16, 16).y == simulation.y).all()


def test_another_state_is_a_fresh_start(pendulum):
    simulation = seiche.Simulation(pendulum, "seisav", t=5.0)
    assert simulation.t == 5.0 and simulation.y.tolist() == [2, 0.3]
    simulation.step(0.1, 7)
    simulation.set_state([1.0, 0.5], t=0.0)
    fresh = seiche.Simulation(pendulum, "seisav", z0=[1.0, 0.5])
    assert simulation.step(0.1, 5).y.tolist() == fresh.step(0.1, 5).y.tolist()
    assert simulation.steps == 5 and simulation.modified_energy == fresh.modified_energy


def test_the_energy_falls_in_a_loop_with_steps_of_any_size(pendulum):
    simulation = seiche.Simulation(pendulum, "egc4")
    last = simulation.energy
    for h in np.geomspace(1e-3, 3, 40):
        now = simulation.step(h).energy
        assert now <= last * (1 + 1e-14)
        last = now
    assert "at t = " in repr(simulation)


def test_a_step_without_a_solution_leaves_the_state_and_says_why():
    blow_up = seiche.Problem(fields=["q", "p"], H="p^2/2 - q^4/4", initial={"q": 2, "p": 1})
    simulation = seiche.Simulation(blow_up, "egc4", law="none")
    with pytest.raises(seiche.StepError) as failed:
        for _ in range(1000):
            before = simulation.y
            simulation.step(0.05)
    assert (simulation.y == before).all()
    assert "\n" not in str(failed.value) and len(str(failed.value)) > 20


def test_a_problem_by_python_functions_steps_as_well():
    stated = seiche.Problem(M=np.diag([0, 1.0]), V=lambda u: np.sum(1 - np.cos(u)), gradient=np.sin, z0=[2, 0.3], D=np.diag([0, 0.1]))
    simulation = seiche.Simulation(stated, "egc4")
    assert simulation.y == pytest.approx([2, 0.3])
    run = seiche.solve(stated, 1.0, method="egc4", h=0.1)
    assert simulation.step(0.1, 10).y == pytest.approx(run.y[:, -1], abs=1e-14)


def test_bad_arguments_get_one_sentence(pendulum):
    simulation = seiche.Simulation(pendulum)
    for call, sentence in [
        (lambda: simulation.step(-0.1), "h = -0.1 must be > 0"),
        (lambda: simulation.step(float("nan")), "h = nan must be > 0"),
        (lambda: simulation.step(0.1, 0), "count = 0 must be ≥ 1"),
        (lambda: simulation.set_state([1]), "y has 1 numbers; a state of custom has 2"),
        (lambda: simulation.set_state([1, float("inf")]), "y holds a value that is no finite number"),
        (lambda: seiche.Simulation(pendulum, "auto"), "name one"),
        (lambda: seiche.Simulation(pendulum, "seisv"), "did you mean 'seisav'"),
        (lambda: seiche.Simulation(pendulum, h=0.1), "give h to step"),
        (lambda: seiche.Simulation(pendulum, tolerance=0.1), "seiche.solve takes it"),
    ]:
        with pytest.raises(ValueError) as refused:
            call()
        assert sentence in str(refused.value)
