"""Checks the text values of a library: those that name nothing, such as a misspelt posture."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path
from typing import TYPE_CHECKING

from skillc_compiler.program.expressions import TypedExpression
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Implementation
from skillc_dsl.diagnostics import Diagnostic, Fix, Label, Outcome, Severity
from skillc_dsl.position import Position
from skillc_dsl.source import Span
from skillc_dsl.spelling import did_you_mean
from skillc_model.conditions import Literal
from skillc_model.skills import Compound, SkillLibrary

if TYPE_CHECKING:
    from skillc.services.tasks.scenes import TaskScenes
    from skillc_runtime.execution.selection.text_names import UnknownTextName


@dataclass(frozen=True, slots=True)
class _GivenText:
    """A text that is the value of a skill's parameter, or of a local name of `implementation`."""

    text: str
    span: Span
    to: str
    skill: str
    implementation: Implementation | None = None


def value_places(program: Program) -> dict[tuple[Position, str], Span]:
    """Return the spans of the arguments, defaults and local values in a library's own files, by origin.

    An origin is the position of a call and the name of an argument, or the position of an implementation and the name
    of its parameter or local value.
    """
    found: dict[tuple[Position, str], Span] = {}
    for call in program.calls:
        found |= {(call.written.span.start, each.name.text): each.value.span for each in call.arguments}
    for one in program.implementations:
        at = one.span.start
        found |= {(at, each.name): each.default.span for each in one.parameters if each.default}
        found |= {(at, each.name.text): each.value.span for each in one.lets}
    own = _own(program)
    return {origin: span for origin, span in found.items() if span.path in own}


def check_values(
    compiled: Outcome[SkillLibrary],
    program: Program,
    scenes: TaskScenes | None,
    reported: Collection[Diagnostic],
    display_path: Callable[[str], str],
) -> Iterator[Diagnostic]:
    """Yield warnings for texts in a library's own files that name nothing in its scenes and the shipped data sheets.

    They are warnings because another scene may have what they name. Texts `reported` as errors are omitted; libraries
    and scenes with errors are not checked.
    """
    broken = not compiled.ok or (scenes and any(each.severity == "error" for each in scenes.problems))
    given = [] if broken else list(_given(program))
    if not given:
        return
    states = [scene.state for scene in scenes.valid.values()] if scenes else []
    errors = {each.span for each in reported if each.name == "unknown-value"}
    # The world model is heavy to import.
    from skillc.services.tasks.scenes import read_scene
    from skillc_model.read_write import changing_terms
    from skillc_runtime.execution.selection.text_names import UnknownTextName, is_fixed_path, list_names

    changing = changing_terms(compiled.value)
    for each in given:
        paths = _paths(compiled.value, each)
        if not paths or not all(is_fixed_path(path, program.vocabulary, changing) for path in paths):
            continue
        properties = {path[-1] for path in paths}
        if not states:
            sheets = read_scene(Path("sheets.ttl"), program.vocabulary, "").value
            states = [sheets.state] if sheets else []
        known = {name for state in states for iri in properties for name in list_names(iri, state.individuals, state)}
        span = each.span._replace(path=display_path(each.span.path))
        if known and each.text not in known and span not in errors:
            wrong = UnknownTextName(each.text, min(properties), None, tuple(sorted(known)))
            yield unknown_value(wrong, wrong.message(program.vocabulary), span, "warning")


def unknown_value(
    wrong: UnknownTextName, message: str, span: Span, severity: Severity, labels: tuple[Label, ...] = ()
) -> Diagnostic:
    """Return the diagnostic of a text that names nothing."""
    near = get_close_matches(wrong.text, wrong.known, n=2, cutoff=0.75)
    fix = Fix(span, f'"{near[0]}"', f'write "{near[0]}"', safe=False) if len(near) == 1 else None
    return Diagnostic("unknown-value", span, message, did_you_mean(wrong.text, wrong.known), severity, labels, fix)


def files_with_texts(program: Program) -> frozenset[str]:
    """Return the library's own files with texts that may name something."""
    return frozenset(each.span.path for each in _given(program))


def _given(program: Program) -> Iterator[_GivenText]:
    """Yield the texts in a library's own files that are arguments, defaults and local values."""
    own = _own(program)
    every = (*_arguments(program), *_defaults(program), *_local(program))
    for value, to, skill, implementation in every:
        match value.meaning:
            case Literal(value=str(text)) if value.span.path in own:
                yield _GivenText(text, value.span, to, skill, implementation)
            case _:
                pass


def _arguments(program: Program) -> Iterator[tuple[TypedExpression, str, str, None]]:
    for call in program.calls:
        if call.skill:
            yield from ((each.value, each.name.text, call.skill.name, None) for each in call.arguments)


def _defaults(program: Program) -> Iterator[tuple[TypedExpression, str, str, None]]:
    for skill in program.skills.values():
        yield from ((each.default, each.name, skill.name, None) for each in skill.parameters if each.default)
    for one in program.implementations:
        for new in one.refinements:
            if new.of and new.default:
                yield new.default, new.of.name, one.skill.name, None


def _local(program: Program) -> Iterator[tuple[TypedExpression, str, str, Implementation]]:
    for one in program.implementations:
        yield from ((each.value, each.name.text, one.skill.name, one) for each in one.lets)


def _paths(library: SkillLibrary, given: _GivenText) -> frozenset[tuple[str, ...]]:
    from skillc_runtime.execution.selection.text_names import find_name_paths, find_name_paths_in_body

    if given.implementation is None:
        return find_name_paths(library, given.skill, given.to)
    lowered = library.implementations.get(given.implementation.key)
    if lowered is None or not isinstance(lowered.body, Compound):
        return frozenset()
    return find_name_paths_in_body(library, lowered.body.node, given.to)


def _own(program: Program) -> frozenset[str]:
    return frozenset(unit.file.path for unit in program.files if unit.library == program.name)
