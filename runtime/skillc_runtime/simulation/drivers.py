"""Makes the driver of a simulated arm from what is known about it."""

from __future__ import annotations

from skillc_runtime.controllers.gains import UnknownController, gains
from skillc_runtime.controllers.virtual_arm import virtual_model
from skillc_runtime.robots.driver import ArmDriver
from skillc_runtime.simulation.arm import SimulatedArm
from skillc_runtime.simulation.facts import ArmFacts
from skillc_runtime.world.sheet import SheetError


def driver(facts: ArmFacts, arm: SimulatedArm, period_s: float) -> ArmDriver:
    """Return the driver of an arm with the controller its facts name; SheetError for an unknown one, a missing gain."""
    try:
        chosen = gains(facts.controller, facts.sheet.number)
    except UnknownController as error:
        raise SheetError(f"{facts.sheet.state.vocabulary.short(facts.individual)}: {error}") from error
    return ArmDriver(arm, virtual_model(facts.model), chosen, arm.limits, lambda: arm.base, period_s)
