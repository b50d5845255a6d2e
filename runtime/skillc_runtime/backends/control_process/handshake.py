"""What the process of the tree and a control process send each other once, at the start."""

from __future__ import annotations

from dataclasses import dataclass

from skillc_runtime.backends.control_process.link import LinkAbilities, LinkDescription
from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.control.supervision.watchdog import HEARTBEAT_TIMEOUT_S
from skillc_runtime.devices.arm import ArmLimits, Mode


@dataclass(frozen=True, slots=True)
class Patience:
    """After which time in s each side stops the arm, or waits no longer for it.

    tree_s: the process of the tree is silent. process_s: the control process is silent, longer than its device may be.
    gap_s: the loop has not run, although its device was not waited for. settle_s: an arm whose control is to be taken
    still moves. brake_s: a stopped arm still moves; its own controller brakes what the law makes shake.
    """

    tree_s: float = HEARTBEAT_TIMEOUT_S
    process_s: float = 0.2
    gap_s: float = 0.1
    settle_s: float = 1.0
    brake_s: float = 1.0


USUAL_PATIENCE = Patience()


@dataclass(frozen=True, slots=True)
class ControlTask:
    """What a control process is to do: the facts of an arm, the short names of individuals, and its device."""

    facts: ArmSpec
    names: dict[str, str]
    description: LinkDescription
    patience: Patience = USUAL_PATIENCE


@dataclass(frozen=True, slots=True)
class Connected:
    """A control process is connected to its device: period in s, abilities and the mode of its law.

    limits: of its joints. real_time: whether it runs before all other processes.
    """

    period_s: float
    abilities: LinkAbilities
    mode: Mode
    limits: ArmLimits
    real_time: bool
