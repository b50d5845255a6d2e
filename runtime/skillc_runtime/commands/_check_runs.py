"""What `skillc check` does once its command line is understood. Nothing heavy is imported unless it is needed."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import click

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Source
from skillc_runtime.commands import _files, _telling
from skillc_runtime.commands._files import LibraryFiles
from skillc_runtime.commands._verdicts import Case

if TYPE_CHECKING:
    from skillc_runtime.commands._fixing import Cured
    from skillc_runtime.commands._fixing_around import Mended

STDIN = Path("-")


@dataclass(frozen=True, slots=True)
class Job:
    """What is to be checked, with a scene or without, and how it is told.

    `-` among the paths is the standard input, whose text belongs to `stdin_filename`; with `cache`, what was found in
    the same files before is not looked for again.
    """

    paths: tuple[Path, ...]
    scene: Path | None
    form: str
    stdin_filename: Path | None
    cache: bool


def check(job: Job) -> int:
    """Check, print what is found and return the exit code."""
    found, texts = found_in_all(job, libraries(job))
    return _telling.show(found, texts, job.form)


def fix(job: Job, unsafe: bool) -> int:
    """Fix what can be fixed, print what remains and return the exit code; a fixed standard input goes to stdout."""
    from skillc_runtime.commands import _fixing, _fixing_around
    from skillc_runtime.commands._writing import WriteError

    cured = _cured(job, unsafe)
    piped = STDIN in job.paths
    around: Sequence[Mended] = () if piped else _fixing_around.mended(_remaining(cured), unsafe)
    try:
        files = [] if piped else [path for each in cured for path in _fixing.write(each)]
        _fixing_around.write(around)
    except WriteError as error:
        click.echo(f"error: {error}", err=True)
        return 1
    count = _telling.counted(_count(cured, around), "problem")
    changed = _telling.counted(len(files) + len(around), "file")
    click.echo(f"fixed {count}" + (f" in {changed}" if files or around else ""), err=True)
    found, texts = found_in_all(job, libraries(job) if around else [each.after for each in cured])
    if not piped:
        return _telling.show(found, texts, job.form)
    click.echo(cured[0].after.sources[0].text, nl=False)
    _telling.tell(found, texts)
    return _telling.exit_code(found)


def show_fixes(job: Job, unsafe: bool) -> int:
    """Print what `fix` would change and return the exit code: 1 if there is something, or errors would remain."""
    from skillc_runtime.commands import _fixing, _fixing_around

    cured = _cured(job, unsafe)
    around: Sequence[Mended] = () if STDIN in job.paths else _fixing_around.mended(_remaining(cured), unsafe)
    count = _count(cured, around)
    click.echo("".join(_fixing.diff(each) for each in cured), nl=False)
    click.echo("".join(_fixing.unified(each.before, each.after, str(each.path)) for each in around), nl=False)
    click.echo(f"{_telling.counted(count, 'problem')} can be fixed", err=True)
    return max(1 if count else 0, *(_telling.exit_code(each.remaining) for each in cured))


def libraries(job: Job) -> list[LibraryFiles]:
    """Read the libraries at the paths. UsageError for one that is none."""
    return [_from_stdin(job.stdin_filename) if path == STDIN else _files.find(path) for path in job.paths]


def found_in_all(job: Job, checked: Iterable[LibraryFiles]) -> tuple[tuple[Diagnostic, ...], dict[str, Source]]:
    """Return what is wrong with libraries, each problem once, and the texts that the problems speak of."""
    found: list[Diagnostic] = []
    texts: dict[str, Source] = {}
    for library in checked:
        own = found_in(job, library)
        found += own
        texts |= _files.texts(library) if own else {}
    ordered = _telling.in_order(found)
    return ordered, _telling.with_texts(ordered, texts)


def found_in(job: Job, library: LibraryFiles) -> tuple[Diagnostic, ...]:
    """Return what is wrong with a library, from memory if nothing has changed."""
    case = Case.of(library, job.scene) if job.cache else None
    known = case.recall() if case else None
    if known is not None:
        return known
    from skillc_runtime.commands import _checking

    found = _checking.check(library, job.scene)
    if case:
        case.remember(found)
    return found


def _cured(job: Job, unsafe: bool) -> list[Cured]:
    from skillc_runtime.commands import _fixing

    read = libraries(job)
    for library in read:
        if library.root.resolve().is_relative_to(_files.SHIPPED):
            raise click.UsageError(f"the shipped library {library.name} is not changed; copy it and fix the copy")
    if STDIN in job.paths and len(read) > 1:
        raise click.UsageError("with fixes, `-` must be the only path")
    return [_fixing.cure(library, lambda files: found_in(job, files), unsafe) for library in read]


def _count(cured: Sequence[Cured], around: Sequence[Mended]) -> int:
    return sum(each.fixes for each in cured) + sum(each.fixes for each in around)


def _remaining(cured: Iterable[Cured]) -> list[Diagnostic]:
    return [problem for each in cured for problem in each.remaining]


def _from_stdin(path: Path | None) -> LibraryFiles:
    if path is not None and path.suffix != ".skill":
        raise click.UsageError(f"{path} is not a .skill file")
    return _files.of_file(path, _files.piped())
