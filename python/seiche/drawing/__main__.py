"""Draws what the request on standard input asks for; `seiche plot` writes it.

{"formats": ["png", …], "grounds": ["light", "dark"], "width": inches, "journal": whether without titles, "progress": whether
someone looks on}, and of a run {"run": its folder, "title": of all, "warning": below it, "history": its energies, "films":
the fields, or null for the first, "range": [low, high], "centre": number, "palette": name}, or else {"pictures": what
curve_pictures describes}. Pictures appear in the working
directory, and what was drawn is in reply.json beside them.
"""

from __future__ import annotations

import importlib.util
import json
import pathlib
import sys
import warnings

_BAD_REQUEST, _MISSING = 2, 3  # exit codes


def main() -> int:
    request = json.load(sys.stdin)
    missing = [name for name in ("numpy", "matplotlib", "h5py") if importlib.util.find_spec(name) is None]
    if missing:
        packages = " ".join(f"python3-{name}" for name in missing)
        print(
            f"{sys.executable} has no {', '.join(missing)}: pictures are drawn by Matplotlib (Debian packages {packages})",
            file=sys.stderr,
        )
        return _MISSING
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
    from drawing import render

    warnings.simplefilter("ignore")  # what remains to be said is an error

    try:
        reply = render.draw(request)
    except render.BadRequest as error:
        print(error, file=sys.stderr)
        return _BAD_REQUEST
    except (OSError, ValueError, KeyError, RuntimeError) as error:
        print(f"{type(error).__name__}: {error}", file=sys.stderr)
        return 1
    pathlib.Path("reply.json").write_text(json.dumps(reply), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
