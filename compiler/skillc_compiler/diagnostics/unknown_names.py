"""Reports names without a declaration: one diagnostic for each declaration or line that is missing or misspelt."""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import TypeAlias

from skillc_compiler.diagnostics.orphans import Orphans
from skillc_compiler.diagnostics.possible_places import possible_places
from skillc_compiler.program import name_notes
from skillc_compiler.program.program import ParsedFile, Program
from skillc_compiler.program.unknown import LIBRARY, HeaderLine, UnknownKind, UnknownName
from skillc_compiler.program.written import names_declared_in, skill_of
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Fix, Label
from skillc_dsl.source import Span

FormerNames = Mapping[tuple[str, str], str]
"""The advice for each name, by its skill and the name; skills and functions belong to LIBRARY."""
NONE: FormerNames = MappingProxyType({})


def find_former_names(files: Iterable[ParsedFile]) -> FormerNames:
    """Return what the comments of files say about names that are no more."""
    return {(each.owner, each.name): each.advice for each in name_notes.find_former_names(files)}


def with_advice(problem: Diagnostic, advice: str) -> Diagnostic:
    """Return the problem with an unknown name with what to do about it; another name is a fix."""
    renamed = name_notes.RENAMED.match(advice)
    fix = Fix(problem.span, renamed[1], f"write `{renamed[1]}`", safe=False) if renamed else None
    return replace(problem, message=f"{problem.message} any more", help=advice, fix=fix)


Key: TypeAlias = tuple[object, ...]

MOST_PLACES = 3
"""The maximum number of further places that are shown of names that one line would make visible."""
_KEYWORDS: Mapping[UnknownKind, str] = {
    "class": "class",
    "type": "class",
    "relation": "relation",
    "property": "property",
    "function": "function",
    "skill": "skill",
    "implementation": "impl",
}
"""What begins the declaration of a name of a kind."""
_WORD = re.compile(r"[\w-]+")
_COMMENT = re.compile(r"#[^\n]*")


def report_unknown_names(program: Program) -> Iterator[Diagnostic]:
    """Yield the diagnostics of the names that the program lacks, except those that other errors explain.

    Of several arguments that a skill does not take on a line, the first is reported: they may be for another skill.
    """
    groups: dict[Key, list[UnknownName]] = defaultdict(list)
    for unknown in program.unknown:
        if not program.lost.explains(unknown):
            groups[_key(unknown)].append(unknown)
    for key in tuple(_find_renamed(program, groups)):
        del groups[key]
    times = _count_words(program.files) if any(len(group) > 1 for group in groups.values()) else {}
    calls: set[Key] = set()
    orphans = Orphans(program)
    former = find_former_names(program.files) if groups else NONE
    for group in sorted((sorted(each, key=lambda one: one.written.span) for each in groups.values()), key=_first_place):
        first = group[0]
        call = (first.owner, first.written.span.path, first.written.span.line)
        advice = former.get((first.owner or LIBRARY, first.written.text))
        if advice is not None:
            yield from (with_advice(render_unknown_name(each), advice) for each in group)
        elif not first.passed or call not in calls:
            yield _report(group, orphans, times)
        calls |= {call} if first.passed else set()


def _find_renamed(program: Program, groups: Mapping[Key, Sequence[UnknownName]]) -> Iterator[Key]:
    """Yield the keys of names whose declarations an error may have given another name, one for each such declaration.

    Of several names, those are meant that are declared nowhere else, and used most often.
    """
    renamed = [key for key, group in groups.items() if program.lost.may_be_renamed(group[0])]
    if len(renamed) > 1:
        declarations = (each for unit in program.files for each in unit.file.declarations)
        declared = {name.text for each in declarations for name in names_declared_in(each)}
        renamed.sort(key=lambda key: (groups[key][0].written.text in declared, -len(groups[key])))
    left = [*program.lost.nameless, *("" for _ in program.lost.twice)]
    for key in renamed:
        keyword = next((each for each in (_KEYWORDS.get(groups[key][0].kind), "") if each in left), None)
        if keyword is not None:
            left.remove(keyword)
            yield key


def _first_place(group: Sequence[UnknownName]) -> Span:
    return group[0].written.span


def render_unknown_name(unknown: UnknownName) -> Diagnostic:
    """Return the diagnostic of one name; its fix is the only close candidate."""
    close, written = unknown.close, unknown.written
    fix = Fix(written.span, close[0], f"write `{close[0]}`", safe=False) if len(close) == 1 else None
    return Diagnostic(unknown.diagnostic, written.span, unknown.message, unknown.help, labels=unknown.labels, fix=fix)


def _key(unknown: UnknownName) -> Key:
    """Return what names that lack the same declaration or line have in common."""
    text, span = unknown.written.text, unknown.written.span
    if unknown.line is not None:
        return (span.path, unknown.line.keyword, unknown.line.name if unknown.line.keyword == "import" else "")
    if unknown.owner is None:
        return (span,)
    return unknown.owner, text, span.path if unknown.kind == "prefix" else ""


def _report(group: Sequence[UnknownName], orphans: Orphans, times: Mapping[str, int]) -> Diagnostic:
    """Return the diagnostic of names with one cause: at the misspelt declaration if there is one, else at the first."""
    first, files = group[0], orphans.program.files
    if first.line is not None:
        return _report_line(group, first.line, files)
    if first.kind == "prefix" and not first.close:
        return _report_line(group, _find_prefix(first.written.text, files), files)
    alone = render_unknown_name(first)
    close = first.close
    place = _declaration(first, close[0], files) if len(close) == 1 else None
    if len(group) > 1 and place is not None and times.get(close[0]) == 1:
        uses = tuple(Label(each.written.span, "used here") for each in group)
        text = first.written.text
        message = f"`{close[0]}` is never used, and `{text}`, which is used in {len(group)} places, is not declared"
        fix = Fix(place, text, f"write `{text}`", safe=False)
        return Diagnostic(first.diagnostic, place, message, f"did you mean `{text}`?", labels=uses, fix=fix)
    labels = tuple(Label(each.written.span, "also here") for each in group[1:])
    if place is not None and not first.labels and first.kind != "prefix":
        labels = (Label(place, f"`{close[0]}` is declared here"), *labels)
    return replace(alone, labels=(*alone.labels, *(() if close else possible_places(group, orphans)), *labels))


def _report_line(group: Sequence[UnknownName], line: HeaderLine, files: Sequence[ParsedFile]) -> Diagnostic:
    """Return the diagnostic of names that one missing line would make visible, with the edit that adds it."""
    first = group[0]
    unit = next(unit for unit in files if unit.file.path == first.written.span.path)
    place, text = _insertion(unit, line)
    known = "<..>" not in line.name
    fix = Fix(place, text, f"add `{_write_line(line)}`") if known else None
    help_ = f"add `{_write_line(line)}` at the top of the file" if line.keyword == "prefix" else first.help
    labels = (*first.labels, Label(place, "add it here"), *_other_places(group))
    return Diagnostic(first.diagnostic, first.written.span, first.message, help_, labels=labels, fix=fix)


def _find_prefix(name: str, files: Sequence[ParsedFile]) -> HeaderLine:
    """Return the line that declares a prefix as other files of the library do, or with an IRI that is left open."""
    lines = (each for unit in files for each in unit.file.header if isinstance(each, s.Prefix))
    iris = {each.iri for each in lines if each.name.text == name}
    return HeaderLine("prefix", f"{name}: <{iris.pop() if len(iris) == 1 else '..'}>")


def _other_places(group: Sequence[UnknownName]) -> tuple[Label, ...]:
    """Return labels at the first of the other names, the last of which says how many there are besides."""
    shown = [Label(each.written.span, "also here") for each in group[1 : MOST_PLACES + 1]]
    more = len(group) - 1 - len(shown)
    if more:
        shown[-1] = Label(shown[-1].span, f"also here, and in {more} more place{'s' * (more > 1)}")
    return tuple(shown)


def _insertion(unit: ParsedFile, line: HeaderLine) -> tuple[Span, str]:
    """Return where a line is to be added to the header of a file, and the text."""
    path, header = unit.file.path, unit.file.header
    uses = [each for each in header if isinstance(each, s.Use)]
    if line.keyword == "use" and uses:
        span = uses[-1].span
        return span.after, f", {line.name}"
    text = _write_line(line)
    if header and line.keyword != "use":
        span = header[-1].span
        return span.after, f"\n{text}"
    number = header[0].span.line if header else next((d.span.line for d in unit.file.declarations), 1)
    return Span(path, number, 1, number, 1), f"{text}\n" if header else f"{text}\n\n"


def _write_line(line: HeaderLine) -> str:
    return f'import "{line.name}"' if line.keyword == "import" else f"{line.keyword} {line.name}"


def _declaration(unknown: UnknownName, name: str, files: Iterable[ParsedFile]) -> Span | None:
    """Return the name in the declaration of a candidate, None if the owner of the unknown name does not declare it."""
    declarations = (declaration for unit in files for declaration in unit.file.declarations)
    names = (each for declaration in declarations for each in _declared_names(declaration, unknown))
    if unknown.kind == "prefix":
        own = (unit for unit in files if unit.file.path == unknown.written.span.path)
        names = (line.name for unit in own for line in unit.file.header if isinstance(line, s.Prefix))
    return next((each.span for each in names if each.text == name), None)


def _declared_names(declaration: s.Declaration, unknown: UnknownName) -> Iterator[s.Name]:
    """Yield the names of a declaration that are among those which an unknown name could be."""
    implements = isinstance(declaration, s.ImplementationDeclaration)
    if unknown.owner == LIBRARY:
        yield from () if implements else (declaration.name,)
    elif (
        isinstance(declaration, s.SkillDeclaration | s.ImplementationDeclaration)
        and skill_of(declaration) == unknown.owner
    ):
        yield from (each.name for each in declaration.members if isinstance(each, s.Parameter | s.Let))
        yield from (declaration.name,) if implements else ()


def _count_words(files: Iterable[ParsedFile]) -> Mapping[str, int]:
    """Return how often each word occurs in the files, without comments."""
    return Counter(word for unit in files for word in _WORD.findall(_COMMENT.sub("", unit.text)))
