"""Writes the library: vocabulary, defined relations, skills, and the task with the goal."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from skillc.services.pddl_import.conditions import AND, IMPLIES, Scope, Writer, root_scope
from skillc.services.pddl_import.declarations import Derived, Domain, Problem
from skillc.services.pddl_import.expressions import BrokenPddl, Findings, Missing
from skillc.services.pddl_import.names import Names, to_class
from skillc.services.pddl_import.ranges import Range
from skillc.services.pddl_import.skills import ActionWriter
from skillc.services.pddl_import.terms import PREFIX, Defined, Entry, Form, Property, Relation, Terms, signature


def write_vocabulary(terms: Terms, ranges: Mapping[str, Range]) -> str:
    """Return the declarations of classes, relations and properties, some of which have ranges."""
    return "".join(f"{line}\n" for line in (*_classes(terms), *_terms(terms, ranges)))


def _classes(terms: Terms) -> Iterator[str]:
    for name, above, written in terms.class_declarations():
        yield f"class {name} < {', '.join(above)}{f'  # {written}' if written else ''}"


def _terms(terms: Terms, ranges: Mapping[str, Range]) -> Iterator[str]:
    for form in (*terms.forms.values(), *terms.functions.values()):
        written = form.symbol.node.written
        number = f"Number{_range(ranges.get(form.symbol.name))}" if _is_number(form) else "Bool"
        classes = [terms.class_of(each.types) for each in form.symbol.parameters]
        match form:
            case Property(name=name):
                remark = "" if name == written else f"  # {written}"
                owner = classes[0] if classes else terms.world_class
                yield f"property {name}({owner}): {number}{remark}"
            case Relation(name=name):
                yield f"relation {name}({', '.join(classes)}){'' if name == written else f'  # {written}'}"
            case Entry(cls=own, sides=sides, value=value):
                yield from (
                    f"relation {side}({own}, {cls}) functional" for side, cls in zip(sides, classes, strict=True)
                )
                if value:
                    yield f"property {value}({own}): {number}"
            case Defined():
                pass


def _is_number(form: Form) -> bool:
    return isinstance(form, Property | Entry) and form.is_number


def _range(bounds: Range | None) -> str:
    return "" if bounds is None else f" range {bounds[0]:g} .. {bounds[1]:g}"


def write_derived(domain: Domain, writer: Writer, findings: Findings) -> str:
    """Return the derived predicates as defined relations; several conditions for one are joined by `or`."""
    rules: dict[str, list[Derived]] = {}
    for each in domain.derived:
        rules.setdefault(each.head.name, []).append(each)
    lines = []
    for name, own in rules.items():
        form = writer.terms.forms.get(name)
        if isinstance(form, Defined):
            lines.append(_define(form.name, own, writer, findings))
        else:
            what = "a derived predicate of more than two parameters is not in the library"
            findings.add_missing(Missing(own[0].head.node, what))
    return "".join(lines)


def _define(relation: str, rules: list[Derived], writer: Writer, findings: Findings) -> str:
    """Return a defined relation; an empty text if no condition for it can be said."""
    names, first = Names(), rules[0].head
    scope = root_scope(first.parameters, names)
    sides = [f"{name}: {writer.terms.class_of(each.types)}" for name, each in scope.variables.values()]
    sides += [f"{names.give('world')}: {writer.terms.world_class}" for _ in range(2 - len(sides))]
    texts = []
    for rule in rules:
        renamed = zip(rule.head.parameters, scope.variables.values(), strict=True)
        own = Scope({each.name: (name, each) for each, (name, _) in renamed}, names)
        try:
            texts.append(writer.condition(rule.condition, own).within(AND if rules[1:] else IMPLIES))
        except Missing as missing:
            findings.add_missing(missing)
        except BrokenPddl as error:
            findings.add_error(error)
    return f"# {signature(first)}\nrelation {relation}({', '.join(sides)}) = {' or '.join(texts)}\n" if texts else ""


def write_skills(domain: Domain, actions: ActionWriter, names: Names) -> str:
    """Return the skills, in the order of the actions."""
    texts = (actions.write(each, names.give(to_class(each.name.written))) for each in domain.actions)
    return "\n".join(texts)


def write_task(problem: Problem, name: str, scene: str, measure: str, writer: Writer, findings: Findings) -> str:
    """Return the task with the goal of a problem, which minimises a measure unless that is empty."""
    parts, comments = [], []
    for node in writer.conjuncts(problem.goal):
        try:
            text = writer.condition(node, root_scope((), Names()))
            parts.append(text)
        except Missing as missing:
            comments.append(findings.add_missing(missing))
        except BrokenPddl as error:
            findings.add_error(error)
    if not parts:
        return ""
    goal = " and ".join(each.within(AND if parts[1:] else IMPLIES) for each in parts)
    members = (f'scene "{scene}"', *comments, f"goal {goal}", *((f"minimise {measure}",) if measure else ()))
    lines = "".join(f"    {each}\n" for each in members)
    return f"task {name} {{\n{lines}}}\n"


def header(title: str, prefix_iri: str) -> str:
    """Return how a file begins."""
    return f"# {title}\n\nprefix {PREFIX}: <{prefix_iri}>\n"
