"""`blocks`: a thing has to be moved before another can be taken."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from typing import TYPE_CHECKING

from skillc_runtime.world.space.frame_tree import Unplaced
from skillc_runtime.world.space.grasping.grasps import leaves_room
from skillc_runtime.world.space.reasoners.rests_on import RestsOn
from skillc_runtime.world.space.whereabouts import holders_of, unknown_place
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.terms import HAS_GRIPPER

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState


class Blocks:
    """The subject rests on the object, which does not contain it, or no gripper that takes the object has room for it.

    What a thing contains is taken along with it.
    """

    def obstacle(self, state: WorldState, subject: str, object_: str) -> str | None:
        """Return why the object can be taken with the subject where it is; None if the subject blocks it."""
        unknown, short = unknown_place(state, subject, object_), state.vocabulary.short
        if unknown is not None:
            return unknown
        if subject == object_:
            return "nothing blocks itself"
        if object_ in holders_of(state, subject):
            return f"{short(object_)} contains {short(subject)} and takes it along"
        above = RestsOn().obstacle(state, subject, object_)
        if above is None:
            return None
        rooms = dict(_rooms(state, subject, object_))
        roomy = min((gripper for gripper, room in rooms.items() if room), default=None)
        if roomy is not None:
            return f"{above}, and {short(roomy)} has room around {short(object_)}"
        return None if rooms else above


def _rooms(state: WorldState, subject: str, object_: str) -> Iterator[tuple[str, bool]]:
    """Yield the grippers that could take the object, each with whether it has room for that beside the subject."""
    for gripper in sorted({each for _, each in state.pairs(HAS_GRIPPER)}):
        with suppress(Unplaced, SheetError):
            room = leaves_room(state, gripper, object_, subject)
            if room is not None:
                yield gripper, room
