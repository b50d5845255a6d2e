"""What `skillc fmt` does once its command line is understood."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import click

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.encoding import decode, split_lines
from skillc_dsl.formatting.formatter import check_layout, format_source
from skillc_dsl.source import Source
from skillc_runtime.commands import _files, _telling
from skillc_runtime.commands._paths import look
from skillc_runtime.commands._writing import WriteError, rewrite


@dataclass(frozen=True, slots=True)
class Layout:
    """A source, where it is written, its text when formatted, and why it cannot be. `path` is None for stdin."""

    source: Source
    path: Path | None
    text: str
    problems: tuple[Diagnostic, ...]

    @property
    def changes(self) -> bool:
        """Whether there is something to write."""
        return self.text != self.source.text


def of_files(paths: Iterable[Path]) -> Iterator[Layout]:
    """Yield the layout of each skill file at the paths, once. UsageError for a path that has none."""
    seen: set[Path] = set()
    for path in paths:
        if look(path).kind == "missing":
            raise click.UsageError(f"there is no file or folder {path}")
        library = _files.find(path)
        for source in library.sources:
            place = library.places[source.path]
            if place.resolve() not in seen:
                seen.add(place.resolve())
                yield _layout(Source(library.shown(source.path), source.text), place)


def of_stdin(name: Path) -> Layout:
    """Return the layout of the standard input."""
    return _layout(decode(str(name), _files.piped()), None)


def write(layouts: Sequence[Layout]) -> int:
    """Write every file that changes, print what could not be formatted, and return the exit code."""
    failed = show_problems(layouts)
    for layout in layouts:
        if layout.path is None and not layout.problems:
            click.echo(layout.text, nl=False)
    files = [layout for layout in layouts if layout.path is not None and layout.changes]
    for layout in files:
        try:
            rewrite(layout.path or Path(), layout.source.text, layout.text)
        except WriteError as error:
            click.echo(f"error: {error}", err=True)
            failed = 1
        else:
            click.echo(f"formatted {layout.source.path}", err=True)
    if not files and not failed and layouts[0].path is not None:
        click.echo(f"{_telling.counted(len(layouts), 'file')} formatted already", err=True)
    return failed


def show_problems(layouts: Iterable[Layout]) -> int:
    """Print on stderr why files cannot be formatted; return 1 if there is one."""
    problems = [problem for layout in layouts for problem in layout.problems]
    _telling.tell(problems, {layout.source.path: layout.source for layout in layouts})
    return _telling.exit_code(problems)


def show_unformatted(layouts: Sequence[Layout]) -> int:
    """List the files that are not formatted, tell of those that cannot be, and return 1 if there is one of either."""
    warnings = [warning for layout in layouts if (warning := check_layout(layout.source)) is not None]
    click.echo(_telling.rendered(warnings, {}, "concise"), nl=False)
    failed = show_problems(layouts)
    if warnings:
        click.echo(f"{_telling.counted(len(warnings), 'file')} not formatted; run `skillc fmt`", err=True)
    return 1 if warnings or failed else 0


def show_diffs(layouts: Iterable[Layout]) -> None:
    """Print what would change as unified diffs."""
    for layout in layouts:
        old, new = (split_lines(text) for text in (layout.source.text, layout.text))
        name = layout.source.path
        for line in difflib.unified_diff(old, new, name, f"{name} (formatted)"):
            click.echo(line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n", nl=False)


def _layout(source: Source, path: Path | None) -> Layout:
    outcome = format_source(source)
    return Layout(source, path, outcome.value, outcome.diagnostics)
