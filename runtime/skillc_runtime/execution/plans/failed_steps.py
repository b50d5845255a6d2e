"""Steps of plans that failed, so that none is repeated in a way that can only fail again."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import isclose

import msgspec
from msgspec import structs

from skillc_model.read_write import FactPattern, facts_read
from skillc_model.skills import SkillLibrary
from skillc_runtime.planning.plan import Step
from skillc_runtime.planning.validation import PlanError, apply_step, find_startable_implementations
from skillc_runtime.planning.world_changes import find_changed_facts
from skillc_runtime.recording.failure import Failure
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

NOISE = 1e-4
"""By how much a number may differ and count as unchanged, relative or in SI units: lengths by a tenth of a millimetre.

Whoever wrote it: two measurements of the same thing differ by about as much.
"""


class FailedStep(msgspec.Struct, frozen=True):
    """A call with the implementation that failed, the state of the world in which it started, and its failure.

    `writes` is the number of writes to the world model until it failed.
    """

    step: Step
    implementation: str
    state: WorldState
    failure: Failure
    writes: int


class FailedSteps:
    """The steps that failed in the attempts at one goal.

    An implementation that failed for some arguments is not tried for them again until a fact changes that the skill
    reads, or that is about one of the arguments: a primitive may read anything about them. A number has not
    changed if it differs by no more than NOISE. Where only space was lacking, nothing counts but that something,
    whatever it is, stands elsewhere, or that something else is held.
    """

    def __init__(self, library: SkillLibrary) -> None:
        self.library = library
        self._failed: list[FailedStep] = []

    @property
    def steps(self) -> tuple[Step, ...]:
        """The steps that failed, each once."""
        found: list[Step] = []
        for each in self._failed:
            if each.step not in found:
                found.append(each.step)
        return tuple(found)

    @property
    def failed(self) -> tuple[FailedStep, ...]:
        """The calls that failed, with each of their implementations."""
        return tuple(self._failed)

    @property
    def failures(self) -> tuple[Failure, ...]:
        """The failures of all steps, each once and named after its implementation."""
        named = (
            structs.replace(each.failure, alternative=f"{each.step.skill}[{each.implementation}]")
            for each in self._failed
        )
        return tuple({(each.alternative, each.message): each for each in named}.values())

    def add(
        self,
        skill: str,
        arguments: Mapping[str, Value],
        implementation: str,
        state: WorldState,
        failure: Failure,
        writes: int,
    ) -> None:
        """Remember that an implementation failed, after so many writes, for a call that started in `state`."""
        self._failed.append(FailedStep(_step_of(skill, arguments), implementation, state, failure, writes))

    def forget_call(self, skill: str, arguments: Mapping[str, Value]) -> None:
        """Forget the implementations that failed for a call, because another one succeeded."""
        self.forget((_step_of(skill, arguments),))

    def forget(self, steps: Sequence[Step]) -> None:
        """Let steps be tried again, because somebody has decided so."""
        self._failed = [each for each in self._failed if each.step not in steps]

    def find_repeated(
        self, skill: str, arguments: Mapping[str, Value], implementation: str, state: WorldState
    ) -> Failure | None:
        """Return the failure that an implementation would only repeat for these arguments; None if it may be tried."""
        for each in self._failed:
            same = each.step.skill == skill and each.implementation == implementation
            if same and each.step.arguments == arguments and not self._has_changed(each, state):
                return each.failure
        return None

    def find_repeated_steps(self, steps: Sequence[Step], state: WorldState) -> tuple[Step, ...]:
        """Return the steps of a plan, which starts in `state`, that can only fail again."""
        found: list[Step] = []
        for step in steps:
            try:
                possible = find_startable_implementations(step, self.library, state)
                if all(self.find_repeated(step.skill, step.arguments, each.name, state) for each in possible):
                    found.append(step)
                state = apply_step(step, self.library, state)
            except (PlanError, EvaluationError):
                break
        return tuple(found)

    def _has_changed(self, failed: FailedStep, state: WorldState) -> bool:
        if failed.failure.lacks_space:
            # Whoever only plans needs no numpy.
            from skillc_runtime.planning.moved_things import has_moved

            return has_moved(failed.state, state)
        found = find_changed_facts(failed.state, state)
        changed = [each for each in found if not _is_noise(each, failed.state, state)]
        about = set(failed.step.arguments.values())
        return any(
            not about.isdisjoint((fact.subject, fact.object)) or any(fact.meets(read) for read in self._reads(failed))
            for fact in changed
        )

    def _reads(self, failed: FailedStep) -> Iterator[FactPattern]:
        step = failed.step
        implementation = self.library.implementations[f"{step.skill}.{failed.implementation}"]
        skill = self.library.skills[step.skill]
        for requirement in (*skill.pre, *skill.hold, *implementation.pre, *implementation.hold):
            yield from facts_read(requirement.condition, step.arguments, failed.state.vocabulary)


def _is_noise(fact: FactPattern, before: WorldState, after: WorldState) -> bool:
    """Whether a fact in which two versions of the world differ is a number that differs by no more than NOISE."""
    if fact.term is None or fact.subject is None or fact.object is not None:
        return False
    one, other = before.value(fact.subject, fact.term), after.value(fact.subject, fact.term)
    if not isinstance(one, float) or not isinstance(other, float):
        return False
    return isclose(one, other, rel_tol=NOISE, abs_tol=NOISE)


def _step_of(skill: str, arguments: Mapping[str, Value]) -> Step:
    return Step(skill, {name: value for name, value in arguments.items() if isinstance(value, str)})
