"""Effects on many individuals that others on the same ones take the place of."""

from __future__ import annotations

from collections.abc import Iterable

from skillc_compiler.analysis.knowledge.alias_types import AliasTypes
from skillc_compiler.analysis.knowledge.writes import PropertyWrite, RelationWrite, Write, normalise_each
from skillc_model.conditions import Adjust, Assert, Assign, ForEach, Retract, SingleEffect
from skillc_model.read_write import may_change, terms_read


def takes_place(types: AliasTypes, later: ForEach, effect: ForEach, writes: Iterable[Write]) -> bool:
    """Whether nothing is left of an effect once a later one is done, if only `writes` happen.

    Both are on the same individuals, as nothing changes what says which these are.
    """
    one, other = normalise_each(later), normalise_each(effect)
    if (one.cls, one.when) != (other.cls, other.when) or not _decides(types, one.effect, other.effect):
        return False
    written = {
        each.relation if isinstance(each, RelationWrite) else each.property
        for each in writes
        if isinstance(each, RelationWrite | PropertyWrite)
    }
    return not any(may_change(iri, frozenset(written), types.vocabulary) for iri in terms_read(effect.when))


def _decides(types: AliasTypes, later: SingleEffect, effect: SingleEffect) -> bool:
    """Whether an effect on an individual decides what another one has decided."""
    match later, effect:
        case (
            Assign(subject=now, property=iri),
            Assign(subject=then, property=former) | Adjust(subject=then, property=former),
        ):
            return (now, iri) == (then, former)
        case (
            Assert(subject=now, relation=relation, object=thing),
            Assert(subject=then, relation=former, object=other) | Retract(subject=then, relation=former, object=other),
        ) if (now, relation) == (then, former):
            return thing == other or (isinstance(effect, Assert) and types.vocabulary.relations[relation].functional)
        case (
            Retract(subject=now, relation=relation, object=thing),
            Assert(subject=then, relation=former, object=other) | Retract(subject=then, relation=former, object=other),
        ):
            return (now, relation, thing) == (then, former, other)
    return False
