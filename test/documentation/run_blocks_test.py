#!/usr/bin/env python3
"""The test of the documentation sees what it should: a wrong digit, a missing line, a block that nothing runs. And the site has
its pictures for light and for dark ground."""
import importlib.util
import json
import math
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import types
import unittest
import zlib

import run_blocks

SITE = run_blocks.SOURCE / "docs/site"
sys.dont_write_bytecode = True
sys.path[:0] = [str(SITE), str(SITE / "gallery")]
import build  # noqa: E402
import check_site  # noqa: E402
import hooks  # noqa: E402
import notebooks  # noqa: E402
import reference  # noqa: E402


class Pages(unittest.TestCase):
    def play(self, text, package=None):
        with tempfile.TemporaryDirectory() as directory:
            page = pathlib.Path(directory) / "page.md"
            page.write_text(text, encoding="utf-8")
            return run_blocks.play(page, "/bin/true", pathlib.Path(directory) / "work", package)[0]

    def mistake(self, text, package=None):
        with self.assertRaises(run_blocks.Mistake) as caught:
            self.play(text, package)
        return str(caught.exception)

    def printing(self, printed, shown):
        return f"```sh\nprintf '{printed}'\n```\n\n```text\n{shown}\n```\n"

    def test_numbers_agree_to_the_digits_shown(self):
        for shown in ("H 1.2346 after 7 steps", "H 1.235 after 7 steps", "H 1.23… after 7 steps", "H … after 7 steps"):
            self.assertEqual(self.play(self.printing("H 1.23456 after 7 steps\\n", shown)), 2)
        for shown in ("H 1.2366 after 7 steps", "H 1.2346 after 8 steps", "H 1.2346 after 7", "G 1.2346 after 7 steps"):
            self.assertIn("line 5: not printed:\n" + shown, self.mistake(self.printing("H 1.23456 after 7 steps\\n", shown)))

    def test_exponents_count_as_digits(self):
        self.play(self.printing("error 3.456e-09\\n", "error 3.5e-09"))
        self.mistake(self.printing("error 3.456e-09\\n", "error 3.5e-08"))

    def test_lines_may_be_left_out_only_where_the_page_says_so(self):
        self.play(self.printing("a\\nb\\nc\\nd\\n", "a\n…\nd"))
        self.assertIn("not printed:\nc", self.mistake(self.printing("a\\nb\\nd\\n", "a\n…\nc")))
        self.assertIn("(nothing more)", self.mistake(self.printing("a\\nb\\n", "a")))

    def test_commands_must_succeed_unless_the_page_catches_them(self):
        self.assertIn("exit code 3", self.mistake("```sh\n(exit 3)\n```\n"))
        self.play("```sh\n(exit 3) || echo \"exit code $?\"\n```\n\n```text\nexit code 3\n```\n")

    def test_every_block_is_run_or_refused(self):
        self.assertIn("block of 'ruby'", self.mistake("```ruby\nputs 1\n```\n"))
        self.assertIn("no sh or python block just before", self.mistake("```text\nH\n```\n"))
        self.assertIn("begins with the name of its file", self.mistake("```toml\n[problem]\n```\n"))
        self.assertIn("nothing compiles it", self.mistake("```cpp\nint main() {}\n```\n"))
        self.assertIn("is not closed", self.mistake("```sh\ntrue\n"))
        self.assertIn("No rule to make target", self.mistake("```sh\nmake papper\n```\n"))

    def test_blocks_in_tabs_are_played_as_well(self):
        tab = '=== "Shell"\n\n    ```sh\n    printf 5\n    ```\n\n    ```text\n    %d\n    ```\n'
        self.play(tab % 5)
        self.assertIn("5", self.mistake(tab % 6))

    def test_python_goes_on_with_the_blocks_above_and_is_left_out_without_the_package(self):
        page = "```python\nx = 1\nprint('first')\n```\n\n```python\nprint('x is', x)\n```\n\n```text\nx is {}\n```\n"
        self.assertEqual(self.play(page.format(2)), 0)
        with tempfile.TemporaryDirectory() as package:
            (pathlib.Path(package) / "seiche").mkdir()
            (pathlib.Path(package) / "seiche/_core.so").touch()
            self.assertEqual(self.play(page.format(1), package), 3)
            self.assertIn("not printed:\nx is 2", self.mistake(page.format(2), package))

    def test_a_package_that_is_asked_for_has_to_be_there(self):
        with tempfile.TemporaryDirectory() as directory:
            page = pathlib.Path(directory) / "page.md"
            page.write_text("```python\nprint(1)\n```\n\n```sh\ntrue\n```\n", encoding="utf-8")
            command = [sys.executable, run_blocks.__file__, "--program", "/bin/true", str(page)]
            done = subprocess.run(command, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("1 blocks left out for want of --python", done.stdout)
            done = subprocess.run([*command, "--python", directory], capture_output=True, text=True)
            self.assertEqual(done.returncode, 2)
            self.assertIn("has no compiled package seiche", done.stderr)

    def test_the_program_is_where_the_pages_call_it(self):
        self.assertEqual(self.play("```sh\nseiche\nbuild/release/seiche\n```\n"), 1)

    def test_every_page_and_case_of_the_gallery_has_its_place(self):
        site = run_blocks.SOURCE / "docs/site"
        navigation = (run_blocks.SOURCE / "docs/mkdocs.yml").read_text(encoding="utf-8")
        for page in site.rglob("*.md"):
            self.assertRegex(navigation, rf"[-:] {re.escape(str(page.relative_to(site)))}\n")
            if page.parent.name == "gallery" and page.stem != "index":
                text = page.read_text(encoding="utf-8")
                self.assertIn(f"<!-- file: cases/{page.stem}.toml -->", text)
                self.assertEqual("\n<!-- film -->\n" in text, page.stem in build.FILMED)

    def test_the_index_of_decisions_has_every_page(self):
        decisions = run_blocks.SOURCE / "docs/decisions"
        index = (decisions / "README.md").read_text(encoding="utf-8")
        self.assertEqual(re.findall(r"\]\((\d{4}-[a-z-]+\.md)\)", index), sorted(page.name for page in decisions.glob("0*.md")))


class Site(unittest.TestCase):
    def site(self, pages):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        for name, text in pages.items():
            (pathlib.Path(directory.name) / name).write_text(text, encoding="utf-8")
        return pathlib.Path(directory.name)

    def test_a_link_to_nowhere_and_one_to_no_place_are_found(self):
        site = self.site({"a.html": '<a href="b.html">x</a><a href="b.html#there">x</a><a href="#here">x</a><p id="here">'
                                    '<a href="https://example.org/no">x</a><img src="none.png"><a href="b.html#no">x</a>',
                          "b.html": '<p id="there"><a href="c.html">x</a>'})
        self.assertEqual(sorted(check_site.dead_links(site)),
                         ["a.html: b.html#no has no such place", "a.html: none.png leads nowhere", "b.html: c.html leads nowhere"])

    def test_formulas_that_stay_as_dollars_and_ways_out_of_the_site_are_found(self):
        site = self.site({"a.html": '<p>a $ x $ formula</p><pre>$HOME</pre><code>$x$</code><a href="../b.html">x</a>'
                                    '<video poster="none.png"></video>'})
        self.assertEqual(sorted(check_site.dead_links(site)),
                         ["a.html: ../b.html leads nowhere", "a.html: a dollar in the text: 'a $ x $ formula'", "a.html: none.png leads nowhere"])

    def test_formulas_become_mathml_and_those_that_are_none_end_the_build(self):
        if shutil.which("node") is None or not pathlib.Path("/usr/share/nodejs/katex").exists():
            self.skipTest("KaTeX is not installed")
        page = types.SimpleNamespace(file=types.SimpleNamespace(src_path="page.md"))
        text = '<p>a <span class="arithmatex">\\(x &lt; \\tfrac12\\)</span>, <code>$y$</code></p>'
        made = hooks.on_page_content(text, page, None, None)
        self.assertIn("<mfrac>", made)
        self.assertIn("<code>$y$</code>", made)
        self.assertNotIn("annotation", made)
        with self.assertRaisesRegex(SystemExit, r"^page.md: KaTeX parse error: .{1,200}$"):
            hooks.on_page_content('<span class="arithmatex">\\(\\nothing\\)</span>', page, None, None)

    def test_equations_of_the_program_become_tex(self):
        self.assertEqual(reference.tex("u_tt − βu_xxt + ∂_x(σu^{k+1}) = 0, periodic"),
                         r"u_{tt} − βu_{xxt} + ∂_x(σu^{k+1}) = 0, \text{ periodic }")
        self.assertEqual(reference.tex("ż = q̈ + α sin u"), r"\dot z = \ddot q + α \sin u")


class Notebooks(unittest.TestCase):
    def setUp(self):
        if any(importlib.util.find_spec(name) is None for name in ("nbconvert", "ipykernel")):
            self.skipTest("nbconvert or ipykernel is not installed")

    def run_page(self, text):
        """Cells of the notebook of a page."""
        with tempfile.TemporaryDirectory() as directory:
            page = pathlib.Path(directory) / "page.md"
            page.write_text(text, encoding="utf-8")
            return json.loads(notebooks.run(page, "/bin/true", directory, pathlib.Path(directory) / "work"))["cells"]

    def test_every_block_of_a_page_is_in_its_notebook_in_order(self):
        for name in notebooks.TUTORIALS:
            text = (SITE / f"tutorials/{name}.md").read_text(encoding="utf-8")
            notebook, origins = notebooks.of_page(text)
            sources, at, shown = [cell.source for cell in notebook.cells], 0, 0
            for block in run_blocks.blocks_of(text):
                if block.language == "text":
                    shown += 1
                    continue
                while block.text.strip("\n") not in sources[at]:
                    at += 1
                    self.assertLess(at, len(sources), f"{name}, line {block.line}: not in the notebook, or not in order")
            self.assertEqual(sum(printed is not None for _, printed in origins), shown, name)
            self.assertNotRegex("".join(sources), r"\]\(\.|\.md\)|" + re.escape(str(run_blocks.SOURCE)))

    def test_cells_run_and_leave_what_they_print(self):
        cells = self.run_page("# Title\n\nA [page](x.md) with $x$.\n\n```toml\n# a.toml\nh = 1\n```\n\n```sh\nseiche; cat a.toml\necho no >&2\n"
                              "```\n\n```text\n# a.toml\nh = 1\nno\n```\n\n```sh\nmake help\n```\n\n```python\nprint(6 * 7)\n```\n")
        self.assertEqual([cell["cell_type"] for cell in cells], ["markdown", "code", "code", "markdown", "code"])
        self.assertIn("A page with $x$.", "".join(cells[0]["source"]))
        self.assertIn("make help", "".join(cells[3]["source"]))
        self.assertEqual(cells[4]["outputs"], [{"name": "stdout", "output_type": "stream", "text": ["42\n"]}])
        self.assertTrue(all(cell["metadata"] == {} for cell in cells), "no times")

    def test_a_cell_that_fails_ends_the_build(self):
        with self.assertRaisesRegex(run_blocks.Mistake, "^line 7: a cell of the notebook fails: said$"):
            self.run_page("# Title\n\n```python\nx = 1\n```\n\n```sh\necho said >&2; false | cat\necho after\n```\n")

    def test_a_cell_that_prints_something_else_ends_the_build(self):
        def said(source, shown=None, printed="", **error):
            outputs = [{"output_type": "stream", "text": printed}] + ([{"output_type": "error", **error}] if error else [])
            with self.assertRaises(run_blocks.Mistake) as caught:
                notebooks.check(source, outputs, run_blocks.Block("sh", 7, source), shown, ["/home/me"])
            return str(caught.exception)

        self.assertEqual(said("x", ename="NameError", evalue="no x"), "line 7: a cell of the notebook fails: NameError: no x")
        self.assertRegex(said("pwd", printed="/home/me/here"), "^line 7: .* prints a path of this machine: /home/me/here$")
        self.assertEqual(said("echo 5", run_blocks.Block("text", 11, "6\n"), "5\n"), "line 11: not printed:\n6\nbut this was:\n5\n")


class Grounds(unittest.TestCase):
    def test_every_picture_of_a_page_is_dark_where_the_page_is(self):
        with tempfile.TemporaryDirectory() as directory:
            pages = pathlib.Path(directory)
            page = pages / "page.md"
            page.write_text('before ![a "b" & c](drawn/x.png) after\n', encoding="utf-8")
            (pages / "drawn").mkdir()
            (pages / "drawn/x.png").touch()
            with self.assertRaises(SystemExit) as caught:
                build.switch_pictures(pages)
            self.assertIn("there is no drawn/x_dark.png", str(caught.exception))
            (pages / "drawn/x_dark.png").touch()
            build.switch_pictures(pages)
            self.assertEqual(page.read_text(encoding="utf-8"),
                             'before <img class="on-light" src="drawn/x.png" alt="a &quot;b&quot; &amp; c" loading="lazy">'
                             '<img class="on-dark" src="drawn/x_dark.png" alt="a &quot;b&quot; &amp; c" loading="lazy"> after\n')

    def test_pictures_of_the_gallery_are_drawn_for_both_grounds(self):
        try:
            import matplotlib.image
            import numpy as np

            import draw
        except ImportError as missing:
            self.skipTest(str(missing))
        t = np.arange(30) * 14.0
        wave = np.array([[math.sin(i + j) for i in range(12)] for j in range(30)])
        energy = {"t": t, "H": 1 / (1 + t)}
        fields = {name: wave for name in ("p", "q", "u", "v", "q1", "q2", "u1", "u2")}
        run = types.SimpleNamespace(t=t, energy=energy, **fields)
        with tempfile.TemporaryDirectory() as directory:
            for name in draw.DRAWN:
                draw.draw(name, run, pathlib.Path(directory) / f"{name}.png")
                files = [pathlib.Path(directory) / f"{name}{suffix}.png" for suffix in ("", "_dark")]
                corners = [first_pixel(file.read_bytes())[:3] for file in files]
                shades = np.unique(matplotlib.image.imread(files[0])[..., :3].reshape(-1, 3), axis=0)
                self.assertGreater(len(shades), 20, f"{name} shows something")
                self.assertEqual(corners, [(0xFF, 0xFF, 0xFF), (0x15, 0x18, 0x1C)], name)


def first_pixel(png):
    """Of the upper left corner, where every filter leaves the bytes as they are."""
    at, data, kind = 8, b"", 0
    while at < len(png):
        length, name = struct.unpack(">I4s", png[at:at + 8])
        if name == b"IHDR":
            kind = png[at + 17]
        if name == b"IDAT":
            data += png[at + 8:at + 8 + length]
        at += length + 12
    assert kind in (2, 6)  # colours without a palette
    return tuple(zlib.decompress(data)[1:4])


if __name__ == "__main__":
    unittest.main()
