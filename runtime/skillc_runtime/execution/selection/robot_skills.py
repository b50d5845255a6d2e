"""Finds which robots have the hardware for which implementations, by the check that comes before anything moves."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from itertools import chain, islice, product

from skillc_model import tree
from skillc_model.conditions import Expression, Individual, Variable
from skillc_model.skills import Implementation, Parameter, Skill, SkillLibrary
from skillc_rdf.vocabulary.types import ClassType
from skillc_runtime.execution.selection.preflight import preflight
from skillc_runtime.execution.selection.refusal import Refusal
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.terms import DEVICE, HAS_A, ROBOT
from skillc_runtime.world.state.world_state import WorldState

PASSED = ("in", "infer")
"""Directions of the parameters whose arguments are checked."""
MOST_TRIED = 64
"""How many choices of devices are tried: of those that a robot may use, and of those with devices of other robots."""


@dataclass(frozen=True, slots=True)
class RobotImplementation:
    """A robot and an implementation of a skill; `why_not` says why its hardware does not fit, empty if it does."""

    robot: str
    implementation: Implementation
    why_not: str


def match_robots(library: SkillLibrary, state: WorldState) -> Iterator[RobotImplementation]:
    """Yield each robot of a world with each implementation of a library, by robot and skill, in rank order.

    The robot and its devices are the arguments of a call, which is checked as a body is before anything moves; all
    other arguments are not known. What belongs to no robot, such as a camera of the cell, may be used by each. Devices
    of another robot are used only beside the robot's own, where a skill takes several of a class.
    """
    robots = sorted(state.instances(ROBOT))
    owners = {part: robot for robot in robots for part in _parts_of(robot, state)}
    skills = sorted(library.skills.items())
    for robot in robots:
        devices = _RobotDevices(robot, owners, state)
        for _, skill in skills:
            for each in library.implementations_of(skill.name):
                yield RobotImplementation(robot, each, _explain_misfit(skill, each, library, devices))


@dataclass(frozen=True, slots=True)
class _RobotDevices:
    """A robot in a world, and the robots to which devices belong."""

    robot: str
    owners: Mapping[str, str]
    state: WorldState

    def of_class(self, cls: str) -> list[str]:
        """Return the devices of a class that the robot may use: its own, then those of no robot."""
        every = sorted(self.state.instances(cls))
        own = [each for each in every if self.owners.get(each) == self.robot]
        return own + [each for each in every if each not in self.owners]

    def are_shared(self, chosen: Collection[str]) -> bool:
        """Whether some devices are the robot's, and others another robot's."""
        owners = {self.owners.get(each, self.robot) for each in chosen}
        return len(owners) > 1 and any(self.owners.get(each) == self.robot for each in chosen)

    def of_others(self, cls: str) -> list[str]:
        """Return the devices of a class that belong to other robots."""
        return [each for each in sorted(self.state.instances(cls)) if self.owners.get(each, self.robot) != self.robot]


def _parts_of(robot: str, state: WorldState) -> list[str]:
    """Return a robot and everything that it has, at whatever depth."""
    found = [robot]
    for each in found:  # grows while it is read
        found += [part for part in sorted(state.objects(each, HAS_A)) if part not in found]
    return found


def _explain_misfit(skill: Skill, implementation: Implementation, library: SkillLibrary, devices: _RobotDevices) -> str:
    """Return why no devices fit an implementation, empty if some do."""
    wanted = {each.name: cls for each in skill.parameters if (cls := _device_class(each, library))}
    short = devices.state.vocabulary.short
    missing = next((name for name, cls in wanted.items() if not devices.of_class(cls)), None)
    if missing is not None:
        return f"`{missing}` needs a {short(wanted[missing])}, and {short(devices.robot)} neither is nor has one"
    reasons = (_refuse(skill, implementation, each, library, devices.state) for each in _choices(wanted, devices))
    first = next(reasons)
    return first if first and all(reasons) else ""


def _choices(wanted: Mapping[str, str], devices: _RobotDevices) -> Iterator[dict[str, str]]:
    """Yield devices by parameter: those that the robot may use, then, where several are of a class, also of others."""
    several = {cls for cls, number in Counter(wanted.values()).items() if number > 1}
    near = [devices.of_class(cls) for cls in wanted.values()]
    far = [devices.of_others(cls) if cls in several else [] for cls in wanted.values()]
    every = product(*(here + others for here, others in zip(near, far, strict=True)))
    shared = (each for each in every if devices.are_shared(each))
    for chosen in chain(islice(product(*near), MOST_TRIED), islice(shared, MOST_TRIED)):
        yield dict(zip(wanted, chosen, strict=True))


def _refuse(
    skill: Skill, implementation: Implementation, devices: Mapping[str, str], library: SkillLibrary, state: WorldState
) -> str:
    """Return why a call with these devices is refused before anything moves, empty if it is not."""
    passed = (each.name for each in skill.parameters if each.direction in PASSED)
    arguments: dict[str, Expression] = {
        name: Individual(devices[name]) if name in devices else Variable(name) for name in passed
    }
    call = tree.Call(skill.name, implementation.name, arguments, None, implementation.source)
    try:
        refusals = preflight(call, library, state)
    except EvaluationError as error:
        return str(error)
    return "; ".join(_format_refusal(each, skill) for each in refusals)


def _format_refusal(refusal: Refusal, skill: Skill) -> str:
    inside = refusal.within[1:]
    within = f" (in {' > '.join(inside)})" if inside else ""
    return f"{refusal.message.removeprefix(f'{skill.name}: ')}{within}"


def _device_class(parameter: Parameter, library: SkillLibrary) -> str | None:
    """Return the class of the devices of a parameter that a caller passes or that is looked up, None for others."""
    if parameter.direction not in PASSED or not isinstance(parameter.type, ClassType):
        return None
    iri = parameter.type.iri
    return iri if DEVICE in library.vocabulary.ancestors.get(iri, ()) else None
