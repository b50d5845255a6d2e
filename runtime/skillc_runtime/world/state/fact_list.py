"""All that a world states as plain values in order, by which what was found about it is found again."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from skillc_runtime.world.state.terms import MESH
from skillc_runtime.world.state.world_state import WorldState


def list_facts(state: WorldState) -> Iterator[object]:
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
