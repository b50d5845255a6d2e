"""Keeps what looks at plans in space have found, since the same look finds the same again."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import msgspec

from skillc_model.skills import SkillLibrary
from skillc_runtime.execution.refinement.look import PlanLook
from skillc_runtime.planning.cache import PlanCache
from skillc_runtime.planning.plan import Step
from skillc_runtime.world.state.terms import MESH
from skillc_runtime.world.state.world_state import WorldState

_ENCODER = msgspec.msgpack.Encoder(order="deterministic")


@dataclass(frozen=True, slots=True)
class LookMemory:
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
        steps: Sequence[Step],
        find: Callable[[Sequence[Step]], PlanLook],
    ) -> PlanLook:
        """Return what a look at a plan has found before, from the same facts and postures; else what it finds now."""
        digest = hashlib.sha256()
        for part in (self.around, library.hash, library.vocabulary, postures, tuple(steps), *_list_facts(state)):
            digest.update(_ENCODER.encode(part) + b"\n")
        key = digest.hexdigest()
        if (content := self.store.get(key)) is not None:
            with suppress(msgspec.MsgspecError):
                return msgspec.msgpack.decode(content, type=PlanLook)
        found = find(steps)
        self.store.put(key, _ENCODER.encode(found))
        return found


def _list_facts(state: WorldState) -> Iterator[object]:
    """Yield all facts in order, and which meshes they name as they are now."""
    yield sorted((each, sorted(types)) for each, types in state.direct.items())
    for relation, links in sorted(state.asserted.items()):
        yield relation, sorted(links.pairs())
    for name, values in sorted(state.stored.items()):
        yield name, sorted((each, repr(value)) for each, value in values.items())
    for mesh in sorted({str(value) for _, value in state.stored[MESH].items()}) if MESH in state.stored else ():
        with suppress(OSError):
            there = Path(mesh).stat()
            yield mesh, there.st_size, there.st_mtime_ns
