"""Says in words what a map of dirt shows."""

from __future__ import annotations

from skillc_runtime.motion.dirt_map import CLEAN, DIRTY, SPARED, UNSEEN, DirtMap, parse_dirt_map
from skillc_runtime.world.state.labels.labelled import LabelledFact, LabelledProperty
from skillc_runtime.world.state.terms import DIRT_MAP


def written_dirt_map(fact: LabelledFact) -> DirtMap | None:
    """Return the map that a fact states; None if it states none, or one that cannot be read."""
    if not isinstance(fact, LabelledProperty) or fact.property.iri != DIRT_MAP or not isinstance(fact.value, str):
        return None
    try:
        return parse_dirt_map(fact.value)
    except ValueError:
        return None


def describe_dirt_map(dirt: DirtMap) -> str:
    """Return the shares of a map and how sure it is of dirt: `91.2 % clean, 8.8 % dirty (confidence 0.7 to 1)`."""
    counted = max(1, len(dirt.state) - dirt.state.count(SPARED))
    sure = sorted({tenths for state, tenths in zip(dirt.state, dirt.confidence, strict=True) if state == DIRTY})
    ends = dict.fromkeys(f"{tenths / 10:g}" for tenths in (sure[:1] + sure[-1:]))
    parts = [f"{dirt.state.count(CLEAN) / counted:.1%} clean"]
    parts.append(f"{dirt.dirty_share:.1%} dirty" + (f" (confidence {' to '.join(ends)})" if ends else ""))
    if unseen := dirt.state.count(UNSEEN):
        parts.append(f"{unseen / counted:.1%} not seen")
    return f"{', '.join(parts)}, of {dirt.columns} x {dirt.rows} cells"
