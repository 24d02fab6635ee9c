#!/usr/bin/python3
"""Writes the reference pages from what the program says of itself: reference.py PROGRAM DIRECTORY

Nothing is written twice: methods, problems and backends are those of `seiche list --json`, keys with their defaults, meanings and
bounds are the comments of `seiche new`, options those of `--help`, exit codes the line of docs/site/overview.md.
"""
import ast
import json
import pathlib
import re
import subprocess
import sys
import unicodedata

SOURCE = pathlib.Path(__file__).resolve().parents[2]
CUSTOM = "Explained in [your own potential](../tutorials/your_own_potential.md). What `seiche new custom` prints:\n\n"
LAWS = {"H_modified": "modified energy"}


def ask(program, *arguments):
    return subprocess.run([program, *arguments], capture_output=True, text=True, check=True).stdout


def code(text):
    return f"`{text}`" if text else ""


def table(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "".join("| " + " | ".join(str(entry) for entry in line) + " |\n" for line in lines) + "\n"


def bounds_at_end(text):
    """'meaning (bounds)' as (meaning, bounds): the last parenthesis, when the text ends with it."""
    if not text.endswith(")"):
        return text, ""
    depth = 0
    for index in range(len(text) - 1, -1, -1):
        depth += {")": 1, "(": -1}.get(text[index], 0)
        if depth == 0:
            return text[:index].strip(), text[index + 1:-1]
    return text, ""


def split_comment(line):
    """Value and comment of a line of TOML; a # in quotes is no comment."""
    quoted = False
    for index, character in enumerate(line):
        quoted ^= character == '"'
        if character == "#" and not quoted:
            return line[:index].strip(), line[index + 1:].strip()
    return line.strip(), ""


def keys_of(case):
    """{section: [(key, default, comment, is given only if asked for)]} of a commented case file."""
    sections, section = {}, None
    for line in case.splitlines():
        header = re.fullmatch(r"\[(\w+)\]", line)
        if header:
            section = header.group(1)
            sections[section] = []
            continue
        key = re.match(r"(# )?(\w+) = (.*)", line)
        if section and key:
            value, comment = split_comment(key.group(3))
            sections[section].append([key.group(2), value, comment, bool(key.group(1))])
        elif section and sections[section] and line.startswith("#  "):  # goes on with the comment above
            sections[section][-1][2] += " " + line[1:].strip()
    return sections


def rows_of(keys):
    for key, default, comment, optional in keys:
        yield [code(key), ("none; e.g. " if optional else "") + code(default), escape(comment)]


def bounded_rows(keys):
    for key, default, comment, _ in keys:
        meaning, bounds = bounds_at_end(comment)
        yield [code(key), code(default), escape(meaning), escape(bounds)]


def escape(text):
    return re.sub(r"([|*_])", r"\\\1", text).replace("<", "&lt;")


def tex(equation):
    """Of an equation in Unicode as the program prints it, which KaTeX reads but for indices of several letters, and words."""
    text = re.sub(r"_([A-Za-z]{2,})", lambda match: "_{" + (r"\text{%s}" if len(match[1]) > 3 else "%s") % match[1] + "}", equation)
    text = re.sub(r"(?<![\w{\\])(sin|cos|exp)(?!\w)", r"\\\1", text)
    text = re.sub(r"(?<![\w{\\])((?:at|by|with|and|both|ends|periodic|formulas)(?: (?:at|by|with|and|both|ends|formulas))*)(?!\w)",
                  r"\\text{ \1 }", text)
    for accent, command in (("\u0307", "dot"), ("\u0308", "ddot")):
        text = re.sub(rf"([A-Za-z]){accent}", rf"\\{command} \1", unicodedata.normalize("NFD", text))
    return unicodedata.normalize("NFC", text).replace(",  ", ",\\quad ").replace("Σ", r"\sum ")


def methods(program):
    entries = json.loads(ask(program, "list", "methods", "--json"))
    columns = ("order", "law", "closure", "propagator", "composition", "projection", "reference")
    rows = [[code(m["name"]), *("" if m[column] is None else LAWS.get(m[column], m[column]) for column in columns)] for m in entries]
    return ("# Methods\n\n`method.name = …`, or `\"auto\"`. *Law*: the energy that never grows, where `seiche check` promises a law. "
            "*Projection*: the strongest law that the end of a step is moved to; `method.law` can ask for a weaker one. "
            "What closure, propagator and composition are says [Theory](../theory.md).\n\n"
            + table(["name", "order", "law", "closure", "propagator", "composition", "projection", "source"], rows))


OF_THE_PAPER = {
    "klein_gordon": " `paper` is $u = \\tanh(\\sqrt2\\,x)/\\sqrt5$, $v = -3\\sqrt2/(10\\sqrt5)\\,\\operatorname{sech}^2(\\sqrt2\\,x)$, "
                    "which jumps where a periodic grid closes, so that $H\\Delta x$ grows with the number of points.",
    "alpha_fpu": " `paper` is a function of the grid index, which does not meet $u = 0$ at the right end.",
    "gkdv": " `paper` is $u = 0.4\\,e^{-(x - L/2)^2/2}$.",
}


def problems(program):
    text = "# Problems\n\n`problem.name = …`. `seiche new NAME` prints a case file with these keys.\n\n"
    for problem in json.loads(ask(program, "list", "problems", "--json")):
        case = ask(program, "new", problem["name"])
        keys = [key for key in keys_of(case)["problem"] if key[0] not in ("name", "friction", "force")]
        text += f"## {problem['title'] or 'Your own'}: `{problem['name']}`\n\n$$\n{tex(problem['equation'])}\n$$\n\n"
        text += f"Source: {problem['reference']}. "
        text += f"Fields {', '.join(map(code, problem['fields']))}; "
        text += f"initial states {', '.join(map(code, problem['initial']))}, a file, or formulas.{OF_THE_PAPER.get(problem['name'], '')}\n\n"
        if problem["name"] == "custom":  # its comments go on from line to line
            section = re.search(r"\[problem\].*?(?=\n# friction)", case, re.DOTALL).group()
            text += CUSTOM + "```toml\n" + section + "\n```\n\n"
        else:
            text += table(["key", "default", "meaning", "allowed"], bounded_rows(keys))
    return text


def case_file(program):
    sections = keys_of(ask(program, "new", "klein_gordon"))
    text = ("# Case files\n\nTOML. Numbers may be fractions in quotes, `\"1/256\"`. A key that does not exist is refused with the nearest one "
            "that does. Defaults of `h`, `end` and `directory` depend on the problem; these are those of `klein_gordon`. The keys of `[problem]` "
            "are on a page of [their own](problems.md), besides these, for every problem with momenta:\n\n")
    extra = [key for key in sections.pop("problem") if key[0] in ("friction", "force")]
    text += table(["key", "default", "meaning"], rows_of(extra))
    for name, keys in sections.items():
        text += f"## [{name}]\n\n" + table(["key", "default", "meaning"], rows_of(keys))
    ensemble = (SOURCE / "cases/klein_gordon_ensemble.toml").read_text(encoding="utf-8")
    text += "## [ensemble]\n\nMany members of one case, side by side. `cases/klein_gordon_ensemble.toml`:\n\n```toml\n" + ensemble + "```\n"
    return text


def backends(program):
    entries = json.loads(ask(program, "list", "backends", "--json"))
    return ("# Backends\n\n`backend.name = …`, or `\"auto\"`. They give the same numbers to round-off.\n\n"
            + table(["name", "what it is"], [[code(b["name"]), b["summary"]] for b in entries]))


def exit_codes():
    overview = (SOURCE / "docs/site/overview.md").read_text(encoding="utf-8")
    line = re.search(r"^Exit codes: (.*?)\.\n\n", overview, re.MULTILINE | re.DOTALL).group(1).replace("\n", " ")
    codes = re.findall(r"(\d+) (.*?)(?:, (?=\d)|$)", line)
    return table(["code", "meaning"], [[code(number), meaning] for number, meaning in codes])


def commands(program):
    top = ask(program, "--help")
    names = re.findall(r"^  (\w+) ", top.split("Subcommands:")[1], re.MULTILINE)
    text = ("# Commands\n\nstdout carries data, and with `--json` exactly one document; everything else goes to stderr.\n\n"
            + "## Exit codes\n\n" + exit_codes() + "## seiche\n\n```text\n" + top.strip() + "\n```\n\n")
    for name in names:
        text += f"## seiche {name}\n\n```text\n{ask(program, name, '--help').strip()}\n```\n\n"
    return text


PYTHON = ("# Python\n\n`import seiche`, after `make python` or `pip install .`. Arrays are NumPy's; states are one row each, "
          "z = (field 0 at all points, field 1 at all points, …). [From Python](../tutorials/python.md) shows how these are used.\n\n")
PYTHON_PARTS = {"State an equation": ["problem", "load", "Problem", "Case"],
                "Solve it": ["solve", "Result", "DenseOutput", "Status", "SeicheWarning"],
                "Step by step": ["Simulation", "StepError"],
                "Many at once": ["solve_ensemble", "EnsembleResult"],
                "Runs that leave files": ["run", "resume", "read", "CaseRun"],
                "Judge": ["check", "spectrum", "converge"],
                "Measure": ["fit", "FitResult"],
                "Pictures": ["plot"]}
LISTS = ["methods", "problems", "backends"]  # compiled: what their docstrings say is said here


def python(_):
    """Of the docstrings in python/seiche. Ends the build where a public name is on no part of the page."""
    tree = ast.parse((SOURCE / "python/seiche/__init__.py").read_text(encoding="utf-8"))
    public = next(ast.literal_eval(node.value) for node in tree.body if isinstance(node, ast.Assign))
    shown = [name for names in PYTHON_PARTS.values() for name in names] + LISTS + ["__version__", "__citation__"]
    if set(shown) != set(public):
        sys.exit(f"reference.py: {set(shown) ^ set(public)} is public and not on the page, or the other way round")
    text = PYTHON
    for title, names in PYTHON_PARTS.items():
        text += f"## {title}\n\n" + "".join(f"::: seiche.{name}\n\n" for name in names)
    return text + ("## Lists\n\n`seiche.methods()`, `seiche.problems()` and `seiche.backends()` return what `seiche list … --json` "
                   "prints, as lists of dictionaries; `seiche.__version__` is a string, and `seiche.__citation__` what to cite, in BibTeX.\n")


HEADERS = {"simulation/solve.hpp": "a whole run, with events and dense output: start here", "simulation/simulation.hpp": "steps of your own",
           "core/problem.hpp": "an equation by its parts", "config/custom/custom_problem.hpp": "an equation by formulas",
           "problem/problems.hpp": "the list of problems", "config/case/case_file.hpp": "a case file",
           "driver/run_case.hpp": "the folder that its run leaves", "simulation/certificate.hpp": "what is proved before a run",
           "ensemble/ensemble.hpp": "many members at once", "output/solution_reader.hpp": "reading `solution.h5`"}


def cpp(_):
    """The way into what doxygen makes of the headers (docs/Doxyfile)."""
    rows = []
    for header, meaning in HEADERS.items():
        name = (SOURCE / "seiche" / header).name.replace("_", "__").replace(".", "_8")
        rows.append([f'<a href="cpp/{name}.html"><code>seiche/{header}</code></a>', meaning])
    return ("# C++\n\n`make install PREFIX=…`, then `find_package(Seiche)`; [As a C++ library](../tutorials/library.md) has the two files of a "
            "program. `#include <seiche/seiche.hpp>` takes most of these at once.\n\n" + table(["header", "for"], rows)
            + '<a href="cpp/index.html">Every header, class and function</a>, as their comments say it.\n')


def main():
    program, directory = sys.argv[1], pathlib.Path(sys.argv[2])
    directory.mkdir(parents=True, exist_ok=True)
    for page in (commands, case_file, problems, methods, backends, python, cpp):
        (directory / f"{page.__name__}.md").write_text(page(program), encoding="utf-8")


if __name__ == "__main__":
    main()
