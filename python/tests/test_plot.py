"""Figures of seiche.plot: what they show, and the conventions that they share with `seiche plot` (docs/conventions.md)."""

import re
import shutil
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest
import seiche
from seiche import _styles
from seiche.drawing import style


@pytest.fixture(scope="module")
def wave():
    return seiche.problem("klein_gordon", points=16, alpha=1.0, gamma="0.1 + 0.05*sin(t)")


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    plt.close("all")


def oscillator(**parameters):
    return seiche.problem("oscillator", **({"alpha": 0.0, "gamma": 0.0} | parameters))


def test_figures(wave):
    r = seiche.solve(wave, 1.0, h=0.0625)
    assert len(seiche.plot.energy(r).lines) == 2
    ax = seiche.plot.space_time(r, "v")
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("time $t$", "$x$")  # as `seiche plot`
    mesh = ax.collections[0]
    assert np.array_equal(np.reshape(mesh.get_array(), (16, 17)), r.field("v").T)
    with pytest.raises(ValueError, match="slices draws fields over 2 axes; klein_gordon has: x"):
        seiche.plot.slices(r)
    assert seiche.plot.spectrum(seiche.problem("klein_gordon", points=16), "seisav", 0.1).lines
    ax = seiche.plot.work_precision(seiche.problem("oscillator"), ["seisav", "egc4"], [0.1, 0.05], t_end=1.0)
    assert len(ax.lines) == 2 and ax.lines[0].get_xdata().size == 2


def test_slices_have_scales_of_their_own_where_a_wave_dies_down():
    def slices(gamma):
        start = {"u": "exp(-4*((x-2)^2 + (y-2)^2)) - 0.2", "v": "0"}
        plane = seiche.problem(
            "klein_gordon", points=[16, 12], length=[4.0, 4.0], alpha=1.0, omega_squared=1.0, gamma=gamma, initial=start
        )
        r = seiche.solve(plane, 6.0, h=0.125)
        axes = seiche.plot.slices(r)
        assert [ax.get_title() for ax in axes] == ["$t$ = 0", "$t$ = 2", "$t$ = 4", "$t$ = 6"]
        assert np.array_equal(np.reshape(axes[3].collections[0].get_array(), (12, 16)), r.field("u")[-1].T)
        return [ax.collections[0].get_clim() for ax in axes], np.abs(r.field("u")[[0, 16, 32, 48]]).max(axis=(1, 2))

    scales, sizes = slices(2.0)
    assert sizes[0] > 4 * sizes[-1] and np.allclose(np.abs(scales).max(axis=1), sizes)
    scales, sizes = slices(0.0)
    assert (
        sizes.max() < 4 * sizes.min()
        and len(set(scales)) == 1
        and np.abs(scales[0]).max() == pytest.approx(sizes.max())
    )


def test_a_phase_portrait_shows_its_states_where_they_are_few():
    def line(states):
        r = seiche.solve(oscillator(), 12.0, method="egc6", h=0.125, t_eval=np.linspace(0, 12, states))
        ax = seiche.plot.phase_portrait(r)
        assert ax.get_xlabel() == "displacement $q$" and ax.get_ylabel() == "momentum $p$"
        assert np.array_equal(ax.lines[0].get_xdata(), r.y[0]) and np.array_equal(ax.lines[0].get_ydata(), r.y[1])
        return ax.lines[0].get_marker(), ax.lines[0].get_linestyle()

    assert line(400) == ("None", "-")
    assert line(25) == (".", "-")
    assert line(6) == (".", "None")
    several = seiche.solve(oscillator(points=3), 1.0, h=0.125)
    ax = seiche.plot.phase_portrait(several)
    assert len(ax.lines) == 9
    assert ax.get_legend_handles_labels()[1] == ["point 1", "point 2", "point 3", "start", "end"]
    assert len(seiche.plot.phase_portrait(several, "p", "q", point=2).lines) == 3
    with pytest.raises(ValueError, match="there is no point 3"):
        seiche.plot.phase_portrait(several, point=3)


def test_profiles_are_the_states_at_some_times(wave):
    r = seiche.solve(wave, 1.0, h=0.0625)
    ax = seiche.plot.profiles(r, "v", count=3)
    assert [np.array_equal(line.get_ydata(), r.field("v")[k]) for line, k in zip(ax.lines, (0, 8, 16))] == [True] * 3
    assert ax.get_xlabel() == "$x$" and ax.get_ylabel() == "velocity $v$"
    with pytest.raises(ValueError, match="profiles draws fields over 1 axes; oscillator has: none"):
        seiche.plot.profiles(seiche.solve(oscillator(), 1.0, h=0.125))


def test_the_legend_of_profiles_covers_neither_curves_nor_labels(wave):
    ax = seiche.plot.profiles(seiche.solve(wave, 1.0, h=0.0625))
    ax.figure.canvas.draw()
    legend, frame = ax.get_legend().get_window_extent(), ax.get_window_extent()
    assert legend.x0 >= frame.x1 and legend.x1 <= ax.figure.bbox.x1 and frame.y0 <= legend.y0 <= legend.y1 <= frame.y1


@pytest.mark.parametrize("points", [6, 9, 16, 33])
def test_the_axis_of_a_ring_has_ticks_at_its_masses_alone(points):
    ring = seiche.problem("chain", points=points, boundary="periodic", initial="kick")
    r = seiche.solve(ring, 1.0, h=0.125)
    for axis in (seiche.plot.profiles(r).xaxis, seiche.plot.space_time(r).yaxis):
        low, high = axis.get_view_interval()
        ticks = [tick for tick in axis.get_majorticklocs() if low <= tick <= high]
        assert len(ticks) > 2 and set(ticks) <= set(range(1, points + 1))


@pytest.mark.parametrize("points", [1, 3])
def test_a_fit_shows_residuals_and_its_legend_covers_no_curve(points):
    pytest.importorskip("scipy")
    t, noise = np.linspace(0.5, 10, 40), 0.03 * np.random.default_rng(1).standard_normal((points, 40))
    swings = oscillator(points=points, gamma=0.2)
    found = seiche.fit(
        swings, t, seiche.solve(swings, 10.0, h=0.05, t_eval=t).field("q").T + noise, {"gamma": (0.3, 0, 1)}
    )
    ax = found.plot()
    assert ax.get_ylabel() == "displacement $q$" and r"fit, $\gamma$ = 0." in ax.get_title()
    below = ax.figure.axes[1]
    assert below.get_xlabel() == "time $t$" and below.get_ylabel() == "residual / σ"
    shown = np.array([line.get_ydata() for line in below.lines[:points]])
    assert np.allclose(shown, np.atleast_2d(found.residuals[0] / found.sigma[0]))
    assert ax.lines[0].get_color() == style.CURVES[0] and ax.lines[1].get_color() == style.CURVES[0]
    ax.figure.canvas.draw()
    legend = ax.transData.inverted().transform(ax.get_legend().get_window_extent())[0, 1]
    assert legend > max(line.get_ydata().max() for line in ax.lines)
    assert len(found.plot(plt.figure().subplots()).figure.axes) == 1


def test_planes_go_through_the_middle_of_a_result_in_space():
    start = {"u": "exp(-4*((x-1)^2 + (y-1)^2 + (z-1)^2))", "v": "0"}
    box = seiche.problem("klein_gordon", points=[6, 8, 10], length=[2.0, 2.0, 2.0], alpha=1.0, gamma=0.1, initial=start)
    r = seiche.solve(box, 1.0, h=0.125)
    axes = seiche.plot.planes(r)
    assert [(ax.get_xlabel(), ax.get_title()) for ax in axes[:2]] == [("$x$", "$t$ = 0"), ("$x$", "$t$ = 1")]
    shown = [
        np.reshape(ax.collections[0].get_array(), shape) for ax, shape in zip(axes[::2], [(8, 6), (10, 6), (10, 8)])
    ]
    u = r.field("u")[0]
    for plane, of_u in zip(shown, (u[:, :, 5], u[:, 4, :], u[3, :, :])):
        assert np.array_equal(plane, of_u.T)
    with pytest.raises(ValueError, match="slices draws fields over 2 axes"):
        seiche.plot.slices(r)
    figure = plt.figure()
    mine = figure.add_axes([0, 0, 0.1, 0.1])
    axes = seiche.plot.planes(r, figure=figure)
    assert len(axes) == 6 and mine not in list(axes) and [ax.get_title() for ax in axes[:2]] == ["$t$ = 0", "$t$ = 1"]


@pytest.fixture(scope="module")
def plane():
    start = {"u": "exp(-4*((x-2)^2 + (y-2)^2)) - 0.2", "v": "0"}
    return seiche.problem("klein_gordon", points=[12, 8], length=[4.0, 4.0], alpha=1.0, gamma=0.1, initial=start)


def test_a_film_shows_every_state_and_says_how_far_it_is(plane, tmp_path):
    r = seiche.solve(plane, 1.0, h=0.25)
    done = []
    file = seiche.plot.film(r, tmp_path / "wave.mp4", progress=done.append)
    assert file.parent == tmp_path and file.stem == "wave" and file.suffix in (".mp4", ".webm", ".webp", ".apng")
    assert file.stat().st_size > 1000 and done == pytest.approx([0.2, 0.4, 0.6, 0.8, 1.0])
    assert seiche.plot.film(r, tmp_path / "night", "v", dark=True).stem == "night"
    with pytest.raises(ValueError, match="there is no folder .*nowhere for the film"):
        seiche.plot.film(r, tmp_path / "nowhere/film")
    with pytest.raises(ValueError, match="has no field 'w'"):
        seiche.plot.film(r, tmp_path / "film", "w")


def test_a_film_writes_whole_lines_without_a_bar_into_a_file(plane, tmp_path, monkeypatch):
    import io
    import sys

    from seiche import _progress

    monkeypatch.setattr(_progress, "_SELDOM", 0.0)
    monkeypatch.setattr(sys, "stderr", io.StringIO())
    seiche.plot.film(seiche.solve(plane, 1.0, h=0.25), tmp_path / "wave.webp", progress=True)
    lines = sys.stderr.getvalue().splitlines(keepends=True)
    assert lines == [f"{share:3d} % drawing\n" for share in (20, 40, 60, 80, 100)]


def test_a_film_takes_the_name_that_was_given(plane, tmp_path):
    from PIL import features

    r = seiche.solve(plane, 0.5, h=0.25)
    (tmp_path / "wave.mp4").write_text("mine")
    named = seiche.plot.film(r, tmp_path / "wave.v1")
    assert named.stem == "wave.v1" and (tmp_path / "wave.mp4").read_text() == "mine"
    starts = {".apng": (b"\x89PNG", 0), ".png": (b"\x89PNG", 0)}
    if features.check("webp_anim"):
        starts[".webp"] = (b"RIFF", 0)
    if shutil.which("ffmpeg"):
        starts |= {".webm": (b"\x1a\x45\xdf\xa3", 0), ".mp4": (b"ftyp", 4)}
    for ending, (start, place) in starts.items():
        file = seiche.plot.film(r, tmp_path / f"film{ending}")
        assert file == tmp_path / f"film{ending}" and file.read_bytes()[place : place + 4] == start
    with pytest.raises(
        ValueError, match=r"^unknown ending '.gif' of a film. Allowed: .mp4, .webm, .webp, .apng, .png$"
    ):
        seiche.plot.film(r, tmp_path / "wave.gif")


def test_a_report_has_the_pictures_that_the_program_draws(plane, tmp_path):
    pytest.importorskip("h5py")
    done = seiche.solve(plane, 1.0, h=0.25).save(tmp_path / "run")
    page = seiche.plot.report(done, formats="png", film=False)
    assert page == tmp_path / "run/report.html" and "figures/energy.png" in page.read_text(encoding="utf-8")
    drawn = {file.name for file in (tmp_path / "run/figures").iterdir()}
    assert {"energy.png", "energy_dark.png", "slices_u.png"} <= drawn and not any(".pdf" in name for name in drawn)
    with pytest.raises(ValueError, match="unknown format 'gif'. Allowed: png, pdf, svg"):
        seiche.plot.report(done, formats=["gif"])
    with pytest.raises(ValueError, match="nowhere is no directory of a run"):
        seiche.plot.report(tmp_path / "nowhere")


def test_the_plot_module_shows_what_it_offers_alone():
    assert set(dir(seiche.plot)) == set(seiche.plot.__all__)
    public = {name for name in vars(seiche.plot) if not name.startswith("_")}
    assert public - {"annotations"} == set(seiche.plot.__all__)


SOURCE = Path(__file__).resolve().parents[2]


def test_colours_are_from_both_sides_of_zero_only_where_values_are(wave):
    r = seiche.solve(wave, 4.0, h=0.125)
    for ground, name in (("default", "vik"), ("dark_background", "berlin")):
        with plt.style.context(ground):
            mesh = seiche.plot.space_time(r, "v").collections[0]
        low, high = mesh.get_clim()
        assert low == -high, "zero at the centre"
        assert mesh.cmap.name == name
        middle, ends = np.mean(mesh.cmap(0.5)[:3]), [np.mean(mesh.cmap(s)[:3]) for s in (0.0, 1.0)]
        assert (
            all(middle > end for end in ends) if name == "vik" else all(middle < end for end in ends)
        ), "as the ground"
    flat = seiche.solve(
        seiche.problem("klein_gordon", points=16, initial={"u": "2 + sin(pi*x)", "v": "0"}), 0.1, h=0.05
    )
    mesh = seiche.plot.space_time(flat).collections[0]
    assert mesh.cmap.name == "viridis" and mesh.get_clim() == (flat.field("u").min(), flat.field("u").max())


def test_a_norm_of_ones_own_is_taken(wave):
    from matplotlib.colors import Normalize

    r = seiche.solve(wave, 1.0, h=0.0625)
    mesh = seiche.plot.space_time(r, norm=Normalize(-3, 3)).collections[0]
    assert mesh.get_clim() == (-3, 3)
    with pytest.raises(TypeError, match="^energy draws what"):
        seiche.plot.energy("x")


def test_curves_have_the_colours_of_the_program(wave):
    text = (SOURCE / "seiche/figure/style.cpp").read_text(encoding="utf-8")
    program = re.findall(r"#[0-9A-F]{6}", re.search(r"6> colours = \{(.*?)\}", text)[1])
    conventions = (SOURCE / "docs/conventions.md").read_text(encoding="utf-8")
    assert re.findall(r"`(#[0-9A-F]{6})`", conventions) == program == list(style.CURVES)
    rows = re.findall(r'\{"(\w+)", +"[^"]*", +\{"(#\w+)", +(\w+), +(\w+), +(\w+),', text)
    assert len(rows) == len(_styles.METHODS) == len(seiche.methods()) - 1  # "auto" is one of the others
    assert {
        name: (colour, shape, filled == "true", dash) for name, colour, shape, filled, dash in rows
    } == _styles.METHODS

    r = seiche.solve(wave, 1.0, h=0.0625)
    ax = seiche.plot.energy(r)
    assert [line.get_color() for line in ax.lines] == program[:2]
    seiche.plot.energy(seiche.solve(wave, 1.0, method="seavf", h=0.0625), ax)
    assert [line.get_color() for line in ax.lines] == program[:3], "one more run is one more colour"
    assert seiche.plot.energy(r, c="red").lines[0].get_color() == "red"
    ax = seiche.plot.phase_portrait(seiche.solve(oscillator(points=2), 1.0, h=0.0625))
    assert [line.get_color() for line in ax.lines] == [
        program[0],
        "#000000",
        "#000000",
        program[1],
        "#000000",
        "#000000",
    ]
    ax = seiche.plot.work_precision(seiche.problem("oscillator"), ["seisav", "savf"], ["1/8", "1/16"], t_end=1.0)
    assert [
        (line.get_color(), line.get_marker(), line.get_linestyle(), line.get_markerfacecolor()) for line in ax.lines
    ] == [
        ("#D55E00", "s", "-", "#D55E00"),
        ("#2AA198", "o", "--", "none"),
    ]
    ax = seiche.plot.spectrum(wave, "seilm", 0.1)
    assert ax.lines[1].get_color() == "#0072B2" and ax.get_ylim()[0] <= 0


def test_curves_are_lighter_on_a_dark_ground(wave):
    r = seiche.solve(wave, 1.0, h=0.0625)
    with plt.style.context("dark_background"):
        blue, vermilion = (line.get_color() for line in seiche.plot.energy(r).lines)
        mark = seiche.plot.phase_portrait(r, point=3).lines[1].get_color()
    assert (blue, vermilion, mark) == ("#5DA5CE", "#DE8036", "#E6E8EA")
    figure, ax = plt.subplots()
    ax.set_facecolor("none")  # the ground is then that of the figure
    assert seiche.plot.energy(r, ax).lines[0].get_color() == "#0072B2"


def test_the_energy_of_an_ensemble_is_its_mean_and_spread(wave):
    e = seiche.solve_ensemble(wave, 1.0, np.outer(np.linspace(0.5, 1.5, 20), wave.z0), method="seisav", h=0.0625)
    ax = seiche.plot.energy(e)
    assert np.array_equal(ax.lines[0].get_ydata(), e.energy["mean"])
    assert np.array_equal(ax.lines[1].get_ydata(), e.modified_energy["mean"])
    wide, narrow = (line.get_linewidth() for line in ax.lines)
    assert wide >= 2 * narrow, "they coincide, and both are seen"
    low, high = ax.collections[0].get_paths()[0].get_extents().get_points()[:, 1]
    assert low == e.energy["q05"].min() and high == e.energy["q95"].max()
    assert ax.get_title() == "klein_gordon, seisav, $h$ = $2^{-4}$: energy of 20 members, law holds"
    for draw in (seiche.plot.space_time, seiche.plot.slices, seiche.plot.phase_portrait):
        with pytest.raises(
            ValueError, match=f"^{draw.__name__} draws one run, and an ensemble keeps the last states alone"
        ):
            draw(e)


def test_a_narrow_peak_is_drawn_at_its_height():
    peak = seiche.problem(
        "klein_gordon", points=128, gamma=0.0, alpha=1.0, initial={"u": "exp(-4000*(x-1)^2) - 0.1", "v": "0"}
    )
    mesh = seiche.plot.space_time(seiche.solve(peak, 0.125, h=0.0625)).collections[0]
    assert mesh.get_clim() == pytest.approx((-0.9, 0.9)) and mesh.colorbar.extend == "neither"


def test_slices_have_one_kind_of_colours():
    start = {"u": "exp(-9*((x-2)^2 + (y-2)^2))", "v": "0"}
    plane = seiche.problem("klein_gordon", points=[24, 24], length=[4.0, 4.0], alpha=1.0, gamma=1.0, initial=start)
    axes = seiche.plot.slices(seiche.solve(plane, 4.0, h="1/64"))
    assert len({ax.collections[0].get_clim() for ax in axes}) == 4, "each has a scale of its own"
    assert {ax.collections[0].cmap.name for ax in axes} == {"vik"}
    assert [ax.collections[0].colorbar.ax.get_ylabel() for ax in axes] == ["$u$"] * 4


def test_below_the_title_stands_what_a_run_falls_short_of(wave):
    def title(result):
        return seiche.plot.energy(result).get_title().splitlines()

    stopped = seiche.solve(wave, 1.0, h=0.0625, observer=lambda t, y, energy: t < 0.5)
    assert title(stopped)[1] == "interrupted at $t$ = 0.5"
    assert len(title(seiche.solve(wave, 1.0, h=0.0625))) == 1
    stopped["law"] = "violated"
    assert title(stopped)[1] == "interrupted at $t$ = 0.5, the energy law is violated"
    states = np.array([np.zeros(32), np.full(32, 0.1)])
    members = seiche.solve_ensemble(wave, 1.0, states, h=0.0625)
    assert len(title(members)) == 1
    members.status[1] = "failed"
    assert title(members)[1] == "1 of 2 members failed"


def test_a_narrow_figure_has_room_for_titles_and_for_the_numbers_of_its_axes(wave):
    def narrow():
        return plt.figure(figsize=(3, 2.4), layout="constrained")

    r, figures = seiche.solve(wave, 1.0, h=0.0625), [narrow() for _ in range(3)]
    seiche.plot.energy(r, figures[0].subplots())
    seiche.plot.spectrum(wave, "seisav", 0.1, ax=figures[1].subplots())
    seiche.plot.work_precision("oscillator", ["seisav", "egc4"], [0.1, 0.05], 1.0, ax=figures[2].subplots())
    for figure in figures:
        figure.canvas.draw()
        title = figure.axes[0].title.get_window_extent()
        assert (
            figure.axes[0].get_title() and title.x0 >= 0 and title.x1 <= figure.bbox.x1 and title.y1 <= figure.bbox.y1
        )


def test_titles_are_those_of_the_program(tmp_path):
    case = tmp_path / "swing.toml"
    case.write_text(
        '[problem]\nname = "custom"\nfields = ["theta", "p1"]\nH = "p1^2/2 - cos(theta)"\n'
        'initial = { theta = "1", p1 = "0" }\n[method]\nh = 0.125\n[time]\nend = 2\n'
    )
    r = seiche.solve(seiche.load(case))
    assert seiche.plot.energy(r).get_title() == f"swing, seisav, $h$ = $2^{{-3}}$: energy, law {r.law}"
    ax = seiche.plot.phase_portrait(r)
    assert (ax.get_xlabel(), ax.get_ylabel()) == (r"$\theta$", "$p_{1}$")
    by_tolerance = seiche.solve(seiche.load(case), method="egc6", tolerance=1e-6)
    assert seiche.plot.phase_portrait(by_tolerance).get_title() == "swing, egc6, tolerance 1e-06: phase portrait"
    written = seiche.Problem(fields=["q", "p"], H="p^2/2 + q^4/4", initial={"q": 1, "p": 0})
    assert "custom" not in seiche.plot.energy(seiche.solve(written, 1.0, h=0.1)).get_title()


def test_axes_of_a_subfigure_serve_too():
    import matplotlib.pyplot as plt

    r = seiche.solve(seiche.problem("klein_gordon", points=16), 1.0, h=0.125)
    left, right = plt.figure().subfigures(1, 2)
    seiche.plot.energy(r, ax=left.subplots())
    seiche.plot.profiles(r, "u", ax=right.subplots())
    plt.close("all")
