"""Judges a run that has ended: what its world model claims is compared with the simulator, once all lies still."""

from __future__ import annotations

from msgspec import structs

from skillc_runtime.devices.simulation import Simulation
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.recording.known_facts import unverified_facts

SETTLING_S = 0.5
"""How long things may fall, roll and tip after a run before they are looked at."""


def judge_claims(simulation: Simulation) -> tuple[str, ...]:
    """Return what the world model claims falsely of what is where, and who holds what; a sentence each.

    Time passes in a cell that has loose bodies.
    """
    drawn = simulation.drawing.individuals.values()
    if simulation.broken is None and any(each.kind == "body" and each.movable for each in drawn):
        simulation.advance(SETTLING_S)
    return simulation.find_false_claims()


def judge_result(result: TaskResult, simulation: Simulation) -> TaskResult:
    """Return a result with what the world model of its cell claims falsely; nothing is verified then."""
    claims = judge_claims(simulation)
    verified = None if result.verified is None else not unverified_facts(result.facts) and not claims
    return structs.replace(result, false_claims=claims, verified=verified)
