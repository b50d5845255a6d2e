"""Writes of a called skill in the terms of its caller, and writes without the names that others do not see."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from skillc_compiler.analysis.binding import class_of
from skillc_compiler.analysis.knowledge.alias_types import ANY_PREFIX, any_individual, is_any_individual
from skillc_compiler.analysis.knowledge.writes import OnceWrite, OutputWrite, PropertyWrite, RelationWrite, Write
from skillc_compiler.program.typed import Call, Skill
from skillc_compiler.program.types import Thing
from skillc_model.conditions import Anything, Condition, Expression, Individual, Literal, Term, Variable
from skillc_model.rewriting import substitute
from skillc_model.traversal import free_variables
from skillc_rdf.vocabulary.types import THING


def in_caller_terms(call: Call, writes: frozenset[Write]) -> frozenset[Write]:
    """Return writes of a called skill in the caller's terms."""
    values = _argument_values(call, call.skill) if call.skill else {}
    return frozenset(_substitute_write(write, values) for write in writes)


def _argument_values(call: Call, skill: Skill) -> Mapping[str, Expression]:
    """Return the caller's terms for the parameters of a skill; any fitting individual if it has no stable name."""
    values: dict[str, Expression] = {p.name: any_individual(class_of(p)) for p in skill.parameters}
    for argument in call.values:
        meaning = argument.value.meaning
        kind = argument.value.type
        if isinstance(meaning, Individual | Literal | Variable):
            values[argument.name.text] = meaning
        elif isinstance(kind, Thing):
            values[argument.name.text] = any_individual(kind.cls or THING)
    return values


def _substitute_write(write: Write, values: Mapping[str, Expression]) -> Write:
    match write:
        case RelationWrite(subject=subject, relation=relation, object=object_, value=value, when=when):
            start, end = _substitute_term(subject, values), _substitute_term(object_, values)
            kept = None if is_any_individual(start) and is_any_individual(end) else _substitute_when(when, values)
            return RelationWrite(start, relation, end, value, kept)
        case PropertyWrite(subject, iri, value, cleared, when, _, is_change):
            new = values.get(value.name) if isinstance(value, Variable) else value
            known = new if isinstance(new, Literal | Variable | Individual) and not is_any_individual(new) else None
            kept = _substitute_when(when, values)
            start = _substitute_term(subject, values)
            return PropertyWrite(start, iri, known, cleared, kept, is_change=is_change)
        case OutputWrite() | OnceWrite():
            return write


def _substitute_when(when: Condition | None, values: Mapping[str, Expression]) -> Condition | None:
    """Return on which individuals an effect is; not known if not all that it reads has a name."""
    if when is None:
        return None
    read = {name: values.get(name) for name in free_variables(when) if not name.startswith(ANY_PREFIX)}
    named = {name: value for name, value in read.items() if value is not None and not is_any_individual(value)}
    return substitute(when, named) if len(named) == len(read) else None


def _substitute_term(term: Term, values: Mapping[str, Expression]) -> Term:
    if not isinstance(term, Variable) or is_any_individual(term):
        return term
    found = values.get(term.name, any_individual(THING))
    return found if isinstance(found, Variable | Individual | Anything) else any_individual(THING)


def hide_names(writes: Iterable[Write], visible: Iterable[str]) -> frozenset[Write]:
    """Return the writes with any individual in the place of each name that is not visible."""
    names = {name: Variable(name) for name in visible}
    return frozenset(_substitute_write(write, names) for write in writes)
