"""What mkdocs does beside turning Markdown into pages: typeset formulas, and a search that works from the disk."""
import html
import json
import os
import pathlib
import re
import subprocess

FORMULA = re.compile(r'<(span|div) class="arithmatex">\\([(\[])(.*?)\\[)\]]</\1>', re.DOTALL)
KATEX = """
const katex = require("katex");
const formulas = JSON.parse(require("fs").readFileSync(0, "utf8"));
const set = ([text, displayMode]) =>
  katex.renderToString(text, { displayMode, output: "mathml", strict: "ignore", trust: false });
try {
  console.log(JSON.stringify(formulas.map(set)));
} catch (error) {
  console.error(error.message);
  process.exit(1);
}
"""


ACCENTED = re.compile(r'<mover accent="true"><mi[^>]*>([A-Za-z])</mi><mo[^>]*>(.)</mo></mover>')
COMBINING = {"˙": "\u0307", "¨": "\u0308", "^": "\u0302", "ˉ": "\u0304", "¯": "\u0304", "~": "\u0303"}


def one_character(match):
    """A letter with its accent, in italics: without a font for mathematics browsers put the accent into the letter."""
    letter = match[1]
    italic = 0x210E if letter == "h" else ord(letter) + (0x1D434 - ord("A") if letter <= "Z" else 0x1D44E - ord("a"))
    return f"<mi>{chr(italic)}{COMBINING[match[2]]}</mi>" if match[2] in COMBINING else match[0]


def mathml(formulas):
    """MathML of [TeX, whether it stands on a line of its own], by KaTeX. Raises on TeX that it does not understand."""
    made = subprocess.run(["node", "-e", KATEX], input=json.dumps(formulas), capture_output=True, text=True,
                          env={**os.environ, "NODE_PATH": "/usr/share/nodejs"})
    if made.returncode != 0:
        raise SystemExit(made.stderr.strip()[-500:])
    without_source = re.compile(r"<annotation.*?</annotation>", re.DOTALL)  # the search would find it
    return [ACCENTED.sub(one_character, without_source.sub("", text)) for text in json.loads(made.stdout)]


def on_page_content(page_html, page, config, files):
    formulas = [[html.unescape(match.group(3)), match.group(2) == "["] for match in FORMULA.finditer(page_html)]
    if not formulas:
        return page_html
    try:
        typeset = iter(mathml(formulas))
    except SystemExit as error:
        raise SystemExit(f"{page.file.src_path}: {error}") from None
    return FORMULA.sub(lambda match: next(typeset), page_html)


def on_post_build(config):
    """The index as a script as well: a page that was opened from the disk may not read other files."""
    folder = pathlib.Path(config["site_dir"]) / "search"
    index = (folder / "search_index.json").read_text(encoding="utf-8")
    (folder / "search_index.js").write_text(f"var __search = {{ index: Promise.resolve({index}) }};\n", encoding="utf-8")
