"""Steps of plans that failed: none is tried again in a way that can only fail again."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from skillc_compiler.library.skills import SkillLibrary
from skillc_runtime.planning.plan import Step
from skillc_runtime.planning.validation import PlanError, apply_step, find_startable_implementations
from skillc_runtime.plans.touched import Fact, changed_between, read_by
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class FailedStep:
    """A call with the implementation that failed, the version of the world in which it began, and why it failed."""

    step: Step
    implementation: str
    state: WorldState
    why: str


class Failures:
    """What failed in the attempts at one goal.

    An implementation that failed for some arguments is not taken for them again until something changes that the skill
    reads, or that is said of one of the arguments: a primitive may read anything about them.
    """

    def __init__(self, library: SkillLibrary) -> None:
        self._library = library
        self._failed: list[FailedStep] = []

    @property
    def steps(self) -> tuple[Step, ...]:
        """The steps that failed, each once."""
        found: list[Step] = []
        for each in self._failed:
            if each.step not in found:
                found.append(each.step)
        return tuple(found)

    def add(self, skill: str, arguments: Mapping[str, Value], implementation: str, state: WorldState, why: str) -> None:
        """Remember an implementation that failed for a call which began in a version of the world."""
        named = {name: value for name, value in arguments.items() if isinstance(value, str)}
        self._failed.append(FailedStep(Step(skill, named), implementation, state, why))

    def reason(self, skill: str, arguments: Mapping[str, Value], implementation: str, state: WorldState) -> str | None:
        """Return why an implementation would fail again, None where it may be taken."""
        for each in self._failed:
            same = each.step.skill == skill and each.implementation == implementation
            if same and each.step.arguments == arguments and not self._has_changed(each, state):
                return f"it has failed, and nothing that it depends on has changed since: {each.why}"
        return None

    def repeated(self, steps: Sequence[Step], state: WorldState) -> tuple[Step, ...]:
        """Return the steps of a plan, to be followed from a version of the world, that can only fail again."""
        found: list[Step] = []
        for step in steps:
            try:
                possible = find_startable_implementations(step, self._library, state)
                if all(self.reason(step.skill, step.arguments, each.name, state) for each in possible):
                    found.append(step)
                state = apply_step(step, self._library, state)
            except (PlanError, EvaluationError):
                break
        return tuple(found)

    def listed(self) -> str:
        """Return all that failed, with the reasons, in words."""
        return "; ".join(dict.fromkeys(map(self._described, self._failed)))

    def _described(self, failed: FailedStep) -> str:
        short = failed.state.vocabulary.short
        arguments = ", ".join(f"{name}: {short(iri)}" for name, iri in failed.step.arguments.items())
        return f"{failed.step.skill}[{failed.implementation}]({arguments}): {failed.why}"

    def _has_changed(self, failed: FailedStep, state: WorldState) -> bool:
        changed = tuple(changed_between(failed.state, state))
        about = set(failed.step.arguments.values())
        return any(
            not about.isdisjoint((fact.subject, fact.object)) or any(fact.meets(read) for read in self._reads(failed))
            for fact in changed
        )

    def _reads(self, failed: FailedStep) -> Iterator[Fact]:
        step = failed.step
        implementation = self._library.implementations[f"{step.skill}.{failed.implementation}"]
        skill = self._library.skills[step.skill]
        for requirement in (*skill.pre, *skill.hold, *implementation.pre, *implementation.hold):
            yield from read_by(requirement.condition, step.arguments, failed.state)
