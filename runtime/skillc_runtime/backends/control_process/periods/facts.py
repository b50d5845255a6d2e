"""Reads from the facts of an arm how its control process waits, stops and limits."""

from __future__ import annotations

import numpy as np

from skillc_runtime.backends.control_process.handshake import USUAL_PATIENCE, Patience
from skillc_runtime.backends.control_process.periods.command_limits import Margins, RateLimits
from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.world.state.data_sheet import number_of
from skillc_runtime.world.state.terms import SKILLC


def read_patience(facts: ArmSpec) -> Patience:
    """Return after which times the sides of a control process stop its arm."""
    usual = USUAL_PATIENCE
    return Patience(
        tree_s=_number(facts, "treeTimeout", usual.tree_s),
        process_s=_number(facts, "controlTimeout", usual.process_s),
        gap_s=_number(facts, "cycleTimeout", usual.gap_s),
        settle_s=_number(facts, "settleTimeout", usual.settle_s),
        brake_s=_number(facts, "brakeTimeout", usual.brake_s),
    )


def read_margins(facts: ArmSpec) -> Margins:
    """Return how commands and measurements of an arm are compared with its limits."""
    usual = Margins()
    return Margins(
        soft_start_s=_number(facts, "softStartTime", usual.soft_start_s),
        lead=_number(facts, "commandLead", usual.lead),
        overspeed=_number(facts, "overspeed", usual.overspeed),
    )


def read_rate_limits(facts: ArmSpec) -> RateLimits:
    """Return how fast commands of an arm may change, by its sheet; as fast as they like where it states nothing."""
    sheet, joints = facts.sheet, facts.home.size
    jerk = sheet.limits("jointJerks", joints) if sheet.has("jointJerks") else np.full(joints, np.inf)
    rate = sheet.number("torqueRate") if sheet.has("torqueRate") else np.inf
    return RateLimits(jerk, np.full(joints, rate))


def _number(facts: ArmSpec, name: str, default: float) -> float:
    """Return a number of an arm, or else of its data sheet."""
    state, property_ = facts.sheet.state, SKILLC + name
    return number_of(state, facts.individual, property_, number_of(state, facts.sheet.individual, property_, default))
