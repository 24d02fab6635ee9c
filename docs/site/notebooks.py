"""Tutorials as Jupyter notebooks, made from their pages and run.

A sh block becomes a cell of bash, a toml block one that writes its file, a python block one as it stands. A text block
has to be what the cell before it prints. Commands of `make` stay text. Cells of their own write the cases of the
sources that a page runs, so that a notebook needs nothing but the program and the Python package.
"""
import json
import re
import subprocess
import sys
import tempfile

import run_blocks

TUTORIALS = ("first_run", "damping", "python", "certificate", "choosing_a_method", "your_own_potential")
PICTURES = {"first_run.png": "out/wave/figures/space_time_u.png"}  # of a page: what its blocks have drawn
NEEDS = """
This is a page of Seiche's documentation as a notebook. It needs the program `seiche` on the PATH and the Python package
`seiche`. Its cells, run in their order, write files into the folder of the notebook.
"""
LINK = re.compile(r"(?<!!)\[([^\]]+)\]\((?!\w+://)[^)\s]+\)")  # to a page that is not beside the notebook
PICTURE = re.compile(r"^!\[[^\]]*\]\(([^)\s]+)\)\n", re.MULTILINE)
STRICT = "set -eo pipefail; exec 2>&1\n"  # for every bash, as run_blocks.py calls it
NBCONVERT = (
    "-m nbconvert --to notebook --execute --allow-errors --inplace --log-level=ERROR "
    f"--ExecutePreprocessor.record_timing=False --ExecutePreprocessor.timeout={run_blocks.SECONDS} "
    "--Exporter.preprocessors=nbconvert.preprocessors.coalescestreams.coalesce_streams"
).split()
CASE = re.compile(r"\bcases/[\w-]+\.toml\b")


def imports_seiche(page):
    return re.search(r"^import seiche\b", page.read_text(encoding="utf-8"), re.MULTILINE) is not None


def source_of(block):
    """The cell that a block becomes; None where it stays text."""
    if block.language == "toml":
        return f"%%writefile {run_blocks.file_of(block)}\n{block.text}"
    if block.language == "sh" and not run_blocks.is_make(block):
        return f"%%bash\n{block.text}"
    return block.text if block.language == "python" else None


def of_page(text):
    """The notebook of a page before its run; of each cell the block that it is, and that of what it has to print."""
    import nbformat.v4

    cells, origins, by_index, cases = [], [], {}, []

    def add(new_cell, source, block=None):
        cells.append(new_cell(source.strip("\n"), id=f"cell-{len(cells) + 1}"))
        origins.append([block, None])

    def add_text(text):
        for index, part in enumerate(PICTURE.split(text)):
            if index % 2:
                add(nbformat.v4.new_code_cell, f'from IPython.display import Image\nImage("{PICTURES[part]}")')
            elif part.strip():
                add(nbformat.v4.new_markdown_cell, LINK.sub(r"\1", part))

    lines, end, prose = text.splitlines(keepends=True), 0, ""
    for index, block in enumerate(run_blocks.blocks_of(text)):
        prose += "".join(lines[end : block.line - 1])
        after = block.line + block.text.count("\n") + 1
        source = source_of(block)
        if block.language == "text":
            origins[by_index[block.follows]][1] = block
        elif source is None:
            prose += "".join(lines[block.line - 1 : after])
        else:
            add_text(prose)
            prose = ""
            for case in dict.fromkeys(CASE.findall(block.text)):
                if case in cases:
                    continue
                if not cases:
                    add(nbformat.v4.new_code_cell, "%mkdir -p cases")
                text_of_case = (run_blocks.SOURCE / case).read_text(encoding="utf-8")
                add(nbformat.v4.new_code_cell, f"%%writefile {case}\n{text_of_case}")
                cases.append(case)
            by_index[index] = len(cells)
            add(nbformat.v4.new_code_cell, source, block)
        end = after
    add_text(prose + "".join(lines[end:]))
    cells[0].source = cells[0].source.replace("\n", "\n" + NEEDS, 1)
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    metadata = {"kernelspec": kernel, "language_info": {"name": "python"}}
    return nbformat.v4.new_notebook(cells=cells, metadata=metadata), origins


def check(source, outputs, block, shown, places):
    """Throws Mistake where a cell failed, printed one of these places of this machine, or not what the page shows."""
    line = f"line {block.line}: " if block else ""
    printed = "".join(output.get("text", "") for output in outputs)
    errors = [f"{output['ename']}: {output['evalue']}" for output in outputs if output["output_type"] == "error"]
    if errors:
        last = printed.rstrip().split("\n")[-1] if source.startswith("%%bash") else ""
        raise run_blocks.Mistake(f"{line}a cell of the notebook fails: {last or errors[0]}")
    everything = json.dumps(outputs, ensure_ascii=False)
    if any(str(place) in everything for place in (*places, tempfile.gettempdir() + "/")):
        raise run_blocks.Mistake(f"{line}a cell of the notebook prints a path of this machine: {printed}")
    if shown:
        try:
            run_blocks.compare(shown, printed)
        except run_blocks.Mistake as mistake:
            raise run_blocks.Mistake(f"line {shown.line}: {mistake}") from None


def run(page, program, package, folder):
    """The notebook of a page in JSON, after its run in this folder; throws Mistake with the line of the block."""
    import nbformat

    notebook, origins = of_page(page.read_text(encoding="utf-8"))
    environment = run_blocks.environment_in(folder, program) | {
        "BASH_ENV": str(folder / ".bin/strict"),
        "IPYTHONDIR": str(folder / ".bin"),
        "JUPYTER_NO_CONFIG": "1",
        "PYTHONPATH": str(package),
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    (folder / ".bin/strict").write_text(STRICT, encoding="utf-8")
    file = folder / f"{page.stem}.ipynb"  # nbconvert runs it in its folder
    nbformat.write(notebook, file)
    done = subprocess.run(
        [sys.executable, *NBCONVERT, file],
        **{"cwd": folder, "env": environment, "stdin": subprocess.DEVNULL, "capture_output": True, "text": True},
    )
    if done.returncode:
        raise run_blocks.Mistake(f"nbconvert fails: {done.stderr.strip()[-500:]}")
    notebook.cells = nbformat.read(file, as_version=4).cells
    for cell, (block, shown) in zip(notebook.cells, origins):
        if cell.cell_type == "code":
            check(cell.source, cell.outputs, block, shown, (folder, run_blocks.SOURCE))
    return nbformat.writes(notebook)
