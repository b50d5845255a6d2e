"""Reports violations of axioms and of scene checks at their statements."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence

from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_dsl.position import Position
from skillc_dsl.source import Span
from skillc_rdf.turtle.statements import Statement
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_runtime.scene.checks.containment import check_containment
from skillc_runtime.scene.checks.data_sheets import check_data_sheets
from skillc_runtime.scene.checks.dirt_maps import check_dirt_maps
from skillc_runtime.scene.checks.frames import check_frames
from skillc_runtime.scene.checks.plausible import check_plausible
from skillc_runtime.scene.checks.required import check_required
from skillc_runtime.scene.checks.surface_regions import check_surface_regions
from skillc_runtime.scene.mistakes import LocatedChange
from skillc_runtime.scene.ontology_individuals import check_enumerations
from skillc_runtime.scene.statements import iri_of
from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.state.consistency.axiom_violations import (
    CONTAINMENT_CIRCLE,
    AxiomViolation,
    axiom_violations,
    standalone_violation,
)
from skillc_runtime.world.state.facts import IriTriple
from skillc_runtime.world.state.world_state import WorldState

MUTUAL_AXIOMS = frozenset({"functional-relation", "asymmetric-relation", "disjoint-classes"})
"""Axioms that two statements violate together, both equally."""


def report_axiom_violations(state: WorldState, written: Sequence[LocatedChange]) -> Iterator[Diagnostic]:
    """Yield each violation of an axiom once; `state` is the world after all changes.

    If a statement violates an axiom by itself, its conflicts with other statements are not reported.
    """
    places = {fact: statement for change, statement in reversed(written) if (fact := _fact(change)) is not None}
    reported: set[tuple[str, frozenset[IriTriple]]] = set()
    for change, statement in written:
        for violation in _violations(state, change):
            facts = _violating_facts(violation, _fact(change))
            if violation.axiom in MUTUAL_AXIOMS:
                if (violation.axiom, facts) in reported or any(_violates_alone(state, each) for each in facts):
                    continue
                reported.add((violation.axiom, facts))
            yield _axiom_problem(
                state, violation, statement, [places[fact] for fact in facts if fact in places], places
            )


def _violations(state: WorldState, change: Change) -> Iterator[AxiomViolation]:
    """Yield the violations of a change; for a functional relation, preferably one that the change violates alone."""
    for violation in axiom_violations(state, change):
        match change:
            case _ if violation.axiom == CONTAINMENT_CIRCLE:
                pass  # each circle is reported once, by a check of its own
            case AddRelation(subject, relation, object_) if violation.axiom == "functional-relation":
                yield standalone_violation(state, (subject, relation, object_)) or violation
            case _:
                yield violation


def _violates_alone(state: WorldState, fact: IriTriple) -> bool:
    """Whether a fact violates an axiom by itself."""
    return fact[1] in state.vocabulary.relations and standalone_violation(state, fact) is not None


def _violating_facts(violation: AxiomViolation, own: IriTriple | None) -> frozenset[IriTriple]:
    """Return the facts that violate the axiom together."""
    if own is None or own in violation.conflicting or violation.axiom == "disjoint-classes":
        return frozenset(violation.conflicting)
    return frozenset({own, *violation.conflicting})


def _axiom_problem(
    state: WorldState,
    violation: AxiomViolation,
    own: Statement,
    conflicting: Sequence[Statement],
    places: Mapping[IriTriple, Statement],
) -> Diagnostic:
    if violation.axiom in MUTUAL_AXIOMS and conflicting:
        first, *others = sorted((each.object_place for each in conflicting), reverse=True)
    else:
        first, others = _violating_term(violation, own), []
    notes = [Label(place, "also stated here") for place in others]
    notes += (Label(places[fact].object_place, "its class") for fact in violation.causes if fact in places)
    return Diagnostic(
        violation.axiom, first, violation.message, _help(violation), labels=(*notes, *_declared(state, violation, own))
    )


def _violating_term(violation: AxiomViolation, own: Statement) -> Span:
    """Return the position of the wrong term: the predicate if the subject does not fit it, else the object."""
    subject_is_wrong = violation.mistyped is not None and violation.mistyped == iri_of(own.subject)
    return own.predicate_place if subject_is_wrong and violation.mistyped != iri_of(own.object) else own.object_place


def _help(violation: AxiomViolation) -> str:
    return "keep one of them" if violation.axiom in MUTUAL_AXIOMS else ""


def _declared(state: WorldState, violation: AxiomViolation, own: Statement) -> Iterator[Label]:
    """Yield where the vocabulary declares a relation or property."""
    terms = state.vocabulary.relations.get(own.predicate) or state.vocabulary.properties.get(own.predicate)
    source: Position | None = terms.source if terms is not None and violation.causes else None
    if source is not None:
        yield Label(Span(source.path, source.line, source.column, source.line, source.column + 1), "declared here")


def _fact(change: Change) -> IriTriple | None:
    """Return the relation or class that a change writes."""
    match change:
        case AddIndividual(individual, (cls,)):
            return individual, RDF_TYPE, cls
        case AddRelation(subject, relation, object_):
            return subject, relation, object_
        case SetProperty(individual, property_, _):
            return individual, property_, ""
        case _:
            return None


def check_individuals(state: WorldState) -> Iterator[SceneViolation]:
    """Yield the violations of checks that need no poses; of worlds without bodies those that concern none."""
    of_bodies = () if state.vocabulary.symbolic else (check_required, check_plausible, check_data_sheets)
    for check in (check_containment, check_enumerations, check_dirt_maps, *of_bodies):
        yield from check(state)


def check_placement(state: WorldState) -> Iterator[SceneViolation]:
    """Yield the violations of frames and poses; regions of surfaces are checked if there are none.

    Worlds without bodies have neither.
    """
    if state.vocabulary.symbolic:
        return
    misplaced = list(check_frames(state))
    yield from misplaced or check_surface_regions(state)


def report_scene_violations(
    state: WorldState,
    said: Sequence[Statement],
    problems: Collection[Diagnostic],
    doubtful: Collection[str],
    partly: Collection[str] = (),
) -> Iterator[Diagnostic]:
    """Yield the violations of individuals all of whose statements are valid.

    Of `partly` individuals, a value or object of a known property or relation is not understood. Frames and poses are
    checked only when there is no other error, which may be the cause of a missing frame.
    """
    errors = [each for each in problems if each.severity == "error"]
    with_problems = {*doubtful, *partly, *_subjects(said, errors)}
    found = [*check_individuals(state), *(check_placement(state) if not errors and not doubtful else ())]
    places = {(iri_of(each.subject), each.predicate): each for each in reversed(said)}
    for violation in found:
        if violation.individual not in with_problems:
            place = _statement_place(violation, places)
            yield Diagnostic(violation.name, place, violation.message, violation.help, violation.severity)


def _subjects(said: Sequence[Statement], problems: Collection[Diagnostic]) -> Iterator[str]:
    """Yield the individuals with problems in their statements."""
    if not problems:
        return
    wrong = {problem.span for problem in problems}
    for each in said:
        if not wrong.isdisjoint((each.subject_place, each.predicate_place, each.object_place)):
            yield iri_of(each.subject)


def _statement_place(violation: SceneViolation, places: dict[tuple[str, str], Statement]) -> Span:
    if violation.predicate is not None:
        return places[violation.individual, violation.predicate].object_place
    return places[violation.individual, RDF_TYPE].subject_place
