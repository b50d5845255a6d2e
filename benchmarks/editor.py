"""Cost of an edit in a file of 500 lines, as the language server does it, beside the bare parse of that file by lark.

The file is made of the shipped library; each edit changes a number in the middle of it. Then the shipped library for
wiping is edited with its scenes: a body, a signature and a scene. Run it as `python benchmarks/editor.py [LINES]`; it
prints for each answer the median in milliseconds and its ratio to the parse.
"""

from __future__ import annotations

import shutil
import sys
from collections.abc import Callable, Iterator
from functools import partial
from itertools import count
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from time import process_time

from _one_file import one_file

from skillc.lsp import diagnostics as problems
from skillc.lsp.libraries import FileView, Libraries
from skillc.services.library.files import SHIPPED
from skillc_compiler.ide import highlighting
from skillc_compiler.ide.annotations.hints import Hint, find_hints
from skillc_compiler.ide.annotations.lenses import find_lenses
from skillc_compiler.ide.completion import complete
from skillc_compiler.ide.descriptions import find_hover
from skillc_dsl.parsing.making import make_parser
from skillc_dsl.parsing.tables import grammar_text
from skillc_ontology.catalogue import scene_path

EDITS = 15
_EDITED = "0.25 m/s"


def main() -> None:
    """Print one line for each answer."""
    text = one_file(int(sys.argv[1]) if len(sys.argv) > 1 else 500)
    with TemporaryDirectory() as folder:
        measure(text, Path(folder) / "library" / "all.skill")
        measure_scenes(Path(folder) / "wiping")


def measure(text: str, file: Path) -> None:
    """Measure edits of a text in the editor; the first one is not counted."""
    libraries, numbers = Libraries((file.parent,)), count(26)
    file.parent.mkdir()
    uri = file.as_uri()

    def edit() -> None:
        libraries.write(uri, text.replace(_EDITED, f"0.{next(numbers)} m/s"))

    def find_problems() -> None:
        view = libraries.view(uri)
        problems.diagnostics_by_uri(libraries, view.root, view.analysis, libraries.problems_around(view.root), "utf-16")

    def highlight() -> None:
        view = libraries.view(uri)
        highlighting.highlight_words(view.analysis, view.path)

    def show_hints(view: FileView) -> Iterator[Hint]:
        rows = range(1, text.count("\n") + 2)
        return find_hints(view.analysis, view.path, rows, libraries.choices(view, rows))

    middle = text[: text.index("target: above")].count("\n") + 1
    parser = make_parser(grammar_text())
    bare = median(_seconds(lambda: parser.parse(text)) for _ in range(EDITS))
    answers: list[tuple[str, Callable[[], object]]] = [
        ("problems after an edit", find_problems),
        ("colours, then", highlight),
        ("hints of all lines, then", lambda: list(show_hints(libraries.view(uri)))),
        ("lenses, then", lambda: list(find_lenses(libraries.names(file)[1], "all.skill"))),
        ("completion, then", lambda: complete(libraries.view(uri).analysis, "all.skill", middle, 16)),
        ("hover, then", lambda: find_hover(libraries.view(uri).analysis, "all.skill", middle, 10)),
    ]
    taken: dict[str, list[float]] = {name: [] for name, _ in answers}
    for _ in range(EDITS + 1):
        edit()
        for name, answer in answers:
            taken[name].append(_seconds(answer))
    print(f"{text.count(chr(10))} lines, {len(libraries.view(uri).analysis.problems)} problems")
    print(f"{'':28} {'ms':>7} {'ratio':>6}")
    print(f"{'lark parse alone':28} {bare * 1e3:7.1f} {1.0:6.2f}")
    for name, seconds in taken.items():
        print(f"{name:28} {median(seconds[1:]) * 1e3:7.1f} {median(seconds[1:]) / bare:6.2f}")


def measure_scenes(folder: Path) -> None:
    """Measure edits in a library with scenes, which are checked each time; the first two are not counted."""
    shutil.copytree(SHIPPED / "wiping", folder)
    shutil.copy(scene_path("iiwa_table.ttl"), folder)
    for name, old, new in (
        ("strokes.skill", "blend: 5 mm", "blend: 5.{} mm"),
        ("wipe.skill", "duration 40 s", "duration 40.{} s"),
        ("iiwa_table.ttl", "\n", "# {}\n"),
    ):
        libraries, text = Libraries((folder,)), (folder / name).read_text("utf-8")
        root = libraries.root(folder / name)

        def find_problems(number: int) -> None:
            libraries.write((folder / name).as_uri(), text.replace(old, new.format(number), 1))  # noqa: B023
            around = libraries.problems_around(root)  # noqa: B023
            problems.diagnostics_by_uri(libraries, root, libraries.analysis(root), around, "utf-16")  # noqa: B023

        taken = [_seconds(partial(find_problems, number)) for number in range(EDITS + 2)]
        print(f"{f'with scenes, in {name}':28} {median(taken[2:]) * 1e3:7.1f}")


def _seconds(work: Callable[[], object]) -> float:
    start = process_time()
    work()
    return process_time() - start


if __name__ == "__main__":
    main()
