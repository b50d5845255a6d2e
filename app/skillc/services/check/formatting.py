"""Formats skill files."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from skillc.errors import RequestError
from skillc.services.check.fixing import unified_diff
from skillc.services.library.files import edition_of, find_library
from skillc.services.project.loading import find_project
from skillc.services.reporting.files import inspect_path, rewrite_file
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.encoding import decode
from skillc_dsl.formatting.formatter import format_source
from skillc_dsl.source import Source


@dataclass(frozen=True, slots=True)
class FormattedFile:
    """A source and its formatted text; `path` is its file, None for a text without one.

    With `problems`, the reasons why it cannot be formatted, the text is unchanged.
    """

    source: Source
    path: Path | None
    text: str
    problems: tuple[Diagnostic, ...]

    @property
    def changes(self) -> bool:
        """Whether formatting changes the text."""
        return self.text != self.source.text

    def diff(self) -> str:
        """Return the change as a unified diff."""
        name = self.source.path
        return unified_diff(self.source.text, self.text, name, f"{name} (formatted)", context=3)

    def write(self) -> None:
        """Write the text to its file. ServiceError if it cannot be written."""
        assert self.path is not None
        rewrite_file(self.path, self.source.text, self.text)


def format_files(paths: Iterable[Path]) -> Iterator[FormattedFile]:
    """Yield each skill file at the paths once, formatted. RequestError for a path without skill files."""
    seen: set[Path] = set()
    for path in paths:
        if inspect_path(path).kind == "missing":
            raise RequestError(f"there is no file or folder {path}")
        library = find_library(path)
        for source in library.sources:
            place = library.places[source.path]
            if place.resolve() not in seen:
                seen.add(place.resolve())
                yield _format(source._replace(path=library.display_path(source.path)), place)


def format_text(name: Path, content: bytes) -> FormattedFile:
    """Format a text that is called `name` in messages; it is of the library there."""
    edition = edition_of(name.parent, find_project(name.parent))
    return _format(decode(str(name), content)._replace(edition=edition), None)


def _format(source: Source, path: Path | None) -> FormattedFile:
    outcome = format_source(source)
    return FormattedFile(source, path, outcome.value, outcome.diagnostics)
