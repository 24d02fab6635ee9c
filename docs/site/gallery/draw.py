#!/usr/bin/python3
"""Draws the picture of a page of the gallery from the folder of its run: draw.py NAME DIRECTORY PICTURE.png

Beside it comes PICTURE_dark.png, the same on a dark ground. `seiche plot` draws what every run has; here are the views that
belong to one system each: the energies of modes, a section through an attractor, curves that symmetry makes equal. Each function
is what its page shows; `run` holds t and the fields as arrays, one row for each time.
"""
import pathlib
import sys
import types

import h5py
import matplotlib.pyplot as plt
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "python/seiche"))
from drawing import colours, maps, style  # noqa: E402


def solution(directory):
    with h5py.File(pathlib.Path(directory) / "solution.h5") as file:
        names = file.attrs["fields"]
        fields = (names.decode() if isinstance(names, bytes) else str(names)).split()
        return types.SimpleNamespace(t=file["t"][:], energy=table(pathlib.Path(directory) / "energy.csv"),
                                     **{name: file[name][:] for name in fields})


def table(path, dtype=float):
    return np.genfromtxt(path, delimiter=",", names=True, dtype=dtype, encoding="utf-8")


def ground_colour(ax, number):
    return style.on_ground(ax, style.CURVES[number])


def over_place_and_time(ax, run, values, x, label, place="$x$", look=colours.Look()):
    maps.space_time(ax, run.t, ("x", x), values, colours.scale_of([values], look), label)
    ax.set(ylabel=place)


def pendulum(ax, run):
    from matplotlib.collections import LineCollection

    path = np.stack([run.q.ravel() / np.pi, run.p.ravel()], axis=1)
    pieces = LineCollection(
        np.stack([path[:-1], path[1:]], axis=1), array=run.t[:-1], linewidth=0.9, cmap=style.sequence(ax)
    )
    ax.add_collection(pieces)
    ax.figure.colorbar(pieces, ax=ax, label="$t$", pad=0.02, aspect=28)
    ax.set(xlabel=r"angle $q/\pi$", ylabel="velocity $p$")
    ax.autoscale()
    ax.margins(0.05)


def duffing_section(ax, run):
    first = 20  # periods in which the start is forgotten
    ax.plot(run.q.ravel()[first:], run.p.ravel()[first:], ".", markersize=1.2, color=ground_colour(ax, 0))
    ax.set(xlabel="displacement $q$", ylabel="velocity $p$")
    ax.margins(0.05)


def beta_fpu(ax, run):
    bonds = run.u.shape[1] + 1
    for n, k in enumerate((1, 3, 5, 7)):
        weights = np.sqrt(2 / bonds) * np.sin(np.pi * k * np.arange(1, bonds) / bonds)
        energy = ((run.v @ weights) ** 2 + (2 * np.sin(np.pi * k / (2 * bonds)) * (run.u @ weights)) ** 2) / 2
        ax.plot(run.t, energy, color=ground_colour(ax, n), label=k)
    ax.set(xlabel="time $t$", ylabel="energy of a mode")
    ax.legend(title="mode", loc="upper right")


def kdv_soliton(ax, run):
    points = run.u.shape[1]
    x = 40 * np.arange(1, points + 1) / points
    for n in np.linspace(0, len(run.t) - 1, 5).round().astype(int):
        ax.plot(x, run.u[n], color=style.in_sequence(ax, n / (len(run.t) - 1)), label=f"$t$ = {run.t[n]:g}")
    ax.set(xlabel="$x$", ylabel="$u$", xlim=(0, 40))
    ax.legend(loc="upper right")


def nls(ax, run):
    points = run.p.shape[1]
    over_place_and_time(ax, run, np.hypot(run.p, run.q), 40 * np.arange(1, points + 1) / points, r"$|\psi|$")


def network(ax, run):
    nodes = run.u.shape[1]
    distance = [0] + [1 if node in (1, 4, 5) else 2 for node in range(1, nodes)]  # from node 1 of Petersen's graph
    for node, far in enumerate(distance):
        label = far if node == distance.index(far) else None
        ax.plot(run.t, run.u[:, node], color=ground_colour(ax, far), label=label)
    ax.set(xlabel="time $t$", ylabel="displacement")
    ax.legend(title="distance", ncol=3, loc="upper right")


def toda(ax, run):
    masses = np.arange(1, run.v.shape[1] + 1)
    over_place_and_time(
        ax, run, run.v, masses, "velocity", place="mass", look=colours.Look(range=(-1.2, 1.2), centre=0.0)
    )


def frenkel_kontorova(ax, run):
    atoms, turns = run.u1.shape[1], 55  # of the ground, for so many atoms
    phase = turns * np.arange(1, atoms + 1) / atoms
    for number, (u, K) in enumerate(((run.u1[-1], 0.8), (run.u2[-1], 1.2))):
        ax.plot(phase % 1, (phase + u) % 1, ".", markersize=3, color=ground_colour(ax, number), label=f"$K$ = {K}")
    ax.set(
        xlabel="where equal distances put an atom (mod 1)", ylabel="where it rests (mod 1)", xlim=(0, 1), ylim=(0, 1)
    )
    ax.legend(loc="upper left")


def fput_load(ax, run):
    masses = np.arange(1, run.v.shape[1] + 1)
    over_place_and_time(
        ax, run, run.v, masses, "velocity", place="mass", look=colours.Look(range=(-0.02, 0.02), centre=0.0)
    )


def whitham(ax, run):
    points = run.u.shape[1]
    x = 100 * np.arange(1, points + 1) / points
    over_place_and_time(ax, run, run.u, x, "elevation $u$", look=colours.Look(range=(-0.08, 0.08), centre=0.0))


def henon_heiles(axes, run):
    for i, (ax, begin, end) in enumerate(zip(axes, (0, 150, 340), (60, 210, 400))):
        chosen = (run.t >= begin) & (run.t <= end)
        ax.plot(run.q1[chosen], run.q2[chosen], color=ground_colour(ax, i), linewidth=0.7)
        ax.set(title=f"{begin} ≤ $t$ ≤ {end}", xlabel="$q_1$", ylabel="$q_2$", xlim=(-0.75, 0.75), ylim=(-0.6, 0.9))
        ax.label_outer()


def coarsening(axes, run):
    t, H = run.energy["t"], run.energy["H"]
    energies, steps = axes
    energies.loglog(t[1:], H[1:], color=ground_colour(energies, 0), label="Seiche")
    published = table(pathlib.Path(__file__).with_name("published_energies.csv"), dtype=None)
    for name, label, marker, number in (("moose_1a_mpf", "MOOSE", "o", 1), ("prismspf_1a", "PRISMS-PF", "x", 2)):
        one = published[(published["simulation"] == name) & (published["t"] > 0)]
        energies.loglog(one["t"], one["F"], marker, markersize=2.6, mfc="none", label=label,
                        color=ground_colour(energies, number))
    energies.set(xlabel="time $t$", ylabel="energy $H$")
    energies.legend(loc="lower left")
    steps.loglog(t[1:], np.diff(t), color=ground_colour(steps, 0))
    steps.set(xlabel="time $t$", ylabel="step $h$")


DRAWN = {
    function.__name__: function
    for function in (
        pendulum,
        duffing_section,
        beta_fpu,
        kdv_soliton,
        nls,
        network,
        toda,
        frenkel_kontorova,
        fput_load,
        whitham,
        henon_heiles,
        coarsening,
    )
}


def draw(name, run, path):
    for ground in style.GROUNDS.values():
        with style.on(ground):
            side_by_side = {"henon_heiles": 3, "coarsening": 2}.get(name, 1)
            figure, axes = plt.subplots(1, side_by_side, figsize=(4.2, 1.8) if side_by_side > 1 else (4.2, 2.6))
            DRAWN[name](axes, run)
            figure.savefig(path.with_stem(path.stem + ground.suffix))
            plt.close(figure)


if __name__ == "__main__":
    name, directory, path = sys.argv[1:]
    draw(name, solution(directory), pathlib.Path(path))
