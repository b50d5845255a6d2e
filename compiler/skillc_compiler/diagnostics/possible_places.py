"""Where a missing name is probably to be declared: what messages point to besides the places that use the name."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType

from skillc_compiler.diagnostics.orphans import Orphans
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Implementation
from skillc_compiler.program.unknown import UnknownKind, UnknownName
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Label
from skillc_dsl.source import Span

_DECLARATIONS: Mapping[UnknownKind, tuple[type[s.Declaration], ...]] = MappingProxyType(
    {
        **dict.fromkeys(("class", "type"), (s.ClassDeclaration,)),
        "relation": (s.RelationDeclaration,),
        "property": (s.PropertyDeclaration,),
        "function": (s.FunctionDeclaration,),
    }
)
"""The declarations beside which that of a name of a kind stands."""


def possible_places(group: Sequence[UnknownName], orphans: Orphans) -> tuple[Label, ...]:
    """Return labels for a name that is unknown in several places: at a declaration that nothing uses, or beside others.

    What only one implementation reads may be a parameter, or a value that it lacks.
    """
    unknown = group[0]
    orphan = orphans.find(unknown)
    if orphan is not None:
        return (Label(orphan.span, f"`{orphan.text}` is declared here, and nothing refers to it"),)
    if unknown.kind in ("parameter", "argument"):
        return tuple(_in_skill(group, orphans.program))
    place = _last_beside(unknown, orphans.program)
    return () if place is None else (_below(place, f"a {_what(unknown)} `{unknown.written.text}`"),)


def _below(place: Span, what: str) -> Label:
    return Label(place, f"{what} could be declared below this one")


def _what(unknown: UnknownName) -> str:
    return "class" if unknown.kind == "type" else unknown.kind


def _last_beside(unknown: UnknownName, program: Program) -> Span | None:
    """Return the name in the last declaration of the kind in the file of an unknown name; None for other prefixes."""
    kinds, span = _DECLARATIONS.get(unknown.kind, ()), unknown.written.span
    if ":" in unknown.written.text:
        return None
    declarations = (each for unit in program.files if unit.file.path == span.path for each in unit.file.declarations)
    return max((each.name.span for each in declarations if isinstance(each, kinds)), default=None)


def _in_skill(group: Sequence[UnknownName], program: Program) -> Iterator[Label]:
    """Yield where the skill would declare it: what callers pass with other required parameters, else before options."""
    name, skill = group[0].written.text, program.skills.get(group[0].owner or "")
    if skill is None:
        return
    is_passed = any(each.kind == "argument" for each in group)
    directions = ("in",) if is_passed else ("in", "infer")
    alike = [each for each in skill.parameters if each.direction in directions]
    if alike:
        yield _below(alike[-1].span, f"a parameter `{name}`")
    elif skill.parameters:
        yield Label(skill.parameters[0].span, f"a parameter `{name}` could be declared above this one")
    way = _only_reader(group, program.implementations_of.get(skill.name, ()))
    if way is not None and way.lets:
        yield _below(way.lets[-1].name.span, f"`let {name}`")


def _only_reader(group: Sequence[UnknownName], ways: Sequence[Implementation]) -> Implementation | None:
    """Return the implementation in which all places of a name are."""
    places = [each.written.span for each in group]
    return next((way for way in ways if all(_contains(way.span, each) for each in places)), None)


def _contains(outer: Span, inner: Span) -> bool:
    return outer.path == inner.path and outer.line <= inner.line <= outer.end_line
