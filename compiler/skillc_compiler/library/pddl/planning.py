"""From a compiled library to a planning domain.

A skill that a planner cannot reason about is left out with the reason: nothing is dropped silently.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass

from skillc_compiler.library.pddl.actions import Planned, planned_actions
from skillc_compiler.library.pddl.costs import common_scale
from skillc_compiler.library.pddl.devices import devices
from skillc_compiler.library.pddl.domain import Excluded, FixedCost, PlanningDomain, Predicate
from skillc_compiler.library.pddl.effects import changed_terms
from skillc_compiler.library.pddl.formulas import atoms
from skillc_compiler.library.pddl.hierarchy import Hierarchy
from skillc_compiler.library.pddl.names import kebab, pddl_names
from skillc_compiler.library.pddl.relations import Relations
from skillc_compiler.library.pddl.symbols import Symbols
from skillc_compiler.library.pddl.translate import Untranslatable
from skillc_compiler.library.skills import Skill, SkillLibrary


@dataclass(frozen=True)
class _Round:
    """What could be planned with when `changing` was taken for all that skills change."""

    symbols: Symbols
    planned: tuple[Planned, ...]
    excluded: tuple[Excluded, ...]


def planning_domain(library: SkillLibrary, combined: Collection[frozenset[str]] = ()) -> PlanningDomain:
    """Return the library as a planning domain.

    `combined` are the sets of classes of those individuals of the scene that have several, none below another.
    What the skills left over change decides what is static, which decides what can be planned with: a fixed point.
    """
    names = library.names or pddl_names(library)
    hierarchy = Hierarchy(library.vocabulary, {term: name for name, term in names.items()}, combined)
    relations = Relations(library.vocabulary)
    skills = [skill for _, skill in sorted(library.skills.items()) if skill.planned]
    excluded: tuple[Excluded, ...] = ()
    changing: frozenset[str] = frozenset()
    while True:
        symbols = Symbols(library.vocabulary, names, hierarchy, relations, changing)
        tried = _try(skills, library, symbols)
        left_out = {each.skill for each in tried.excluded}
        skills = [skill for skill in skills if skill.name not in left_out]
        excluded += tried.excluded
        now = frozenset().union(*(changed_terms(skill.post, relations) for skill in skills))
        if now == changing and not left_out:
            return _domain(library.name, tried, excluded)
        changing = now


def _try(skills: Sequence[Skill], library: SkillLibrary, symbols: Symbols) -> _Round:
    action_names = {term: name for name, term in symbols.names.items()}
    locked = devices(library)
    planned, excluded, taken = [], [], set(symbols.names)
    for skill in skills:
        implementations = library.implementations_of(skill.name)
        try:
            name = action_names[skill.name]
            made = planned_actions(name, skill, implementations, symbols, locked[skill.name], taken)
            planned.append(made)
            taken |= made.names
        except Untranslatable as reason:
            excluded.append(Excluded(skill.name, str(reason), skill.source))
    return _Round(symbols, tuple(planned), tuple(excluded))


def _domain(name: str, last: _Round, excluded: Iterable[Excluded]) -> PlanningDomain:
    guards = [guard for each in last.planned for guard in each.guards]
    actions = tuple(action for each in last.planned for action in each.actions)
    return PlanningDomain(
        name=kebab(name),
        types=last.symbols.hierarchy.types,
        predicates=tuple(sorted((*_facts(last, {each.name for each in guards}), *guards), key=lambda each: each.name)),
        costs=tuple(cost for each in last.planned for cost in each.costs),
        actions=actions,
        excluded=tuple(sorted(excluded, key=lambda each: each.skill)),
        names=last.symbols.names,
        scale=common_scale(each.cost.seconds for each in actions if isinstance(each.cost, FixedCost)),
    )


def _facts(last: _Round, guards: Collection[str]) -> list[Predicate]:
    used: set[str] = set()
    for action in (action for each in last.planned for action in each.actions):
        formulas = (action.precondition, action.hold, *(change.atom for change in action.effects))
        used |= {atom.predicate for formula in formulas for atom in atoms(formula)}
    return [last.symbols.predicate(name) for name in used if name not in guards]
