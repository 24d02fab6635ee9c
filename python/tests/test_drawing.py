"""What stands in the pictures of `seiche plot`: scales, names, titles, curves that hide one another."""

import json
import os
import subprocess
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest
import seiche
from seiche._toml import section
from seiche.drawing import colours, curve_pictures, curves, films, maps, names, render, runs, style


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    plt.close("all")


def pictures(tmp_path, problem, t_end=2.0, h=0.0625, method=None, **output):
    """Of a run, by stem."""
    sections = {
        "problem": problem,
        "method": {"name": method, "h": h},
        "time": {"end": t_end},
        "output": {"snapshot_every": 1, "ledger": "on"} | output,
    }
    tmp_path.mkdir(exist_ok=True)
    (tmp_path / "case.toml").write_text("".join(section(*one) for one in sections.items()), encoding="utf-8")
    seiche.run(tmp_path / "case.toml", tmp_path / "run")
    solution = runs.Solution(str(tmp_path / "run/solution.h5"))
    rows = np.genfromtxt(tmp_path / "run/energy.csv", delimiter=",", names=True)
    curve = lambda name: [rows["t"].tolist(), rows[name].tolist()]  # noqa: E731
    causes = [
        [name, [rows["t"].tolist(), np.cumsum(rows[name]).tolist()]]
        for name in rows.dtype.names
        if name not in ("t", "H", "H_modified")
    ]
    history = {
        "H": curve("H"),
        "modified": curve("H_modified") if "H_modified" in rows.dtype.names else None,
        "causes": causes,
    }
    return {picture.stem: picture for picture in runs.pictures_of(solution, history, colours.Look())}, solution


def drawn(picture, ground="light"):
    with style.on(style.GROUNDS[ground]):
        figure = plt.figure()
        return figure, picture.draw(figure)


def test_energies_that_coincide_are_both_seen(tmp_path):
    of, _ = pictures(tmp_path, {"name": "klein_gordon"})
    figure, said = drawn(of["energy"])
    under, over = figure.axes[0].lines
    assert "coincide: H and the modified energy" in said
    assert under.get_linestyle() == "-" and over.get_linestyle() == "--"
    assert under.get_linewidth() >= 2 * over.get_linewidth() and over.get_zorder() > under.get_zorder()


def test_parts_of_the_ledger_that_coincide_are_both_seen_and_small_ones_left_out(tmp_path):
    of, _ = pictures(tmp_path, {"name": "oscillator", "gamma": 0.1}, h=0.03125)
    figure, said = drawn(of["ledger"])
    labels = [line.get_label() for line in figure.axes[0].lines]
    assert labels == ["damping_left", "damping_right", "$H - H(0)$"]
    assert "coincide: damping_left and damping_right" in said


def test_what_hardly_changes_is_drawn_as_its_change():
    ax = plt.figure().subplots()
    t = np.linspace(0, 1, 11)
    said = curves.energy(ax, (t, 0.5 + 1e-12 * t))
    assert "as its change since the start, where it is 0.5" in said and ax.get_ylabel() == "$H - H(0)$"
    ax = plt.figure().subplots()
    assert curves.energy(ax, (t, 10.0 ** -(4 * t))) == "." and ax.get_yscale() == "log"


@pytest.mark.parametrize(
    "every, marker, line, words",
    [
        (1, "None", "-", ""),
        (16, ".", "-", "41 states of the run, about 13 to a turn"),
        (128, ".", "None", "too far apart to be joined"),
    ],
)
def test_a_portrait_of_few_states_to_a_turn_shows_them(tmp_path, every, marker, line, words):
    problem = {"name": "oscillator", "alpha": 0.0, "gamma": 0.0}
    of, _ = pictures(tmp_path, problem, t_end=20.0, h=0.03125, method="egc4", snapshot_every=every)
    figure, said = drawn(of["portrait_q_p"])
    curve = figure.axes[0].lines[0]
    assert (curve.get_marker(), curve.get_linestyle()) == (marker, line)
    assert words in said and (said == "") == (every == 1)


def test_portraits_pair_a_coordinate_with_its_momentum(tmp_path):
    problem = {"name": "custom", "fields": ["a", "b", "pa", "pb"], "H": "pa^2/2 + pb^2/2 + a^2 + b^4 + a^2*b^2"}
    of, _ = pictures(tmp_path, problem | {"initial": {"a": 1, "b": 0, "pa": 0, "pb": 0.5}})
    assert list(of) == ["energy", "ledger", "fields", "portrait_a_pa", "portrait_b_pb"]


def test_a_truss_is_drawn_as_its_bars_moved_by_what_the_file_holds(tmp_path):
    of, solution = pictures(tmp_path, {"name": "truss", "amplitude": 0.2}, t_end=1.0)
    assert list(of) == ["energy", "ledger", "bars"], "its points are in no order that a curve could show"
    places, supports, ends = solution.mesh()
    figure, _ = drawn(of["bars"])
    rest, start, end, fixed = figure.axes[0].lines
    moved = np.stack([solution.values(name, np.array([len(solution.t) - 1]))[0] for name in ("x", "y")], axis=-1)
    nodes = np.concatenate([places + moved, supports])
    pieces = end.get_xydata().reshape(-1, 3, 2)
    assert np.abs(moved).max() > 1e-3 and np.array_equal(pieces[:, :2], nodes[ends]) and np.isnan(pieces[:, 2]).all()
    assert np.array_equal(rest.get_xydata().reshape(-1, 3, 2)[:, :2], np.concatenate([places, supports])[ends])
    assert np.array_equal(fixed.get_xydata(), supports) and figure.axes[0].get_aspect() == 1
    small, _ = pictures(tmp_path / "small", {"name": "truss", "amplitude": 0.001}, t_end=0.125, h=0.03125)
    assert "Displacements are drawn 200 times as large" in small["bars"].caption and "× 200" in small["bars"].what


def test_names_are_set_alike_everywhere(tmp_path):
    problem = {
        "name": "custom",
        "fields": ["theta", "p1"],
        "H": "p1^2/2 - cos(theta)",
        "initial": {"theta": "1", "p1": "0"},
    }
    of, _ = pictures(tmp_path, problem)
    figure, _ = drawn(of["fields"])
    assert figure.axes[0].get_ylabel() == r"$\theta$, $p_{1}$"
    assert [line.get_label() for line in figure.axes[0].lines] == [r"$\theta$", "$p_{1}$"]
    assert of["portrait_theta_p1"].caption == "Phase portrait: p₁ over θ."
    assert names.symbol("u_field") == r"$\mathit{u\_field}$" and names.symbol("px") == "$p_{x}$"
    assert [names.number(x) for x in (1e-5, 3e-5, -2.5e-7, 0.125, 0)] == ["10⁻⁵", "3·10⁻⁵", "−2.5·10⁻⁷", "0.125", "0"]
    assert [names.step(h) for h in (2.0**-8, 1.0, 0.1, 1e-5)] == ["2⁻⁸", "2⁰", "0.1", "10⁻⁵"]


def test_a_scale_has_two_sides_only_where_values_do_in_earnest():
    rng = np.random.default_rng(1)
    scale = colours.scale_of([rng.uniform(-1, 1, 1000)])
    assert scale.is_diverging and scale.low == -scale.high
    vacuum = 1 + 0.1 * rng.uniform(-1, 1, 1000)
    vacuum[0] = -0.5  # one dot beyond zero
    scale = colours.scale_of([vacuum])
    assert not scale.is_diverging and scale.low == -0.5
    assert colours.scale_of([np.zeros(5)]) == colours.Scale(-1.0, 1.0, True)
    assert colours.scale_of([np.full(5, 3.0)])[:2] == (0.0, 6.0) and colours.scale_of([np.full(5, -3.0)])[:2] == (
        -6.0,
        0.0,
    )
    assert colours.scale_of([np.array([0.5, np.nan, 2.0])])[:2] == (0.5, 2.0)


def test_a_scale_holds_a_soliton_that_covers_little_of_the_picture():
    x, t = np.linspace(0, 100, 1000), np.linspace(0, 10, 40)
    soliton = 1.7 / np.cosh(3 * (x - 10 - t[:, None])) ** 2
    for values in (soliton, soliton - 1e-3 * np.sin(x), soliton + 0.2 * np.sin(x)):
        scale = colours.scale_of([values])
        assert scale.high == values.max() and scale.low <= values.min() and "pointed" not in scale.remark()
    soliton[3, 4], soliton[5, 6] = np.inf, np.nan
    assert colours.scale_of([soliton]).high < 2
    peak = np.exp(-(x[:, None] ** 2) - x**2)
    assert [scale.high for scale in colours.scales_of([peak, 2 * peak])] == [2 * peak.max()] * 2


def test_a_scale_that_ends_before_the_values_has_pointed_ends():
    ax = plt.figure().subplots()
    values = np.array([[0, 1], [2, 50.0], [3, -4]])
    for limits, extend in (((-1, 1), "both"), ((-4, 1), "max"), ((-1, 50), "min"), (None, "neither")):
        scale = colours.scale_of([values], colours.Look(range=limits))
        mesh = maps.image(ax, np.arange(3), np.arange(2), values, scale)
        assert colours.add_bar(mesh, ax, scale, "u").extend == extend and bool(scale.remark()) == (limits is not None)


def test_a_caption_says_which_range_shows_what_a_kick_leaves_pale():
    kick = 0.1 * np.sin(np.linspace(0, 60, 1000))
    kick[7] = 1.0
    assert colours.scale_of([kick]).remark().endswith("between −0.1 and 0.1: --range -0.1,0.1 shows those with more colours.")
    assert colours.scale_of([kick], colours.Look(range=(-1, 1))).remark() == colours.scale_of([kick[8:]]).remark() == ""
    assert colours.scale_of([kick**2 + 3]).usual == pytest.approx((3, 3.01))


def test_a_grid_is_shown_from_its_end_at_zero_and_a_lattice_from_its_first_mass():
    for places, begin, left in ((np.arange(1, 9) / 4, 0, 0), (np.arange(1.0, 9), 0.5, 1), (np.arange(8) + 0.5, 0, 0.5)):
        values, axes = np.ones((2, 8)), plt.figure().subplots(1, 2)
        maps.space_time(axes[0], np.arange(2), ("x", places), values, colours.Scale(0, 2, False), "u")
        curves.profiles(axes[1], np.arange(2), ("x", places), curves.Field("u", "", values))
        assert (axes[0].get_ylim()[0], axes[1].get_xlim()[0]) == (begin, left)


def test_a_range_of_one_field_leaves_the_others_alone(tmp_path):
    pictures(tmp_path, {"name": "klein_gordon"}, t_end=1.0)
    asked = request(tmp_path / "run", ranges={"v": [0, 1.1]}, range=[-3, 3])
    for stem, limits in (("space_time_u", (-3, 3)), ("space_time_v", (0, 1.1))):
        picture = next(one for one in render.RunStudio(asked).pictures if one.stem == stem)
        figure, _ = drawn(picture)
        assert figure.axes[0].collections[0].get_clim() == limits
    with pytest.raises(render.BadRequest, match=r"^--range w=0,1.5: there is no field 'w'; the fields are u, v$"):
        render.RunStudio(request(tmp_path / "run", ranges={"w": [0, 1.5]}))


def test_what_is_asked_for_decides():
    values = [np.linspace(-1, 3, 101)]
    assert colours.scale_of(values, colours.Look(range=(0.0, 2.0)))[:3] == (0.0, 2.0, False), "zero is not its middle"
    assert colours.scale_of(values, colours.Look(range=(-2.0, 2.0)))[:3] == (-2.0, 2.0, True)
    assert colours.scale_of(values, colours.Look(centre=2.0))[:3] == (-1.0, 5.0, True)
    ax = plt.figure().subplots()
    assert colours.scale_of(values, colours.Look(palette="magma")).style(ax)["cmap"] == "magma"


def test_pictures_of_a_field_that_dies_down_have_scales_of_their_own():
    wave = np.sin(np.linspace(0, 6, 50)).reshape(5, 10)
    slow = colours.scales_of([wave, 0.5 * wave])
    assert slow[0] == slow[1]
    own = colours.scales_of([wave, 0.01 * wave, np.zeros_like(wave)])
    assert all(scale.is_diverging for scale in own)
    assert [scale.high for scale in own] == pytest.approx(
        [np.abs(wave).max(), 0.01 * np.abs(wave).max(), np.abs(wave).max()]
    )


def test_maps_show_every_state_and_no_more_than_is_seen(tmp_path):
    of, solution = pictures(tmp_path, {"name": "klein_gordon"}, t_end=1.0)
    figure, _ = drawn(of["space_time_u"], "dark")
    mesh = figure.axes[0].collections[0]
    assert np.array_equal(np.reshape(mesh.get_array(), (20, 17)), solution.values("u", np.arange(17)).T)
    assert of["space_time_u"].what == "u in space and time" and of["profiles_u"].what == "u at some times"
    assert maps.every_seen(maps.MOST_CELLS) == 1 and 5000 / maps.every_seen(5000) <= maps.MOST_CELLS
    assert np.array_equal(
        solution.values("u", np.array([3, 5, 16]), 4), solution.values("u", np.array([3, 5, 16]))[:, ::4]
    )


def test_a_grid_of_one_point_along_an_axis_is_shown():
    ax = plt.figure().subplots()
    mesh = maps.image(ax, np.array([2.0]), np.arange(3.0), np.arange(3.0)[None], colours.Scale(0, 2, False))
    assert np.ptp(mesh.get_coordinates(), axis=(0, 1)).min() > 0 and ax.get_xlim() == (1.5, 2.5)


def test_thinning_keeps_peaks_and_ends():
    t = np.arange(100001) * 0.01
    y = np.sin(0.7 * t)
    y[54321], y[100] = 9.0, np.nan
    x, kept = curves.thinned((t, y))
    assert len(x) < 4000 and kept.max() == 9.0 and (x[0], x[-1]) == (t[0], t[-1]) and (np.diff(x) > 0).all()


def test_thinning_leaves_out_what_is_not_finite_and_nothing_else():
    t = np.arange(10000.0)
    y = np.sin(t)
    y[:5000] = np.nan
    x, kept = curves.thinned((t, y))
    assert np.isfinite(kept).sum() > 500
    y = np.sin(t)
    y[2000:3000], y[9000] = np.nan, 50.0
    assert np.nanmax(curves.thinned((t, y))[1]) == 50.0


def test_a_warning_stands_below_however_many_lines_a_title_has():
    for letters in (10, 60, 200):
        with style.on(style.GROUNDS["light"]):
            figure = plt.figure()
            figure.subplots()
            style.title(figure, "word " * (letters // 5), "failed at t = 3")
            figure.canvas.draw()
            title, warning = (text.get_window_extent() for text in (figure._suptitle, figure.texts[-1]))
            lines = figure._suptitle.get_text().count("\n")
            assert warning.y1 <= title.y1 - 0.85 * (title.height * lines / (lines + 1)) and title.x1 <= figure.bbox.x1


def test_a_title_breaks_no_equation():
    for width in np.linspace(1, 4, 20):
        figure = plt.figure(figsize=(width, 1))
        style.title(figure, "Chain of masses, seisav, h = 2⁻⁶: energy", "")
        assert "h = 2⁻⁶" in figure._suptitle.get_text().replace("\u00a0", " ")
        plt.close(figure)


def test_legends_cover_no_curve_that_fills_its_axes_and_stay_in_the_figure(tmp_path):
    of, _ = pictures(tmp_path, {"name": "oscillator", "alpha": 0.0, "gamma": 0.0}, t_end=30.0)
    truss, _ = pictures(tmp_path / "truss", {"name": "truss", "amplitude": 0.2}, t_end=0.5)
    for picture in (of["fields"], of["portrait_q_p"], truss["bars"]):
        with style.on(style.GROUNDS["light"], {"figure.figsize": (2.4, 1.7)}):
            figure = plt.figure()
            picture.draw(figure)
            figure.canvas.draw()
            (ax,) = figure.axes
            box = ax.get_legend().get_window_extent()
        assert box.x0 >= 0 and box.x1 <= figure.bbox.x1 and box.y0 >= 0
        ends = ax.transData.transform([[0, np.nanmax(line.get_ydata())] for line in ax.lines])[:, 1]
        assert picture.stem == "bars" or box.y0 > ends.max()


def test_numbers_of_points_do_not_overlap_in_a_small_picture():
    with style.on(style.GROUNDS["light"]):
        figure = plt.figure(figsize=(2.2, 1.6))
        ax = figure.subplots()
        field = curves.Field("u", "displacement", np.ones((5, 32)))
        curves.profiles(ax, np.arange(5), ("point", np.arange(1, 33)), field)
        figure.canvas.draw()
        low, high = ax.get_xlim()
        shown = [tick.label1.get_window_extent() for tick in ax.xaxis.get_major_ticks() if low <= tick.get_loc() <= high]
    assert len(shown) > 1 and all(a.x1 < b.x0 for a, b in zip(shown, shown[1:]))


def test_a_title_stands_at_the_same_place_on_both_grounds(tmp_path, monkeypatch):
    places = []
    pictures(tmp_path, {"name": "sine_gordon", "points": [6, 6], "length": [1.0, 1.0]}, t_end=0.5)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(plt, "close", lambda figure: places.append(figure._suptitle.get_position()))
    drawing = render._Draw(request(tmp_path / "run", formats=["png"], films=[]))
    drawing.do(("picture", [one.stem for one in drawing.studio.pictures].index("slices_u"), ""))
    assert len(places) == 2 and places[0] == pytest.approx(places[1])


def test_planes_go_through_the_middle_of_a_box(tmp_path):
    problem = {
        "name": "sine_gordon",
        "points": [4, 6, 8],
        "length": [4.0, 4.0, 4.0],
        "initial": {"u": "x + 10*y + 100*z", "v": "0"},
    }
    of, solution = pictures(tmp_path, problem, t_end=0.0625)
    x, z, values = solution.plane("u", 0, 0, 2)
    y = solution.axes[1][1][3]
    assert np.allclose(values, x[:, None] + 10 * y + 100 * z[None, :])
    figure, _ = drawn(of["planes_u"])
    assert [ax.get_title(loc="left") for ax in figure.axes[:6]] == ["$t$ = 0", "$t$ = 0.0625"] * 3
    assert films.frames(solution).tolist() == [0, 1]


def described(series, x_log=True, y_log=True, powers=True, slope=True):
    def axis(log, powers=False):
        return {"label": "a", "log": log, "powers_of_two": powers, "limits": None}

    look = {
        "colour": "#0072B2",
        "marker": "circle",
        "filled": True,
        "dash": "solid",
        "width": 1.0,
        "layer": 0,
        "marked": None,
    }
    all_series = [look | {"label": label, "x": list(x), "y": list(y)} for label, (x, y) in series.items()]
    axes = {"x": axis(x_log, powers), "y": axis(y_log)}
    return {"stem": "p", "title": "title", "caption": "Caption.", "series": all_series, "slope": slope} | axes


H = 2.0 ** -np.arange(5, 9)


def test_a_line_of_slope_two_lies_below_all_curves():
    ax = plt.figure().subplots()
    assert curve_pictures.draw(ax, described({"a": (H, 3 * H**2), "b": (H, 0.01 * H**1.5)})) == ""
    slope, *lines = ax.lines
    x, y = slope.get_data()
    assert np.log(y[1] / y[0]) / np.log(x[1] / x[0]) == pytest.approx(2)
    for line in lines:
        assert (np.interp(np.log(line.get_xdata()), np.log(x), np.log(y)) < np.log(line.get_ydata())).all()
    ax.figure.canvas.draw()
    assert [tick.get_text() for tick in ax.get_xticklabels()] == ["2⁻⁸", "2⁻⁷", "2⁻⁶", "2⁻⁵"]


def test_zeros_stand_on_a_line_below_all_other_values_and_the_rest_is_left_out():
    bad = [0.0, -1.0, float("nan"), float("inf"), 5e-324, 1e308]
    ax = plt.figure().subplots()
    said = curve_pictures.draw(
        ax, described({"a": (H, 3 * H**2), "b": ([0.25] * 7, [*bad, 1e-3]), "none": ([], [])}, slope=False)
    )
    assert "What is exactly zero stands on the line 0" in said
    line, b = ax.lines[0].get_ydata()[0], ax.lines[2].get_ydata()
    assert b[0] == line < min(3 * H.min() ** 2, 1e-3) and np.isnan(b[1:6]).all() and b[6] == 1e-3
    assert "0" in [text.get_text() for text in ax.texts]
    for nothing in ({}, {"a": ([0.1], [0.0])}, {"a": ([-1.0], [1.0]), "b": ([1.0], [-1.0])}):
        for powers in (True, False):
            figure = plt.figure()
            assert curve_pictures.draw(figure.subplots(), described(nothing, powers=powers)) == ""
            figure.canvas.draw()


def test_round_off_does_not_fill_an_axis():
    for values, low, high in ((0.05 + 1e-16 * np.arange(4), 0, 0.055), (-1 - 1e-15 * np.arange(4), -1.1, 0)):
        ax = plt.figure().subplots()
        curve_pictures.draw(ax, described({"a": (H, values)}, y_log=False, slope=False))
        assert ax.get_ylim() == pytest.approx((low, high))


def test_curves_that_hide_one_another_are_told_apart_and_named():
    ax = plt.figure().subplots()
    curves_of = {"a": (H, 3 * H**2), "b, c": (H, 1.01 * H**2), "d": (H, H**2)}
    said = curve_pictures.draw(ax, described(curves_of, slope=False))
    assert said.endswith("the first of them the widest: “b, c” and d.")
    a, b, d = ax.lines
    assert b.get_linewidth() > 2 * d.get_linewidth() and d.get_zorder() > b.get_zorder() and a.get_linewidth() == 1
    ax = plt.figure().subplots()
    assert "All curves coincide" in curve_pictures.draw(
        ax, described({"a": (H, H**2), "d": (H, H**2)}, slope=False)
    )


def test_text_of_others_is_text_and_no_formula():
    for text in ("100 $", r"$\frac{ a_b", "a_b^c {y} \\"):
        figure = plt.figure()
        curve_pictures.draw(figure.subplots(), described({text: (H, H), "b": (H, 9 * H)}))
        style.title(figure, text, text)
        figure.canvas.draw()


def request(run, **more):
    history = {"H": [[0, 1], [1, 0.5]], "modified": None, "causes": []}
    return {
        "solution": str(run / "solution.h5"),
        "title": "title",
        "warning": "",
        "history": history,
        "formats": ["png", "svg"],
    } | more


def program(what, folder):
    return subprocess.run(
        [sys.executable, "-B", Path(render.__file__).parent],
        input=json.dumps(what),
        cwd=folder,
        text=True,
        capture_output=True,
    )


def test_a_process_that_dies_ends_the_drawing(tmp_path, monkeypatch):
    pictures(tmp_path, {"name": "oscillator"}, t_end=0.5)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0, 1})
    monkeypatch.setattr(render._Draw, "picture", lambda *_: os._exit(9))
    monkeypatch.setattr(render, "_end_with_parent", lambda: None)
    with pytest.raises(RuntimeError, match="terminated abruptly"):
        render.draw(request(tmp_path / "run"))


def test_the_program_draws_what_it_is_asked_for_and_the_same_bytes_each_time(tmp_path):
    pictures(tmp_path, {"name": "oscillator"}, t_end=0.5)
    files = []
    for into in (tmp_path / "one", tmp_path / "two"):
        into.mkdir()
        assert program(request(tmp_path / "run", warning="failed at t = 3"), into).returncode == 0
        reply = json.loads((into / "reply.json").read_text())
        assert [one["stem"] for one in reply["pictures"]] == ["energy", "fields", "portrait_q_p"]
        assert reply["pictures"][0]["title"] == "title: energy; failed at t = 3" and reply["films"] == []
        files.append({file.name: file.read_bytes() for file in into.iterdir()})
    assert files[0] == files[1]
    assert {"energy.png", "energy.svg", "energy_dark.png"} <= set(files[0]) and "energy_dark.svg" not in files[0]
    assert b"failed at t = 3" in files[0]["energy.svg"]
    wrong = program(request(tmp_path / "run", palette="vridis"), tmp_path)
    assert wrong.returncode == 2 and wrong.stderr == "unknown --palette 'vridis'; did you mean 'viridis'?\n"
