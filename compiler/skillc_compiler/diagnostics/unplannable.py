"""Reports the skills that planners leave out, and the construct that is the reason."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from skillc_compiler.checks.planning import UNPLANNABLE, check_skill
from skillc_compiler.program.typed import Program, Skill
from skillc_dsl.diagnostics import Diagnostic
from skillc_model.pddl.domain import Excluded
from skillc_model.pddl.planning import make_planning_domain
from skillc_model.skills import SkillLibrary
from skillc_rdf.vocabulary.types import Vocabulary

COUNTING = ("compares", "no finite", "known only at run time")


def report_unplannable(library: SkillLibrary, program: Program, problems: Iterable[Diagnostic]) -> Iterator[Diagnostic]:
    """Yield a warning for each skill that no plan can contain, unless its description alone already shows why.

    If there is an error, nothing is planned, so nothing is reported.
    """
    if any(problem.severity == "error" for problem in problems) or _has_class_cycle(library.vocabulary):
        return
    for excluded in make_planning_domain(library).excluded:
        skill = program.skills[excluded.skill]
        if program.implementations_of[skill.name] and not any(check_skill(program, skill)):
            yield _problem(skill, excluded)


def _has_class_cycle(vocabulary: Vocabulary) -> bool:
    """Whether the class hierarchy has a cycle, so that PDDL types cannot be derived."""
    return any(vocabulary.is_a(parent, iri) for iri, term in vocabulary.classes.items() for parent in term.parents)


def _problem(skill: Skill, excluded: Excluded) -> Diagnostic:
    written = (r.condition.span for r in skill.requirements if f"`{r.text}`" in excluded.reason)
    return Diagnostic(
        UNPLANNABLE,
        next(written, skill.name_span),
        f"planners leave `{skill.name}` out: {excluded.reason}",
        help=f"{_suggest_planner(excluded.reason)}; rewrite it, or add `noplan`",
        severity="warning",
    )


def _suggest_planner(reason: str) -> str:
    """Return which planners support the construct."""
    if any(words in reason for words in COUNTING):
        return "numeric planners such as ENHSP support it; Fast Downward and the built-in search do not"
    return "no PDDL planner supports it"
