"""Keeps what looks at plans in space have found, since the same look finds the same again."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Sequence
from contextlib import suppress

import msgspec

from skillc_model.skills import SkillLibrary
from skillc_model.tree import Node
from skillc_runtime.execution.refinement.look import PlanLook
from skillc_runtime.planning.cache import PlanCache
from skillc_runtime.planning.plan import Step
from skillc_runtime.world.state.fact_list import list_facts
from skillc_runtime.world.state.world_state import WorldState

_ENCODER = msgspec.msgpack.Encoder(order="deterministic")


class LookMemory(msgspec.Struct, frozen=True):
    """Keeps looks in a store; `around` identifies what they depend on that neither library nor facts have.

    That are the programs, the models of devices, and the Python files of the library's own primitives.
    """

    store: PlanCache
    around: str

    def recall(
        self,
        library: SkillLibrary,
        state: WorldState,
        postures: object,
        what: Sequence[Step] | Node,
        find: Callable[[], PlanLook],
    ) -> PlanLook:
        """Return what a look at a plan or a body has found before, from the same facts and postures; else now."""
        digest = hashlib.sha256()
        for part in (self.around, library.hash, library.vocabulary, postures, what, *list_facts(state)):
            digest.update(_ENCODER.encode(part) + b"\n")
        key = digest.hexdigest()
        if (content := self.store.get(key)) is not None:
            with suppress(msgspec.MsgspecError):
                return msgspec.msgpack.decode(content, type=PlanLook)
        found = find()
        self.store.put(key, _ENCODER.encode(found))
        return found
