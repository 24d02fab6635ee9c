#!/usr/bin/python3
"""Puts the pages together and makes the site: build.py PROGRAM

Pages of docs/site and the other documents of docs/ go to build/docs_pages. The pages of the gallery are played
(test/documentation/run_blocks.py), and their pictures drawn from what their runs left. At the same time tutorials are
run as notebooks (notebooks.py), with the Python package that lies beside the program. The reference is asked of the
program. Then mkdocs, Debian's version with a theme of its own, makes build/docs. Nothing is downloaded.
"""
import concurrent.futures
import html
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SITE = pathlib.Path(__file__).resolve().parent
SOURCE = SITE.parents[1]
PAGES = SOURCE / "build/docs_pages"
VERIFICATION_ROWS = SOURCE / "build/verification_rows.md"  # of the last whole run of `make verify`, minutes long
NO_ROWS = "# Verification: every row\n\n`make verify` writes the rows; it had not run where these pages were made.\n"
sys.dont_write_bytecode = True
sys.path[:0] = [str(SOURCE / "test/documentation"), str(SITE)]
import check_site  # noqa: E402
import notebooks  # noqa: E402
import run_blocks  # noqa: E402


FILMED = {"klein_gordon_ring": "output.snapshot_every=8", "pfhub_1a": "output.snapshot_every=100",
          "phase_field_crystal": "output.snapshot_every=40"}  # its run again with more states
PLOTTED = {"sine_gordon_kinks": "space_time_u", "klein_gordon_ring": "slices_u", "pfhub_1a": "slices_u",
           "phase_field_crystal": "slices_u"}  # by `seiche plot`, the others by draw.py


def both_grounds(run, name, picture):
    """A picture of `seiche plot`, for light and for dark ground."""
    for ground in ("", "_dark"):
        shutil.copy(run / f"figures/{name}{ground}.png", picture.with_stem(picture.stem + ground))


def dark(path):
    """The picture for dark ground, which stands beside that for light."""
    path = pathlib.PurePosixPath(path)
    return path.with_stem(path.stem + "_dark")


def shown(path, alt):
    """Both pictures in HTML, of which the page shows one; PATH is from the page."""
    return "".join(f'<img class="on-{ground}" src="{file}" alt="{html.escape(alt)}" loading="lazy">'
                   for ground, file in (("light", path), ("dark", dark(path))))


def switch_pictures(pages):
    """Every ![alt](picture.png) on the pages in this folder becomes a picture for both grounds, which must be there."""
    for page in pages.rglob("*.md"):
        def switched(marker):
            for name in (marker.group(2), dark(marker.group(2))):
                if not (page.parent / name).is_file():
                    sys.exit(f"{page}: there is no {name}")
            return shown(marker.group(2), marker.group(1))

        text = page.read_text(encoding="utf-8")
        page.write_text(re.sub(r"!\[([^\]]*)\]\(([^)\s]+\.png)\)", switched, text), encoding="utf-8")


def play(page, program, work):
    """The folder in which the blocks of a page have run."""
    directory = pathlib.Path(work) / page.stem
    try:
        run_blocks.play(page, program, directory)
    except run_blocks.Mistake as mistake:
        sys.exit(f"{page}, {mistake}")
    return directory


def film(program, work, name, setting):
    """HTML of the film of a case in the plane, for both grounds."""
    run = pathlib.Path(work) / f"film_{name}"
    subprocess.run([program, "run", SOURCE / f"cases/{name}.toml", "--quiet", "--out", run, "--set", setting], check=True)
    subprocess.run([program, "plot", run, "--format", "png"], check=True, stdout=subprocess.DEVNULL)
    files = [next((run / "figures").glob(f"film_u{ground}.*")) for ground in ("", "_dark")]
    for file in files:
        shutil.copy(file, PAGES / "gallery" / file.name.replace("film_u", name))
    shown_by = {True: '<video class="on-{}" src="{}" controls loop muted preload="metadata"></video>',
                False: '<img class="on-{}" src="{}" alt="film">'}  # a picture that moves, without ffmpeg
    films = (shown_by[file.suffix in (".mp4", ".webm")].format(ground, file.name.replace("film_u", name))
             for ground, file in zip(("light", "dark"), files))
    return f'<div class="film">{"".join(films)}</div>'


def add_gallery(program):
    cards = []
    with tempfile.TemporaryDirectory() as work:
        for page in sorted((SITE / "gallery").glob("*.md")):
            text = page.read_text(encoding="utf-8")
            if page.stem == "index":
                continue
            print(f"gallery: {page.stem}", flush=True)
            run = play(page, program, work) / "out" / page.stem
            picture = PAGES / "gallery" / f"{page.stem}.png"
            if page.stem in PLOTTED:
                both_grounds(run, PLOTTED[page.stem], picture)
            else:
                subprocess.run([sys.executable, SITE / "gallery/draw.py", page.stem, run, picture], check=True)
            if page.stem in FILMED:
                shown_there = PAGES / "gallery" / page.name
                shown_there.write_text(shown_there.read_text(encoding="utf-8").replace(
                    "<!-- film -->", film(program, work, page.stem, FILMED[page.stem])), encoding="utf-8")
            title = text.split("\n", 1)[0].lstrip("# ")
            cards.append(f'<a href="{page.stem}.html">{shown(picture.name, "")}<br>{title}</a>\n')
    index = PAGES / "gallery/index.md"
    index.write_text(index.read_text(encoding="utf-8").replace("<!-- cards -->", f'<div class="gallery">\n{"".join(cards)}</div>'),
                     encoding="utf-8")


def show_files():
    """<!-- file: cases/toda.toml --> on a page becomes the file, so that nothing is written twice."""
    def file_of(marker):
        path = SOURCE / marker.group(1)
        return f"`{marker.group(1)}`:\n\n```{path.suffix[1:]}\n{path.read_text(encoding='utf-8')}```\n"

    for page in PAGES.rglob("*.md"):
        text = page.read_text(encoding="utf-8")
        page.write_text(re.sub(r"<!-- file: (\S+) -->\n", file_of, text), encoding="utf-8")


def add_notebook(name, program, package):
    """Runs a tutorial as a notebook, beside the pages, and keeps the pictures that its page shows."""
    page = SITE / f"tutorials/{name}.md"
    with tempfile.TemporaryDirectory() as work:
        folder = pathlib.Path(work) / name
        try:
            made = notebooks.run(page, program, package, folder)
        except run_blocks.Mistake as mistake:
            sys.exit(f"{page}, {mistake}")
        (PAGES / f"notebooks/{name}.ipynb").write_text(made, encoding="utf-8")
        for picture, drawn in notebooks.PICTURES.items():
            if f"({picture})" in page.read_text(encoding="utf-8"):
                both_grounds((folder / drawn).parents[1], pathlib.Path(drawn).stem, PAGES / "tutorials" / picture)


def start_notebooks(program, pool):
    """The runs of all notebooks, which have begun, and links to them on their pages."""
    package = program.parent / "python"
    names = [name for name in notebooks.TUTORIALS
             if run_blocks.has_package(package) or not notebooks.imports_seiche(SITE / f"tutorials/{name}.md")]
    if len(names) < len(notebooks.TUTORIALS):
        print(f"notebooks: {', '.join(names)} alone, since the others need the Python package (make python)", flush=True)
    (PAGES / "notebooks").mkdir()
    for name in names:
        page = PAGES / f"tutorials/{name}.md"
        link = f'[Download this page as a notebook](../notebooks/{name}.ipynb){{ .notebook download="" }}'
        page.write_text(page.read_text(encoding="utf-8").replace("\n", f"\n\n{link}\n", 1), encoding="utf-8")
    return [pool.submit(add_notebook, name, program, package) for name in names]


def add_project():
    """The documents of the repository, which know nothing of the site."""
    (PAGES / "project/decisions").mkdir(parents=True)
    pages = {document: document.name for document in SOURCE.glob("docs/*.md")}
    pages |= {document: f"decisions/{document.name}" for document in SOURCE.glob("docs/decisions/*.md")}
    for document, page in {**pages, SOURCE / "CHANGELOG.md": "changelog.md"}.items():
        text = document.read_text(encoding="utf-8")
        # A list that follows its sentence without an empty line is one for GitHub, and not for mkdocs.
        text = re.sub(r"(?m)^(?!\s*[-|]|\s*\d+\.\s|\s*$)(.*)\n(?=(?:- |1\. ))", r"\1\n\n", text)
        (PAGES / "project" / page).write_text(text, encoding="utf-8")
    rows = VERIFICATION_ROWS.read_text(encoding="utf-8") if VERIFICATION_ROWS.is_file() else NO_ROWS
    (PAGES / "project/verification_rows.md").write_text(rows, encoding="utf-8")


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    shutil.rmtree(PAGES, ignore_errors=True)
    shutil.copytree(SITE, PAGES, ignore=shutil.ignore_patterns("*.py", "__pycache__", "overrides"))
    show_files()
    add_project()
    subprocess.run([sys.executable, SITE / "reference.py", program, PAGES / "reference"], check=True)
    with concurrent.futures.ThreadPoolExecutor(1) as pool:
        runs = start_notebooks(program, pool)
        add_gallery(program)
    for run in runs:
        run.result()
    switch_pictures(PAGES)
    if subprocess.run(["mkdocs", "build", "--clean", "-q", "-f", SOURCE / "docs/mkdocs.yml"]).returncode != 0:
        sys.exit(1)  # it has said what is wrong
    (SOURCE / "build/docs/reference").mkdir(exist_ok=True)
    subprocess.run(["doxygen", "docs/Doxyfile"], cwd=SOURCE, check=True)
    check_site.check(SOURCE / "build/docs")


if __name__ == "__main__":
    main()
