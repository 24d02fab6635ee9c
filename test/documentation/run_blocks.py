#!/usr/bin/env python3
"""Runs what the documentation shows, and compares what it says it prints.

    run_blocks.py --program build/release/seiche [--python build/release/python] [--work DIR] [PAGE.md ...]

Every page (by default README.md and all of docs/site) is played from top to bottom in a fresh directory that has `seiche` on its
PATH and as build/release/seiche, and the repository's cases/ beside it. A fenced block is, by its language,

    toml   a file: its first line is a comment with its name, # wave.toml
    sh     run by bash, stopping at the first command that fails; a block of `make` commands alone is asked of `make -n`
    python goes on with the Python blocks above it on its page, with the package `seiche` that --python has. Without --python
           these blocks are left out, and counted
    text   what the sh or python block just before it printed, on stdout and stderr together. A number agrees to one unit of its last digit
           shown, an integer exactly; … stands for any text within a line, and alone on a line for any lines
    cpp    the whole text of a program in examples/ or test/package/, which are compiled elsewhere; cmake likewise

<!-- file: cases/toda.toml --> is where the site shows that file. Anything else is a mistake. Exit code 0: all pages do what they
say; 1: the first mistake of each page, with its line, is on stderr; 2: there is no package where --python says.
"""
import argparse
import dataclasses
import os
import pathlib
import re
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w])")
ANY_NUMBER = r"([-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?)"
SECONDS = 300  # no block takes a tenth of it: what is not over then, hangs


class Mistake(Exception):
    pass


@dataclasses.dataclass
class Block:
    language: str
    line: int  # of its fence, from 1
    text: str
    follows: int = -1  # index of the block just before, if no more than a sentence stands between


def blocks_of(text):
    blocks, language, begin, lines, between, margin = [], None, 0, [], 0, ""
    for number, line in enumerate(text.splitlines(), 1):
        if language is None and line.lstrip(" ").startswith("```"):  # indented in a tab
            margin = line[:line.index("`")]
            language, begin, lines = line.strip()[3:].strip(), number, []
            continue
        line = line.removeprefix(margin) if language is not None else line
        if language is not None and line.startswith("```"):
            just_before = len(blocks) - 1 if between < 4 else -1
            blocks.append(Block(language, begin, "".join(entry + "\n" for entry in lines), just_before))
            language, between = None, 0
        elif language is not None:
            lines.append(line)
        elif line.strip():
            between += 1
    if language is not None:
        raise Mistake(f"line {begin}: the block is not closed")
    return blocks


def unit_of_last_digit(number):
    digits, _, exponent = number.lower().partition("e")
    decimals = len(digits.partition(".")[2])
    return 10.0 ** (int(exponent or 0) - decimals) if "." in number or exponent else 0.0


def line_agrees(shown, printed):
    pattern, numbers, end = "", [], 0
    for found in NUMBER.finditer(shown):
        pattern += _text_pattern(shown[end:found.start()]) + ANY_NUMBER
        numbers.append(found.group())
        end = found.end()
    match = re.fullmatch(pattern + _text_pattern(shown[end:]), printed.rstrip())
    return match is not None and all(abs(float(given) - float(said)) <= 1.0001 * unit_of_last_digit(said)
                                     for said, given in zip(numbers, match.groups()))


def _text_pattern(text):
    return ".*?".join(r"\s+".join(map(re.escape, re.split(r"\s+", part))) for part in text.split("…"))


def first_difference(shown, printed):
    """How many lines of `shown` agree, and the first that does not: None where all do."""
    if not shown:
        return 0, (None if not printed else "(nothing more)")
    if shown[0].strip() == "…":
        rest = [first_difference(shown[1:], printed[skipped:]) for skipped in range(len(printed) + 1)]
        agreeing = [entry for entry in rest if entry[1] is None]
        return agreeing[0] if agreeing else max(rest, key=lambda entry: entry[0])
    if not printed or not line_agrees(shown[0].rstrip(), printed[0]):
        return 0, shown[0]
    agree, line = first_difference(shown[1:], printed[1:])
    return agree + 1, line


def file_of(block):
    """The name of the file that a toml block is."""
    named = re.match(r"#\s*([\w.-]+\.toml)\b", block.text)
    if not named:
        raise Mistake("a toml block begins with the name of its file, as in  # wave.toml")
    return named.group(1)


def is_make(block):
    """Whether a sh block has commands of `make` alone."""
    lines = [line for line in block.text.splitlines() if line.strip()]
    return bool(lines) and all(line.startswith("make ") for line in lines)


def compare(block, printed):
    """A text block with what was printed."""
    _, line = first_difference(block.text.splitlines(), printed.splitlines())
    if line is not None:
        raise Mistake(f"not printed:\n{line}\nbut this was:\n{printed}")


def run_shell(block, directory, environment):
    if is_make(block):
        for line in filter(str.strip, block.text.splitlines()):
            done = subprocess.run(["bash", "-c", line.split("#")[0].replace("make ", "make -n ", 1)], cwd=SOURCE, text=True,
                                  env=environment, capture_output=True)
            if done.returncode:
                raise Mistake(f"{line}\n{done.stderr}")
        return None
    try:
        done = subprocess.run(["bash", "-e", "-o", "pipefail", "-c", block.text], cwd=directory, env=environment, text=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=SECONDS)
    except subprocess.TimeoutExpired:
        raise Mistake(f"takes longer than {SECONDS} s") from None
    if done.returncode:
        raise Mistake(f"exit code {done.returncode} of\n{block.text}{done.stdout}")
    return done.stdout


def has_package(directory):
    return any(pathlib.Path(directory).glob("seiche/_core.*so"))


def run_python(blocks, directory, environment, package):
    """What the last of these blocks prints, after the others."""
    mark = "the last block begins"
    script = "\n".join(block.text for block in blocks[:-1]) + f"\nprint({mark!r}, flush=True)\n" + blocks[-1].text
    done = subprocess.run([sys.executable, "-c", script], cwd=directory, text=True, stdin=subprocess.DEVNULL, timeout=SECONDS,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          env={**environment, "PYTHONPATH": str(pathlib.Path(package).resolve()), "PYTHONDONTWRITEBYTECODE": "1"})
    if done.returncode:
        raise Mistake(f"exit code {done.returncode} of\n{blocks[-1].text}{done.stdout}")
    return done.stdout.split(mark + "\n", 1)[1]


def check_program(block):
    names = {"cpp": "*.cpp", "cmake": "CMakeLists.txt"}[block.language]
    programs = [*SOURCE.glob(f"examples/{names}"), *SOURCE.glob(f"test/package/{names}")]
    if not any(path.read_text(encoding="utf-8") == block.text for path in programs):
        raise Mistake("this is not the text of a file in examples/ or test/package/, so nothing compiles it")


def environment_in(directory, program):
    """The environment of commands in this folder, with the program on their PATH."""
    path = directory / ".bin"
    path.mkdir(parents=True)
    (path / "seiche").symlink_to(pathlib.Path(program).resolve())
    return {**os.environ, "PATH": f"{path}:{os.environ['PATH']}", "NO_COLOR": "1", "LC_ALL": "C.UTF-8"}


def play(page, program, directory, package=None):
    """Runs the blocks of a page in a directory, and says how many and how many were left out; throws Mistake with the line."""
    directory = pathlib.Path(directory)
    environment = environment_in(directory, program)
    built = directory / "build/release"  # where README.md calls it
    built.mkdir(parents=True)
    (built / "seiche").symlink_to(pathlib.Path(program).resolve())
    (directory / "cases").symlink_to(SOURCE / "cases")
    printed, left_out = {}, set()
    text = pathlib.Path(page).read_text(encoding="utf-8")
    for shown in re.findall(r"<!-- file: (\S+) -->", text):  # which the site shows there
        if not (SOURCE / shown).is_file():
            raise Mistake(f"shows {shown}, which is not there")
    blocks = blocks_of(text)
    for index, block in enumerate(blocks):
        try:
            if block.language == "toml":
                (directory / file_of(block)).write_text(block.text, encoding="utf-8")
            elif block.language == "sh":
                printed[index] = run_shell(block, directory, environment)
            elif block.language == "python":
                if package:
                    above = [entry for entry in blocks[:index + 1] if entry.language == "python"]
                    printed[index] = run_python(above, directory, environment, package)
                else:
                    left_out.add(index)
            elif block.language in ("cpp", "cmake"):
                check_program(block)
            elif block.language == "text" and block.follows in left_out:
                left_out.add(index)
            elif block.language != "text":
                raise Mistake(f"a block of '{block.language}' is not one that is run: toml, sh, python, text, cpp or cmake")
            elif printed.get(block.follows) is None:
                raise Mistake("no sh or python block just before it that would print this")
            else:
                compare(block, printed[block.follows])
        except Mistake as mistake:
            raise Mistake(f"line {block.line}: {mistake}") from None
    return len(blocks) - len(left_out), len(left_out)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--program", required=True, help="the program `seiche`")
    arguments.add_argument("--python", help="the folder that has the Python package")
    arguments.add_argument("--work", help="keep what the pages make here, in a folder for each")
    arguments.add_argument("pages", nargs="*", type=pathlib.Path)
    options = arguments.parse_args()
    if options.python and not has_package(options.python):
        arguments.error(f"{options.python} has no compiled package seiche; leave --python out to leave its blocks out")
    pages = options.pages or [SOURCE / "README.md", *sorted((SOURCE / "docs/site").rglob("*.md"))]
    mistakes = count = left_out = 0
    with tempfile.TemporaryDirectory() as scratch:
        for page in pages:
            try:
                work = pathlib.Path(options.work or scratch) / page.parent.name / page.stem
                run, left = play(page, options.program, work, options.python)
                count, left_out = count + run, left_out + left
            except Mistake as mistake:
                mistakes += 1
                print(f"{page}, {mistake}", file=sys.stderr)
    print(f"{count} blocks on {len(pages)} pages, {mistakes} pages with a mistake"
          + (f"; {left_out} blocks left out for want of --python" if left_out else ""))
    return 1 if mistakes or not count else 0


if __name__ == "__main__":
    sys.exit(main())
