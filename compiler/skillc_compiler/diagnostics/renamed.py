"""Reports a name that is declared one way and used another way once, however often it is used."""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from skillc_compiler.program.typed import ParsedFile
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_dsl.source import Span

_WORD = re.compile(r"[\w-]+")
_MEANT = re.compile(r"did you mean `([\w-]+)`\?")
_COMMENT = re.compile(r"#[^\n]*")
DEPENDENT = frozenset(
    {
        "missing-argument",
        "no-effect",
        "no-implementation",
        "unlinked-inference",
        "unused-import",
        "unused-let",
        "unused-parameter",
        "wrong-python-parameters",
    }
)


@dataclass(frozen=True, slots=True)
class _Slip:
    """An unknown name and the close name that is meant; for an undeclared prefix the file that lacks it."""

    written: str
    meant: str
    lacking: str = ""


def told_once(found: Sequence[Diagnostic], files: Sequence[ParsedFile]) -> Iterator[Diagnostic]:
    """Yield the diagnostics, with all uses of one misspelt declaration as one, and without what depends on it.

    A declaration is misspelt, rather than its uses, if its name occurs nowhere else. A prefix is declared once for a
    file, so it is reported once.
    """
    slips = {problem: slip for problem in found if (slip := _slip(problem, files)) is not None}
    times = _times(files) if slips else {}
    groups: dict[_Slip, list[Diagnostic]] = defaultdict(list)
    for problem, slip in slips.items():
        if slip.lacking or times.get(slip.meant) == 1:
            groups[slip].append(problem)
    first = {min(group, key=lambda problem: problem.span): group for group in groups.values()}
    others = {problem for group in groups.values() for problem in group} - first.keys()
    meant = {slip.meant for slip in slips.values() if slip.meant}
    for problem in found:
        if problem in first:
            uses = (other.span for other in sorted(first[problem], key=lambda d: d.span) if other is not problem)
            yield replace(problem, labels=(*problem.labels, *(Label(span, "also here") for span in uses)))
        elif problem not in others and not _only_names(problem, meant):
            yield problem


def _slip(problem: Diagnostic, files: Sequence[ParsedFile]) -> _Slip | None:
    if not problem.name.startswith("unknown-"):
        return None
    near = _MEANT.match(problem.help)
    meant = problem.fix.text if problem.fix else near.group(1) if near else ""
    written = next((_written(unit.text, problem.span) for unit in files if unit.file.path == problem.span.path), "")
    if problem.name == "unknown-prefix":
        return _Slip(written.partition(":")[0], "", problem.span.path)
    return _Slip(written, meant) if written and meant else None


def _written(text: str, span: Span) -> str:
    """Return the text of a span within one line."""
    return text.split("\n")[span.line - 1][span.column - 1 : span.end_column - 1] if span.line == span.end_line else ""


def _times(files: Sequence[ParsedFile]) -> Mapping[str, int]:
    """Return how often each word occurs in the files, without comments."""
    return Counter(word for unit in files for word in _WORD.findall(_COMMENT.sub("", unit.text)))


def _only_names(problem: Diagnostic, meant: set[str]) -> bool:
    """Whether the problem is that a name is unused, unlinked or missing that was meant by an unknown one."""
    return problem.name in DEPENDENT and any(f"`{name}`" in problem.message for name in meant)
