"""Translates a compiled library into a planning domain.

A skill that a planner cannot handle is excluded with the reason; no skill is dropped silently.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

import msgspec
from msgspec import structs

from skillc_model.chains import unroll_for_any_scene
from skillc_model.counting import write_out_changing_counts
from skillc_model.definitions import expand_for_any_scene
from skillc_model.foresight import foresee_effects
from skillc_model.levelling import level_library
from skillc_model.pddl.actions import PlannedSkill, make_actions
from skillc_model.pddl.constants import Mention, assumed_classes, find_mentions, missing_individuals
from skillc_model.pddl.costs import common_scale
from skillc_model.pddl.devices import locked_parameters
from skillc_model.pddl.domain import Excluded, FixedCost, PlanningDomain, Predicate
from skillc_model.pddl.formulas import Typed
from skillc_model.pddl.hierarchy import Hierarchy
from skillc_model.pddl.kebab import to_kebab
from skillc_model.pddl.names import assign_names
from skillc_model.pddl.symbols import Symbols
from skillc_model.pddl.translate import Impossible, NamedIndividual, NeedsNumbers, Untranslatable
from skillc_model.pddl.typed import action_terms, typed_atoms
from skillc_model.read_write import terms_written
from skillc_model.skills import Skill, SkillLibrary


class _Attempt(msgspec.Struct, frozen=True):
    """The actions that could be built under the assumption that skills change only the terms `changing`."""

    symbols: Symbols
    objects: Mapping[str, NamedIndividual]
    planned: tuple[PlannedSkill, ...]
    excluded: tuple[Excluded, ...]


def make_planning_domain(
    library: SkillLibrary,
    combined: Collection[frozenset[str]] = (),
    individuals: Mapping[str, frozenset[str]] | None = None,
) -> PlanningDomain:
    """Return the library as a planning domain.

    `combined` are the sets of classes of individuals of the scene that have several, none a subclass of another.
    `individuals` are those of the scene that skills name, with their most specific classes; None (no scene) assumes
    that all exist and are of the classes that the skills require. The terms that the remaining skills change decide
    what is static, which decides what skills can be planned with, so the result is computed as a fixed point.
    """
    library = expand_for_any_scene(write_out_changing_counts(library))
    library, settled = unroll_for_any_scene(foresee_effects(library)), individuals is not None
    library = library if settled else level_library(library).library
    named = find_mentions(library)
    if individuals is None:
        individuals = assumed_classes((each for found in named.values() for each in found), library.vocabulary)
        combined = {*combined, *(each for each in individuals.values() if len(each) > 1)}
    names = library.names if individuals.keys() <= set(library.names.values()) else {}
    names = names or assign_names(library)
    by_term = {term: name for name, term in names.items()}
    hierarchy = Hierarchy(library.vocabulary, by_term, combined)
    objects = {
        iri: NamedIndividual(Typed(by_term[iri], hierarchy.type_of(each)), each) for iri, each in individuals.items()
    }
    excluded = (*_unnamed(library, named, objects), *_left_open(library))
    out = {each.skill for each in excluded}
    skills = [skill for name, skill in sorted(library.skills.items()) if skill.planned and name not in out]
    locked = locked_parameters(library)

    def attempt(chosen: Sequence[Skill], changing: frozenset[str]) -> _Attempt:
        symbols = Symbols(library.vocabulary, names, hierarchy, changing, settled)
        return _try(chosen, library, symbols, objects, locked)

    tried = attempt(skills, _terms_written(skills, library))
    if tried.excluded:  # else fewer changing terms exclude nothing either
        tried, excluded = _find_fixed_point(skills, excluded, library, attempt)
    return replace(_domain(library.name, tried, excluded), combined=frozenset(combined))


def _find_fixed_point(
    skills: Sequence[Skill],
    excluded: tuple[Excluded, ...],
    library: SkillLibrary,
    attempt: Callable[[Sequence[Skill], frozenset[str]], _Attempt],
) -> tuple[_Attempt, tuple[Excluded, ...]]:
    """Return the attempt with the skills that remain when only these change terms, and all that are excluded."""
    changing = frozenset[str]()
    while True:
        tried = attempt(skills, changing)
        left_out = {each.skill for each in tried.excluded}
        skills = [skill for skill in skills if skill.name not in left_out]
        excluded += tried.excluded
        now = _terms_written(skills, library)
        if now == changing and not left_out:
            return tried, excluded
        changing = now


def _terms_written(skills: Iterable[Skill], library: SkillLibrary) -> frozenset[str]:
    return terms_written((each for skill in skills for each in skill.results), library.vocabulary)


def _unnamed(
    library: SkillLibrary, named: Mapping[str, Sequence[Mention]], objects: Mapping[str, NamedIndividual]
) -> Iterator[Excluded]:
    """Yield the skills that name individuals which are not in the scene."""
    for skill, found in named.items():
        missing = [
            f"`{library.vocabulary.short(each.individual)}` ({each.source})"
            for each in missing_individuals(found, objects)
        ]
        if missing:
            verb = "is" if len(missing) == 1 else "are"
            reason = f"it names {', '.join(missing)}, which {verb} not in the scene"
            yield Excluded(skill, reason, library.skills[skill].source)


def _left_open(library: SkillLibrary) -> Iterator[Excluded]:
    """Yield the skills after which something is only possible: no plan can count on it, nor on what was before."""
    for name, skill in sorted(library.skills.items()):
        if skill.planned and skill.possible:
            what = skill.possible[0].text
            reason = f"after it `{what}` is possible only, so no plan can count on it or its opposite"
            yield Excluded(name, reason, skill.source, requirement=what)


def _try(
    skills: Sequence[Skill],
    library: SkillLibrary,
    symbols: Symbols,
    objects: Mapping[str, NamedIndividual],
    locked: Mapping[str, Collection[str]],
) -> _Attempt:
    action_names = {term: name for name, term in symbols.names.items()}
    planned, excluded, taken = [], [], set(symbols.names)
    for skill in skills:
        implementations = library.implementations_of(skill.name)
        try:
            name = action_names[skill.name]
            made = make_actions(name, skill, implementations, symbols, objects, locked[skill.name], taken)
            planned.append(made)
            taken |= made.names
        except Untranslatable as reason:
            excluded.append(_excluded(skill, reason))
    return _Attempt(symbols, objects, tuple(planned), tuple(excluded))


def _excluded(skill: Skill, reason: Untranslatable) -> Excluded:
    impossible, numeric = isinstance(reason, Impossible), isinstance(reason, NeedsNumbers)
    return Excluded(skill.name, str(reason), skill.source, impossible, numeric, reason.requirement)


def _domain(name: str, last: _Attempt, excluded: Iterable[Excluded]) -> PlanningDomain:
    guards = [guard for each in last.planned for guard in each.guards]
    constants = {each.object.name: each.object for each in last.objects.values()}
    actions = tuple(action for each in last.planned for action in each.actions)
    used = {name for action in actions for name in action_terms(action) & constants.keys()}
    predicates = (*_facts(last, constants, {each.name for each in guards}), *guards)
    return PlanningDomain(
        name=to_kebab(name),
        types=last.symbols.hierarchy.types,
        predicates=tuple(sorted(predicates, key=lambda each: each.name)),
        costs=tuple(cost for each in last.planned for cost in each.costs),
        actions=actions,
        excluded=tuple(sorted(excluded, key=lambda each: each.skill)),
        names=last.symbols.names,
        scale=common_scale(each.cost.seconds for each in actions if isinstance(each.cost, FixedCost)),
        constants=tuple(constants[name] for name in sorted(used)),
    )


def _facts(last: _Attempt, constants: Mapping[str, Typed], guards: Collection[str]) -> list[Predicate]:
    """Return the predicates that actions use, with parameter types wide enough for every use."""
    found: dict[str, Predicate] = {}
    join = last.symbols.hierarchy.join
    objects = {each.name: each.type for each in constants.values()}
    for action in (action for each in last.planned for action in each.actions):
        for atom, types in typed_atoms(action, objects):
            if atom.predicate not in guards:
                declared = found.get(atom.predicate) or last.symbols.predicate(atom.predicate)
                pairs = zip(declared.parameters, types, strict=True)
                wide = tuple(Typed(one.name, join(one.type, type_)) for one, type_ in pairs)
                found[atom.predicate] = structs.replace(declared, parameters=wide)
    return list(found.values())
