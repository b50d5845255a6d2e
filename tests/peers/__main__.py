"""`python -m peers LOADER..`: all trees that are made here, through loaders that `make peers` has built."""

from __future__ import annotations

import argparse
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

import shipped

from accept import built, cases
from fuzz.kinds.trees import draw_library
from matrix.case import cases as features
from peers.comparing import differences
from skillc_compiler.emit import bt
from skillc_compiler.emit.bt.names import BUILT_IN
from skillc_compiler.pipeline import compile


def main() -> int:
    """Say which trees are refused or run otherwise than they should, and which names are not known; return 1 if any."""
    parser = argparse.ArgumentParser(prog="peers", description=__doc__)
    parser.add_argument("loaders", nargs="+", type=Path)
    parser.add_argument("--random", type=int, default=100, help="how many random libraries to try")
    options = parser.parse_args()
    loaders = [each.resolve() for each in options.loaders]
    problems = [words for each in loaders for words in _unknown_names(each)]
    with TemporaryDirectory() as folder:
        trees = dict(_trees(options.random, Path(folder)))
        for name, text in trees.items():
            path = Path(folder) / f"{name}.xml"
            path.write_text(text, "utf-8")
            problems += differences(path, loaders)
    print(*problems, f"{len(trees)} trees, {len(problems)} problems", sep="\n")
    return 1 if problems or not trees else 0


def _unknown_names(binary: Path) -> list[str]:
    """Return what a version of the library registers and the compiler does not know."""
    run = subprocess.run([binary, "--registered"], capture_output=True, text=True, check=True)
    return [f"{binary} registers {each}" for each in run.stdout.split() if each not in BUILT_IN]


def _trees(randoms: int, folder: Path) -> Iterator[tuple[str, str]]:
    libraries = {name: _of_library(name) for name in ("wiping", "contact")}
    libraries |= {
        case.name: {path: text for path, text in built(case).items() if path[-4:] == ".xml"} for case in cases()
    }
    for feature in features():
        library, errors = feature.library()
        libraries[feature.name] = {} if errors else bt.emit(library)
    for number in range(randoms):
        libraries[f"random{number}"] = bt.emit(draw_library(Random(number), folder))
    for name, trees in libraries.items():
        yield from ((f"{name}.{Path(path).stem}", text) for path, text in trees.items())


def _of_library(name: str) -> dict[str, str]:
    return bt.emit(compile(shipped.library(name), shipped.vocabulary(), shipped.shelf(), name).value)


if __name__ == "__main__":
    sys.exit(main())
