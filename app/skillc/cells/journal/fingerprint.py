"""The fingerprint of the world of a cell: it says whether a store has the facts that the journal led to."""

from __future__ import annotations

from collections.abc import Iterable
from hashlib import blake2b

import msgspec
import pyoxigraph as ox

from skillc.cells.database import DatabaseError
from skillc.cells.journal.reading import JournalReader
from skillc_runtime.store.store import StoredWorld
from skillc_runtime.store.triples import TripleDifference, triple_difference
from skillc_runtime.world.state.transactions import ChangeEvent

SIZE = 16
"""The length of a digest in bytes."""
_MODULUS = 1 << (8 * SIZE)


def digest_triples(triples: Iterable[ox.Triple]) -> int:
    """Return the sum, modulo 2**128, of the hashes of triples: it does not depend on their order."""
    return sum(int.from_bytes(blake2b(str(each).encode(), digest_size=SIZE).digest()) for each in triples) % _MODULUS


def advance_digest(digest: int, difference: TripleDifference) -> int:
    """Return the digest after a write to facts that have this `digest`."""
    return (digest + digest_triples(difference.added) - digest_triples(difference.removed)) % _MODULUS


FINGERPRINT = "world"
"""The name of the fingerprint in the journal."""


class Fingerprint(msgspec.Struct, frozen=True):
    """The number of the last write to a world, and the digest of its facts after that."""

    sequence: int
    digest: bytes

    def after(self, event: ChangeEvent) -> Fingerprint:
        """Return the fingerprint after one more write; StoreError for a fact that a triple cannot state."""
        digest = advance_digest(int.from_bytes(self.digest), triple_difference(event))
        return Fingerprint(self.sequence + 1, digest.to_bytes(SIZE))


def make_fingerprint(stored: StoredWorld) -> Fingerprint:
    """Return the fingerprint of the world in a store."""
    return Fingerprint(stored.sequence, digest_triples(stored.triples).to_bytes(SIZE))


def encode_fingerprint(fingerprint: Fingerprint) -> bytes:
    """Return a fingerprint as the journal keeps it."""
    return msgspec.msgpack.encode(fingerprint)


def read_fingerprint(reader: JournalReader) -> Fingerprint | None:
    """Return the fingerprint in a journal, None if it has none. DatabaseError if it cannot be read."""
    saved = reader.state(FINGERPRINT)
    try:
        return None if saved is None else msgspec.msgpack.decode(saved, type=Fingerprint)
    except msgspec.MsgspecError as error:
        raise DatabaseError(f"{reader} has a fingerprint that cannot be read ({error}): restore a backup") from error
