"""What a skill's page says of its flags and pauses."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_dsl.descriptions.members import FLAGS
from skillc_model.format_type import format_quantity
from skillc_model.skills import PausePolicy, Skill
from skillc_rdf.vocabulary.types import NumberType

PLACES = {
    "anywhere": "may be paused at any time",
    "between steps": "may be paused only before one of its steps starts",
    "never": "is not paused while it runs: a pause waits for its end",
}


def describe_pause(policy: PausePolicy) -> str:
    """Return what a policy says, as a clause whose subject is the skill; an empty string if it states nothing."""
    if policy == PausePolicy():
        return ""
    if policy.keep_s is None:
        return PLACES[policy.where]
    after = f"after {format_quantity(policy.keep_s, NumberType('Time'))}" if policy.keep_s else "at once"
    return f"{PLACES[policy.where]}; a tool that presses is then taken off {after}"


def describe_flags(skill: Skill) -> Iterator[str]:
    """Yield a sentence for each flag that a skill has."""
    return (flag.page for flag in FLAGS if getattr(skill, flag.field) is flag.value)
