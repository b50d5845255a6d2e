"""How an arm that a process of its own controls is at present: for displays and for monitoring."""

from __future__ import annotations

from typing import Literal, TypeAlias

import msgspec

ControlState: TypeAlias = Literal[
    "ready", "in-control", "not-in-control", "wrong-mode", "protective-stop", "emergency-stop", "lost"
]
"""What a device is at present, such as somebody else's control, or a mode in which it takes no commands.

`ready`: it takes control. `in-control`: commands have effect. `not-in-control`: somebody else has control, such as
another program or an operator's panel. `wrong-mode`: it takes no commands. `protective-stop`: it has stopped by itself.
`emergency-stop`: somebody has to release a button. `lost`: it, or the process that controls it, does not answer.
"""

WINDOW_S = 5.0
"""The time over which control periods are described."""


class ControlReport(msgspec.Struct, frozen=True):
    """The state of an arm's device, with a sentence about what keeps it from moving, and its control periods.

    name: the short name of the arm. period_s: the nominal control period. rate_hz: control periods a second, and
    late_s: by how much the latest of them began late, both in the last seconds; None while there is none. lost_periods:
    those without a command or a state so far. speed_share: at which share of the commanded speeds the device moves, by
    its speed slider; 1 without. real_time: whether the process runs before all others of its machine.
    """

    name: str
    state: ControlState
    sentence: str
    period_s: float
    rate_hz: float | None
    late_s: float | None
    lost_periods: int
    speed_share: float
    real_time: bool
