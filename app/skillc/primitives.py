"""What a primitive of your own is made of; `docs/how-to/own-primitive.md` shows one."""

from skillc_runtime.devices.cell import Cell
from skillc_runtime.primitives.computation import Computation
from skillc_runtime.primitives.contradiction import contradict, contradict_place
from skillc_runtime.primitives.locate import Locate
from skillc_runtime.primitives.primitive import Primitive, SkillFailure, SpaceLacking, Status
from skillc_runtime.primitives.stand_in import StandIn
from skillc_runtime.world.state.labels.labelled import LabelledQuantity as Quantity

__all__ = [
    "Cell",
    "Computation",
    "Locate",
    "Primitive",
    "Quantity",
    "SkillFailure",
    "SpaceLacking",
    "StandIn",
    "Status",
    "contradict",
    "contradict_place",
]
