"""Makes random mistakes in a library and judges what the compiler reports: one error each, near it, and no crash."""

from __future__ import annotations

import random
import traceback
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, partial
from typing import Literal, TypeAlias

from shipped import SKILLS, library, shelf, vocabulary
from single_edits import Edit, apply_edits, describe, edited_lines, independent_edits, single_edit
from test_libraries import FOLDER, LIBRARIES, text_of

from skillc_compiler.ide.analysis import AnalysisInput, analyse
from skillc_compiler.pipeline import compile, find_problems, lower_and_report
from skillc_dsl.diagnostics import Diagnostic, Fix, Outcome
from skillc_dsl.edits import apply_fixes
from skillc_dsl.parsing.reparse import parse_with
from skillc_dsl.query import Memo
from skillc_dsl.source import Source

Origin: TypeAlias = Literal["shipped", "other", "twelve"]
ORIGINS: tuple[Origin, ...] = ("shipped", "other", "twelve")
TWELVE = sorted(path for path in FOLDER.glob("*/*.skill") if path.stem == path.parent.name)


@dataclass(frozen=True, slots=True)
class Verdict:
    """What is reported for the mistakes of a seed.

    `warnings` are those that the library has not without them. `is_near` if each mistake has an error within one line
    of it, or an error that points there. `fixes` are known, of which the `useless_fixes` leave as many errors as there
    were. `crash` is the traceback, if the compiler crashed. `words` describe all.
    """

    seed: int
    mistakes: int
    errors: int
    warnings: int
    is_near: bool
    words: str
    fixes: int = 0
    useless_fixes: int = 0
    crash: str = ""

    @property
    def is_exact(self) -> bool:
        """Whether there are as many errors as mistakes."""
        return self.errors == self.mistakes


@cache
def libraries(origin: Origin) -> tuple[tuple[Source, ...], ...]:
    """Return each shipped library together with the standard library, or those of other authors.

    The `twelve` have the forms of edition 2.
    """
    if origin == "twelve":
        return tuple((Source("m.skill", path.read_text("utf-8")),) for path in TWELVE)
    if origin == "other":
        return tuple((Source("m.skill", text_of(path.stem)),) for path in LIBRARIES)
    standard = [Source(name, source.text) for name, source in shelf().items()]
    names = sorted(path.name for path in SKILLS.iterdir() if path.is_dir() and path.name != "std")
    return tuple((*standard, *library(name)) for name in names if library(name))


def judge(origin: Origin, seed: int, count: int = 1) -> Verdict | None:
    """Make `count` mistakes; return what is reported, None if one of them alone gives no error, and so is none."""
    chance = random.Random(seed)
    sources = chance.choice(libraries(origin))
    edited = chance.choices(sources, [len(each.text) for each in sources])[0]
    text = edited.text
    edits = (single_edit(text, seed),) if count == 1 else independent_edits(text, seed, count)
    words = f"{seed} {edited.path} {'; '.join(describe(text, edit) for edit in edits)}"
    if len(edits) < count:
        return None
    try:
        if count > 1 and not all(_errors(_problems(sources, edited, [edit])) for edit in edits):
            return None
        found = _problems(sources, edited, edits)
    except Exception:  # noqa: BLE001  a crash is what is looked for
        return Verdict(seed, count, 0, 0, is_near=False, words=words, crash=traceback.format_exc())
    errors = _errors(found)
    if not errors:
        return None
    others = [
        each for each in found if each.severity != "error" and (each.span.path, each.name) not in _warned(sources)
    ]
    near = all(any(_is_near(edited, edit, edits, error) for error in errors) for edit in edits)
    shown = ", ".join(f"{each.span.path}:{each.span.line}:{each.name}" for each in (*errors, *others))
    fixes = [each.fix for each in errors if each.fix is not None]
    changed = _changed(sources, edited, edits)
    left = [len(_errors(_check(sources, _fixed(changed, fix)))) for fix in fixes]
    bad = sum(each >= len(errors) for each in left)
    return Verdict(seed, count, len(errors), len(others), near, f"{words} => {shown}", len(fixes), bad)


def _changed(sources: Sequence[Source], edited: Source, edits: Sequence[Edit]) -> dict[str, Source]:
    new = Source(edited.path, apply_edits(edited.text, edits))
    return {each.path: new if each is edited else each for each in sources}


def _fixed(sources: Mapping[str, Source], fix: Fix) -> dict[str, Source]:
    path = fix.span.path
    return {**sources, path: Source(path, apply_fixes(sources[path].text, [fix]))}


def _problems(sources: Sequence[Source], edited: Source, edits: Sequence[Edit]) -> tuple[Diagnostic, ...]:
    return _check(sources, _changed(sources, edited, edits))


def _check(sources: Sequence[Source], changed: dict[str, Source]) -> tuple[Diagnostic, ...]:
    """Return what is reported; a library is lowered with errors and without, to see that this does not crash."""
    memo = _memory(sources)
    analysis = analyse(AnalysisInput("own", changed, shelf(), vocabulary()), partial(parse_with, memo), memo)
    found = find_problems(analysis.files, analysis.resolved, memo)
    return lower_and_report(Outcome(analysis.program, found), tuple(changed.values())).diagnostics


@cache
def _warned(sources: tuple[Source, ...]) -> frozenset[tuple[str, str]]:
    """Return the warnings of a library without mistakes, by file."""
    found = compile(sources, vocabulary(), shelf(), "own").diagnostics
    return frozenset((each.span.path, each.name) for each in found)


@cache
def _memory(library: Sequence[Source]) -> Memo:
    """Return what is kept from one analysis of a library to the next."""
    return Memo()


def _errors(problems: Iterable[Diagnostic]) -> list[Diagnostic]:
    return [each for each in problems if each.severity == "error"]


def _is_near(edited: Source, edit: Edit, edits: Sequence[Edit], error: Diagnostic) -> bool:
    """Whether an error, or a place that it points to, is within a line of an edit."""
    above = (other for other in edits if other.end <= edit.start and other is not edit)
    shift = sum(other.new.count("\n") - edited.text.count("\n", other.start, other.end) for other in above)
    lines = edited_lines(edited.text, edit)
    places = (error.span, *(label.span for label in error.labels))
    return any(place.path == edited.path and lines.start - 1 <= place.line - shift <= lines.stop for place in places)
