"""Emits domain.pddl and domain.temporal.pddl, the planning domains."""

from __future__ import annotations

from skillc_model.pddl.planning import make_planning_domain
from skillc_model.pddl.pruning import prune_unread_values
from skillc_model.pddl.text import format_domain, format_temporal_domain
from skillc_model.skills import SkillLibrary


def emit(library: SkillLibrary) -> dict[str, str]:
    """Return the classical and the temporal domain."""
    domain = prune_unread_values(make_planning_domain(library))
    return {"domain.pddl": format_domain(domain), "domain.temporal.pddl": format_temporal_domain(domain)}
