"""Makes each mistake of docs/mistakes.md in its library: what `skillc check` prints of it, and its picture."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from click.testing import CliRunner
from rich.text import Text

from docs.pages import FENCE, ROOT
from docs.terminal_pictures import draw
from skillc.cli.main import skillc

PAGE = ROOT / "docs/mistakes.md"
PICTURE = ROOT / "docs/pictures/mistakes.svg"
SHOWN = 1
"""The number of the mistake in the picture, a misspelt skill."""


@dataclass(frozen=True, slots=True)
class Mistake:
    """A change of a file of the library, and what the page says is printed after it."""

    file: str
    old: str
    new: str
    printed: str


def read_library(page: str) -> dict[str, str]:
    """Return the files of the library, which the page has."""
    return {found[2]: found[3] for found in FENCE.finditer(page) if found[1] == "skill"}


def read_mistakes(page: str) -> Iterator[Mistake]:
    """Yield the mistakes of the page: each `diff FILE` with the `text` below it."""
    found = [each for each in FENCE.finditer(page) if each[1] in ("diff", "text")]
    for change, printed in zip(found[::2], found[1::2], strict=True):
        lines = change[3].splitlines(keepends=True)
        old = "".join(line[1:] for line in lines if line[0] in " -")
        new = "".join(line[1:] for line in lines if line[0] in " +")
        yield Mistake(change[2], old, new, printed[3])


def check_mistake(library: dict[str, str], mistake: Mistake, colour: str = "never") -> str:
    """Return what `skillc check` prints of the library with a mistake."""
    assert library[mistake.file].count(mistake.old) == 1, mistake.old
    changed = {**library, mistake.file: library[mistake.file].replace(mistake.old, mistake.new)}
    with tempfile.TemporaryDirectory() as folder:
        for name, text in changed.items():
            Path(folder, name).write_text(text, "utf-8")
        printed = CliRunner().invoke(skillc, ["check", folder, "--color", colour]).stdout
        return printed.replace(f"{folder}/", "").strip() + "\n"


def draw_picture(library: dict[str, str], mistake: Mistake) -> str:
    """Return the picture of a terminal with a mistake."""
    lines = check_mistake(library, mistake, "always").splitlines()
    return draw([Text("$ skillc check", "bold"), *map(Text.from_ansi, lines)], 110)


def main() -> None:
    """Write what is printed now into the page, and the picture."""
    page = PAGE.read_text("utf-8")
    library = read_library(page)
    for mistake in list(read_mistakes(page)):
        page = page.replace(f"```text\n{mistake.printed}```", f"```text\n{check_mistake(library, mistake)}```", 1)
    PAGE.write_text(page, "utf-8")
    PICTURE.write_text(draw_picture(library, list(read_mistakes(page))[SHOWN]), "utf-8")


if __name__ == "__main__":
    main()
