#!/usr/bin/python3
"""Draws the picture of a page of the gallery from the folder of its run: draw.py NAME DIRECTORY PICTURE.png

Beside it comes PICTURE_dark.png, the same on a dark ground.

`seiche plot` draws what every run has; here are the views that belong to one system each: the energies of modes, a section
through an attractor, curves that symmetry makes equal. Needs gnuplot and python3-h5py.
"""
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import h5py

SOURCE = pathlib.Path(__file__).resolve().parents[3]


def palettes():
    """The colours of `seiche plot`, from low to high values: {"viridis": ["#440154", …], "vik": …, "berlin": …}."""
    text = (SOURCE / "seiche/figure/plot/rendering.cpp").read_text(encoding="utf-8")
    found = re.findall(r"constexpr std::array (\w+) = \{(.*?)\};", text, re.DOTALL)
    return {name: re.findall(r"#[0-9A-F]{6}", colours) for name, colours in found}


class Ground:
    """Colours of a picture, those that `seiche plot` has on this ground (docs/conventions.md)."""

    def __init__(self, suffix, paper, ink, grid, colours, diverging, time):
        self.suffix, self.paper, self.ink, self.grid, self.colours = suffix, paper, ink, grid, colours
        self.palettes = {"sequential": PALETTES["viridis"], "diverging": PALETTES[diverging], "time": time}


def palette(colours):
    return "set palette defined (" + ", ".join(f"{i} '{colour}'" for i, colour in enumerate(colours)) + ") maxcolors 0\n"


PALETTES = palettes()
GROUNDS = (  # time along a curve: viridis without the end that would vanish on the ground
    Ground("", "#FFFFFF", "#202020", "#E0E0E0", ["#0072B2", "#D55E00", "#117733", "#AA4499", "#E69F00", "#707070"],
           "vik", PALETTES["viridis"][:-2]),
    Ground("_dark", "#15181C", "#E6E8EA", "#363C44", ["#4FA8DC", "#F08A4B", "#55B678", "#D98CCB", "#F0B84A", "#A3ABB4"],
           "berlin", PALETTES["viridis"][3:]),
)


def solution(directory):
    """t and the fields, each a row of its points for every time (rows of all axes one after the other)."""
    with h5py.File(os.path.join(directory, "solution.h5")) as file:
        others = {"t", "x", "y", "z", "H", "H_modified", "mesh"}
        return list(file["t"]), {name: [row.ravel().tolist() for row in file[name]] for name in file if name not in others}


class Picture:
    def __init__(self, path, ground, width=900, height=560):
        """Twice as fine as it is wide on a page, for fine screens."""
        self.folder = tempfile.TemporaryDirectory()
        self.ground = ground
        ink = ground.ink
        self.script = [f"set terminal pngcairo size {2 * width},{2 * height} font 'DejaVu Sans,12' fontscale 2 linewidth 2.4 "
                       f"pointscale 2 background rgb '{ground.paper}'",
                       f"set output '{path.with_stem(path.stem + ground.suffix)}'",
                       f"set encoding utf8\nset border 3 lc rgb '{ink}'\nset tics nomirror out textcolor rgb '{ink}'",
                       f"set key noautotitle textcolor rgb '{ink}'\nset title textcolor rgb '{ink}'",
                       *(f"set {axis}label textcolor rgb '{ink}'" for axis in ("x", "y", "cb")),
                       f"set cbtics textcolor rgb '{ink}'"]

    def add(self, text):
        self.script.append(text)

    def data(self, rows):
        """A file with these rows, and an empty line for an empty row."""
        name = os.path.join(self.folder.name, f"{len(os.listdir(self.folder.name))}.txt")
        with open(name, "w") as file:
            file.writelines(" ".join(f"{number:.9g}" for number in row) + "\n" for row in rows)
        return name

    def map(self, t, rows, x, label, place="{/:Italic x}", sequential=False, largest=None):
        """Colours over time and place, up to the largest entry if not told; beyond it the bar has pointed ends."""
        least, most = min(min(row) for row in rows), max(max(row) for row in rows)
        largest = largest or max(-least, most)
        low = 0 if sequential else -largest
        colours = self.ground.palettes["sequential" if sequential else "diverging"]
        self.add(palette(colours) + f"set cbrange [{low}:{largest}]\nset cblabel '{label}'\nset xlabel '{{/:Italic t}}'\n"
                 f"set ylabel '{place}'\nset xrange [{t[0]}:{t[-1]}]\nset yrange [{x[0]}:{x[-1]}]\n")
        left, width, bottom, top, point = 0.86, 0.025, 0.17, 0.95, 0.04  # of the bar, in parts of the picture
        self.add(f"set tmargin at screen {top}\nset bmargin at screen {bottom}\nset rmargin at screen 0.84\n")
        for beyond, base, tip, colour in ((most > largest, top - point, top, colours[-1]),
                                          (least < low, bottom + point, bottom, colours[0])):
            if beyond:
                self.add(f"set object polygon from screen {left},{base} to screen {left + width},{base} to screen {left + width / 2},{tip} "
                         f"to screen {left},{base} front fillcolor rgb '{colour}' fillstyle solid border lc rgb '{self.ground.ink}' lw 0.5")
        top, bottom = top - point * (most > largest), bottom + point * (least < low)
        self.add(f"set colorbox user origin screen {left},{bottom} size screen {width},{top - bottom} front")
        name = self.data([(time, place, entry) for time, row in zip(t, rows) for place, entry in zip(x, row)])
        self.add(f"plot '{name}' using 1:2:3 with image")

    def lines(self, curves, smooth=""):
        """Curves are (x, y, number of the colour, title)."""
        parts = [f"'{self.data(zip(x, y))}' {smooth} with lines lw 1.6 lc rgb '{self.ground.colours[colour]}' title '{title}'"
                 for x, y, colour, title in curves]
        self.add("plot " + ", ".join(parts))

    def draw(self):
        with self.folder:
            subprocess.run(["gnuplot"], input="\n".join(self.script), text=True, check=True)


def column(rows, index=0):
    return [row[index] for row in rows]


def pendulum(t, fields, path, ground):
    picture = Picture(path, ground)
    picture.add("set xlabel 'angle q / π'\nset ylabel 'velocity p'\nset cblabel 't'\nset grid lc rgb '%s'\n" % ground.grid + palette(ground.palettes["time"]))
    name = picture.data(zip([q / math.pi for q in column(fields["q"])], column(fields["p"]), t))
    picture.add(f"plot '{name}' using 1:2:3 with lines lw 1.8 lc palette")
    picture.draw()


def duffing_section(t, fields, path, ground):
    picture = Picture(path, ground)
    picture.add("set xlabel 'displacement q'\nset ylabel 'velocity p'\n")
    first = 20  # periods in which the start is forgotten
    name = picture.data(zip(column(fields["q"])[first:], column(fields["p"])[first:]))
    picture.add(f"plot '{name}' with points pt 7 ps 0.3 lc rgb '{ground.colours[0]}'")
    picture.draw()


def beta_fpu(t, fields, path, ground):
    bonds = len(fields["u"][0]) + 1

    def energy_of_mode(k, u, v):
        weights = [math.sqrt(2 / bonds) * math.sin(math.pi * j * k / bonds) for j in range(1, bonds)]
        amplitude, velocity = (sum(w * entry for w, entry in zip(weights, row)) for row in (u, v))
        return 0.5 * (velocity**2 + (2 * math.sin(math.pi * k / (2 * bonds)) * amplitude)**2)

    picture = Picture(path, ground)
    picture.add("set xlabel 't'\nset ylabel 'energy of a mode'\nset key outside right title 'mode'\n")
    picture.lines([(t, [energy_of_mode(k, u, v) for u, v in zip(fields["u"], fields["v"])], n, k)
                   for n, k in enumerate((1, 3, 5, 7))])
    picture.draw()


def kdv_soliton(t, fields, path, ground):
    points = len(fields["u"][0])
    picture = Picture(path, ground)
    picture.add("set xlabel 'x'\nset ylabel 'u'\nset xrange [0:40]\nset samples 800\nset key top right title 't'\n")
    chosen = [round(i * (len(t) - 1) / 4) for i in range(5)]
    x = [40 * j / points for j in range(1, points + 1)]
    picture.lines([(x, fields["u"][n], i, f"{t[n]:g}") for i, n in enumerate(chosen)],
                  "smooth csplines")
    picture.draw()


def nls(t, fields, path, ground):
    points = len(fields["p"][0])
    modulus = [[math.hypot(p, q) for p, q in zip(*rows)] for rows in zip(fields["p"], fields["q"])]
    picture = Picture(path, ground)
    picture.map(t, modulus, [40 * j / points for j in range(1, points + 1)], "|ψ|", sequential=True)
    picture.draw()


def network(t, fields, path, ground):
    nodes = len(fields["u"][0])
    distance = [0] + [1 if node in (1, 4, 5) else 2 for node in range(1, nodes)]  # from node 1 of Petersen's graph
    picture = Picture(path, ground)
    picture.add("set xlabel 't'\nset ylabel 'displacement'\nset key top right title 'distance' horizontal\n")
    titles = set()
    curves = []
    for node, far in enumerate(distance):
        curves.append((t, column(fields["u"], node), far, "" if far in titles else far))
        titles.add(far)
    picture.lines(curves)
    picture.draw()


def toda(t, fields, path, ground):
    picture = Picture(path, ground)
    picture.map(t, fields["v"], list(range(1, len(fields["v"][0]) + 1)), "velocity", place="mass", largest=1.2)
    picture.draw()


def whitham(t, fields, path, ground):
    picture = Picture(path, ground)
    points = len(fields["u"][0])
    picture.map(t, fields["u"], [100 * j / points for j in range(1, points + 1)], "elevation u", largest=0.08)
    picture.draw()


def henon_heiles(t, fields, path, ground):
    picture = Picture(path, ground, 1000, 400)
    picture.add("set multiplot layout 1,3 margins 0.075,0.985,0.2,0.87 spacing 0.07,0\nset xtics 0.4\nset ytics 0.4\n"
                "set xrange [-0.75:0.75]\nset yrange [-0.6:0.9]\nset xlabel 'q₁'\nset ylabel 'q₂'")
    for i, (begin, end) in enumerate(((0, 60), (150, 210), (340, 400))):
        chosen = [n for n, time in enumerate(t) if begin <= time <= end]
        picture.add(f"set title '{begin} ≤ t ≤ {end}'")
        picture.lines([([fields["q1"][n][0] for n in chosen], [fields["q2"][n][0] for n in chosen], i, "")])
    picture.draw()


DRAWN = {function.__name__: function for function in (pendulum, duffing_section, beta_fpu, kdv_soliton, nls, network,
                                                      toda, whitham, henon_heiles)}

if __name__ == "__main__":
    name, directory, path = sys.argv[1:]
    t, fields = solution(directory)
    for ground in GROUNDS:
        DRAWN[name](t, fields, pathlib.Path(path), ground)
