"""Draws what the request on standard input asks for; `seiche plot` writes it.

{"formats": ["png", …], "grounds": ["light", "dark"], "width": inches, "journal": whether without titles, "progress":
whether someone looks on}, and of a run {"solution": its solution.h5, "title": of all, "warning": below it, "history": its energies,
"films": the fields, or null for the first, "range": [low, high], "ranges": {field: [low, high], …} of single fields,
"centre": number, "palette": name}, or else {"pictures": what curve_pictures describes}. Pictures appear in the working
directory, and what was drawn is in reply.json beside them.
"""

import importlib.util
import json
import pathlib
import sys
import warnings

_BAD_REQUEST, _MISSING = 2, 3  # exit codes
_OLDEST_PYTHON, _OLDEST_MATPLOTLIB = (3, 9), (3, 6)


def _lack():
    """What this interpreter lacks, or ""."""
    if sys.version_info < _OLDEST_PYTHON:
        return "is older than Python 3.9"
    missing = [name for name in ("numpy", "matplotlib", "h5py") if importlib.util.find_spec(name) is None]
    if missing:
        packages = " ".join("python3-" + name for name in missing)
        return "has no " + ", ".join(missing) + ": pictures are drawn by Matplotlib (Debian packages " + packages + ")"
    try:
        import h5py  # noqa: F401
        import matplotlib
    except ImportError as error:
        return "cannot load what draws: {}".format(error)
    if matplotlib.__version_info__[:2] < _OLDEST_MATPLOTLIB:
        return "has Matplotlib {}, and 3.6 is needed".format(matplotlib.__version__)
    return ""


def main():
    lack = _lack()
    if lack:
        print(sys.executable, lack, file=sys.stderr)
        return _MISSING
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
    from drawing import render

    warnings.simplefilter("ignore")  # what remains to be said is an error
    try:
        reply = render.draw(json.load(sys.stdin.buffer))
    except render.BadRequest as error:
        print(error, file=sys.stderr)
        return _BAD_REQUEST
    except Exception as error:
        print("{}: {}".format(type(error).__name__, error), file=sys.stderr)
        return 1
    pathlib.Path("reply.json").write_text(json.dumps(reply), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
