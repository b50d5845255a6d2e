"""`python -m behaviour save DIR [--only KIND ..]`, `python -m behaviour compare BEFORE AFTER`.

`compare` exits with 1 if anything differs.
"""

from __future__ import annotations

import argparse
import json
import shutil
import sys
import time
from pathlib import Path
from tempfile import TemporaryDirectory

import skillc
from behaviour.comparing import ABOUT, compare, missing
from behaviour.kinds import kind_names, load_kind
from behaviour.product import CASES, Product


def main() -> int:
    """Save or compare, as the command line says."""
    options = _options()
    if options.action == "compare":
        return _compare(options.before, options.after)
    for kind in options.only or kind_names():
        began = time.monotonic()
        _save(kind, options.folder)
        print(f"{kind}: {time.monotonic() - began:.0f} s", file=sys.stderr, flush=True)
    return 0


def _save(kind: str, saved: Path) -> None:
    """Save one kind in place of what was saved of it before, and note where its files were."""
    checkout = Path(skillc.__file__).parents[2]
    with TemporaryDirectory(prefix="behaviour-") as work:
        unfinished = Path(work, "saved")
        unfinished.mkdir()
        (folder := Path(work, "work")).mkdir()
        load_kind(kind).save(Product(folder), unfinished)
        saved.mkdir(parents=True, exist_ok=True)
        shutil.rmtree(saved / kind, ignore_errors=True)
        shutil.move(unfinished, saved / kind)
    about = saved / ABOUT
    known = json.loads(about.read_text("utf-8")) if about.exists() else {}
    roots = {str(checkout): "checkout", str(CASES.parent): "checkout", str(folder): "work"}
    about.write_text(json.dumps({**known, kind: {"roots": roots}}, indent=2), encoding="utf-8")


def _compare(before: Path, after: Path) -> int:
    found = compare(before, after)
    for kind, lines in found.items():
        print(f"{kind}: {'same' if not lines else ''}", *lines, sep="\n    ")
    for kind in missing(before, after):
        print(f"{kind}: saved in one of both only")
    return 1 if not found or any(found.values()) else 0


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="behaviour", description=__doc__)
    actions = parser.add_subparsers(dest="action", required=True)
    save = actions.add_parser("save", help="save what the product on PYTHONPATH does")
    save.add_argument("folder", type=Path)
    save.add_argument(
        "--only", nargs="+", choices=kind_names(), help="these kinds; by default all, which takes an hour"
    )
    comparing = actions.add_parser("compare", help="compare what was saved")
    comparing.add_argument("before", type=Path)
    comparing.add_argument("after", type=Path)
    return parser.parse_args()


if __name__ == "__main__":
    sys.exit(main())
