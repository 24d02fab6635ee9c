#!/usr/bin/python3
"""Puts the pages together and makes the site: build.py PROGRAM

Pages of docs/site and the other documents of docs/ go to build/docs_pages. The pages of the gallery are played
(test/documentation/run_blocks.py), and their pictures drawn from what their runs left. The reference is asked of the program. Then
mkdocs, Debian's version with a theme of its own, makes build/docs. Nothing is downloaded.
"""
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
import run_blocks  # noqa: E402


FILMED = {"klein_gordon_ring": "output.snapshot_every=8"}  # its run again with more states
PLOTTED = {"sine_gordon_kinks": "space_time_u", "klein_gordon_ring": "slices_u"}  # by `seiche plot`, the others by draw.py


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


def add_first_run(program):
    with tempfile.TemporaryDirectory() as work:
        run = play(SITE / "tutorials/first_run.md", program, work) / "out/wave"
        both_grounds(run, "space_time_u", PAGES / "tutorials/first_run.png")


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
    add_first_run(program)
    add_gallery(program)
    switch_pictures(PAGES)
    if subprocess.run(["mkdocs", "build", "--clean", "-q", "-f", SOURCE / "docs/mkdocs.yml"]).returncode != 0:
        sys.exit(1)  # it has said what is wrong
    (SOURCE / "build/docs/reference").mkdir(exist_ok=True)
    subprocess.run(["doxygen", "docs/Doxyfile"], cwd=SOURCE, check=True)
    check_site.check(SOURCE / "build/docs")


if __name__ == "__main__":
    main()
