"""Reports the skills that planners leave out, and the construct that is the reason."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import partial

from skillc_compiler.checks.planning import UNPLANNABLE, check_skill
from skillc_compiler.program import typed
from skillc_compiler.program.program import Program
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.query import Memo
from skillc_model.declared import implement_all
from skillc_model.pddl.devices import passed_on
from skillc_model.pddl.domain import Excluded
from skillc_model.pddl.planning import make_planning_domain
from skillc_model.planning_view import encode_view
from skillc_model.skills import Skill, SkillLibrary
from skillc_rdf.vocabulary.types import Vocabulary


def report_unplannable(
    library: SkillLibrary, program: Program, problems: Iterable[Diagnostic], memo: Memo | None = None
) -> Iterator[Diagnostic]:
    """Yield a warning for each skill that no plan can contain, unless its description alone already shows why.

    Skills without implementations do what they declare, as they run where nothing has a body. If there is an error,
    nothing is planned, so nothing is reported.
    """
    if any(problem.severity == "error" for problem in problems) or _has_class_cycle(library.vocabulary):
        return
    for excluded in _find_excluded(library, memo) if memo else _exclude(library):
        skill = program.skills[excluded.skill]
        if not any(check_skill(program, skill)):
            yield _problem(skill, excluded)


def _find_excluded(library: SkillLibrary, memo: Memo) -> tuple[Excluded, ...]:
    """Return the skills that planners leave out: the same as in the analysis before if they read the same."""
    read = read_views(library, memo), library.vocabulary
    return memo.ask("unplannable", read, lambda: _exclude(library))


def _exclude(library: SkillLibrary) -> tuple[Excluded, ...]:
    return make_planning_domain(implement_all(library)).excluded


def read_views(library: SkillLibrary, memo: Memo) -> tuple[object, ...]:
    """Return what planners, and checks of scenes, read of all skills besides bodies: the same object if it is equal."""
    views = (
        memo.ask("planning view", (skill, *library.implementations_of(name)), partial(_view, library, skill))
        for name, skill in library.skills.items()
    )
    return memo.same("planning views", library.name, tuple(views))


def _view(library: SkillLibrary, skill: Skill) -> tuple[object, ...]:
    implementations = library.implementations_of(skill.name)
    return encode_view(skill, implementations), tuple(passed_on(skill, implementations))


def _has_class_cycle(vocabulary: Vocabulary) -> bool:
    """Whether the class hierarchy has a cycle, so that PDDL types cannot be derived."""
    return any(vocabulary.is_a(parent, iri) for iri, term in vocabulary.classes.items() for parent in term.parents)


def _problem(skill: typed.Skill, excluded: Excluded) -> Diagnostic:
    written = (r.condition.span for r in skill.requirements if r.text == excluded.requirement)
    return Diagnostic(
        UNPLANNABLE,
        next(written, skill.name_span),
        f"planners leave `{skill.name}` out: {excluded.reason}",
        help=f"{_suggest_planner(excluded)}; rewrite it, or add `noplan`",
        severity="warning",
    )


def _suggest_planner(excluded: Excluded) -> str:
    """Return which planners support the construct."""
    if excluded.numeric:
        return "numeric planners such as ENHSP support it; Fast Downward and the built-in search do not"
    return "no PDDL planner supports it"
