"""What planners leave out changes nothing of what they plan with, although the domain is then computed another way."""

from __future__ import annotations

import pytest
from shipped import SKILLS, library, shelf, vocabulary

from skillc_compiler.pipeline import compile
from skillc_dsl.source import Source
from skillc_model.pddl.domain import PlanningDomain
from skillc_model.pddl.planning import make_planning_domain

LEFT_OUT = """use skiros, skillc

skill Compare {
    in   place: Location
    in   other: Location
    pre  place.ContainerState == other.ContainerState
    post place.ContainerState == "Full"
}

impl by_hand of Compare {
    run python "skillc.primitives:StandIn"
}
"""
LIBRARIES = sorted(path.name for path in SKILLS.iterdir() if path.is_dir() and library(path.name))


def domain(sources: list[Source]) -> PlanningDomain:
    """Return the domain of a library without errors."""
    outcome = compile(sources, vocabulary(), shelf(), "own")
    assert outcome.ok, outcome.diagnostics
    return make_planning_domain(outcome.value)


@pytest.mark.parametrize("name", LIBRARIES)
def test_a_skill_that_is_left_out_changes_nothing_of_the_others(name: str) -> None:
    alone, beside = domain(library(name)), domain([*library(name), Source("more.skill", LEFT_OUT)])
    assert alone.excluded == ()
    assert [each.skill for each in beside.excluded] == ["Compare"]
    assert (beside.actions, beside.predicates) == (alone.actions, alone.predicates)
