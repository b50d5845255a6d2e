"""Formats the answers of `skillc world` as text and as JSON."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from dataclasses import asdict
from typing import Any

from skillc.cli.layout import TerminalPage
from skillc.contract.world import PlacedThing
from skillc.services.scene.rule_reasons import RuleReason
from skillc.services.views.open_scenes import OpenScene
from skillc.services.views.scenes import IndividualFacts, SceneDiff
from skillc_runtime.scene.query import QueryAnswer, QueryValue
from skillc_runtime.world.state.elements import Element
from skillc_runtime.world.state.values import show, to_json


def format_elements(elements: Iterable[Element], scene: OpenScene, as_json: bool) -> str:
    """Return the stated facts about individuals: as text a paragraph for each, as JSON a list of objects."""
    if as_json:
        return _json([_element_data(each, scene) for each in elements])
    return "\n\n".join(_element_text(each, scene) for each in elements)


def format_individuals(individuals: Iterable[IndividualFacts], scene: OpenScene, as_json: bool) -> str:
    """Return all facts about individuals: stated ones, incoming relations and derived facts."""
    if as_json:
        return _json([_individual_data(each, scene) for each in individuals])
    return "\n\n".join(_individual_text(each, scene) for each in individuals)


def format_answer(answer: QueryAnswer, as_json: bool, page: TerminalPage) -> str:
    """Return the answer of a query, as a table or as a list of objects."""
    if as_json:
        return _json([dict(zip(answer.columns, row, strict=True)) for row in answer.rows])
    return "\n".join(page.table(answer.columns, [tuple(map(_cell_text, row)) for row in answer.rows]))


def format_diff(diff: SceneDiff, as_json: bool) -> str:
    """Return the facts of the first scene only, marked `-`, and of the second only, marked `+`, by individual."""
    if as_json:
        return _json({"removed": [each._asdict() for each in diff.removed], "added": [e._asdict() for e in diff.added]})
    lines = [(each.subject, each.predicate, sign, each.value) for sign in (0, 1) for each in diff[sign]]
    return "\n".join(f"{'-+'[sign]} {s} {p} {value}" for s, p, sign, value in sorted(lines)) or "no differences"


def format_placed(things: Sequence[PlacedThing], as_json: bool, page: TerminalPage) -> str:
    """Return things with their poses in the world: as text a table, as JSON a list of objects."""
    if as_json:
        return _json([asdict(each) for each in things])
    header = ("thing", "class", "stated", "x y z, m", "roll pitch yaw, deg", "size, m")
    problems = (line for each in things if each.problem is not None for line in page.wrap(each.problem, hanging="  "))
    return "\n".join([*page.table(header, [_placed_row(each) for each in things]), *problems])


def _placed_row(each: PlacedThing) -> tuple[str, ...]:
    numbers = (" ".join(f"{number:.4g}" for number in row) for row in (each.position, each.angles, each.size))
    return each.name, ", ".join(each.classes), each.stated, *(text or "-" for text in numbers)


def _element_text(element: Element, scene: OpenScene) -> str:
    """Return the stated facts about an individual, one per line."""
    short, label = scene.state.vocabulary.short, scene.labels.get(element.iri)
    called = "" if label is None else f'  "{label}"'
    lines = [f"{short(element.iri)}{called}  a {_names(element.types, scene)}"]
    lines += [f"    {short(relation)} {short(other)}" for relation, other in element.relations]
    lines += [f"    {short(each.property)} {show(each.value)}" for each in element.properties]
    return "\n".join(lines)


def _element_data(element: Element, scene: OpenScene) -> dict[str, object]:
    short = scene.state.vocabulary.short
    related: dict[str, list[str]] = {}
    for relation, other in element.relations:
        related.setdefault(short(relation), []).append(short(other))
    return {
        "individual": short(element.iri),
        "label": scene.labels.get(element.iri),
        "types": [short(each) for each in element.types],
        "relations": related,
        "properties": {short(each.property): to_json(each.value) for each in element.properties},
    }


def _individual_text(known: IndividualFacts, scene: OpenScene) -> str:
    short = scene.state.vocabulary.short
    lines = [_element_text(known.element, scene)]
    lines += [f"  also a   {_names(known.classes, scene)}"] if known.classes else []
    lines += [f"  from     {short(other)} {short(relation)}" for other, relation in known.leading]
    lines += [f"  follows  {short(relation)} {short(other)}" for relation, other in known.follows]
    lines += [f"  rules    {_reason_text(each)}" for each in known.rules]
    return "\n".join(lines)


def _reason_text(reason: RuleReason) -> str:
    """Return a fact that rules derive, the facts from which it follows, and the lines of the axioms."""
    since = " and ".join(" ".join(each) for each in reason.since)
    axioms = ", ".join(f"{each.path}:{each.line}" for each in reason.axioms)
    return f"{' '.join(reason.fact[1:])}{f', since {since}' if since else ''} ({axioms})"


def _individual_data(known: IndividualFacts, scene: OpenScene) -> dict[str, object]:
    short = scene.state.vocabulary.short
    return {
        **_element_data(known.element, scene),
        "also": [short(cls) for cls in known.classes],
        "from": [[short(other), short(relation)] for other, relation in known.leading],
        "follows": [[short(relation), short(other)] for relation, other in known.follows],
        "rules": [
            {"fact": each.fact, "since": each.since, "axioms": [f"{at.path}:{at.line}" for at in each.axioms]}
            for each in known.rules
        ],
    }


def _names(iris: Sequence[str], scene: OpenScene) -> str:
    return ", ".join(map(scene.state.vocabulary.short, iris))


def _cell_text(cell: QueryValue) -> str:
    if isinstance(cell, bool):
        return show(cell)
    return "" if cell is None else str(cell)


def _json(value: Any) -> str:
    return json.dumps(value, indent=2)
