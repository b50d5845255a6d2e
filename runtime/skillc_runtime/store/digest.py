"""A digest of the facts in a store, which says whether two stores have the same."""

from __future__ import annotations

from collections.abc import Iterable
from hashlib import blake2b

import pyoxigraph as ox

from skillc_runtime.store.triples import TripleDifference

SIZE = 16
"""The length of a digest in bytes."""
_MODULUS = 1 << (8 * SIZE)


def digest_triples(triples: Iterable[ox.Triple]) -> int:
    """Return the sum, modulo 2**128, of the hashes of triples: it does not depend on their order."""
    return sum(int.from_bytes(blake2b(str(each).encode(), digest_size=SIZE).digest()) for each in triples) % _MODULUS


def advance_digest(digest: int, difference: TripleDifference) -> int:
    """Return the digest after a write to facts that have this `digest`."""
    return (digest + digest_triples(difference.added) - digest_triples(difference.removed)) % _MODULUS
