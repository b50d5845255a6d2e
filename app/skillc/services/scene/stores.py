"""Opens the world model of a scene, or of a store, which is filled with the scene at its first use."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from getpass import getuser
from hashlib import sha256
from pathlib import Path
from socket import gethostname
from typing import Protocol

from skillc.errors import DiagnosticsError, RequestError, ServiceError
from skillc.services.reporting.reporter import Reporter, format_count
from skillc.services.scene.diagnostics import read_scene_text, with_shown_paths
from skillc_dsl import cache
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.scene.documents import SceneError
from skillc_runtime.scene.load import load_scene
from skillc_runtime.store.address import without_credentials
from skillc_runtime.store.store import Store, StoredWorld
from skillc_runtime.store.world_from_triples import build_world
from skillc_runtime.store.world_index import Indexed, IndexPlace, read_index, write_index
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.transactions import ChangeEvent, StoreError
from skillc_runtime.world.state.world_state import WorldState

MOST_INDEXES = 4
"""The most indexes of worlds on servers that are kept."""


class OpenStore(Store, Protocol):
    """An open store; as text it is its folder or address."""

    def close(self) -> None:
        """Close the store."""

    def require_writable(self) -> None:
        """Raise StoreError if only somebody else may write to the store."""


def open_store(place: str, reset: bool = False, cancel: CancelToken | None = None, author: str = "") -> OpenStore:
    """Open the store in a folder or at an `http://` or `https://` address; with `reset`, delete its contents.

    `cancel` ends all waits for a server or for other processes, `author` is who writes. StoreError when that is not
    possible, with the reason.
    """
    if "://" in place:
        from skillc_runtime.store.http import find_endpoint
        from skillc_runtime.store.sparql import SparqlStore

        index = _index_of_server(without_credentials(place))
        return SparqlStore(find_endpoint(place, cancel=cancel), reset, cancel=cancel, author=author, index=index)
    try:
        from skillc_runtime.store.disk import DiskStore
    except ImportError as error:
        raise StoreError(f"a store in a folder needs the file locks of Linux or macOS ({error})") from error
    return DiskStore(Path(place), reset, cancel, author=author)


def _index_of_server(address: str) -> Path | None:
    """Return the file in the cache folder for the index of the world on a server; None without such a folder."""
    folder = cache.cache_folder()
    if folder is None:
        return None
    with suppress(OSError):
        (folder / "worlds").mkdir(mode=0o700, parents=True, exist_ok=True)
    cache.delete_oldest(folder / "worlds", MOST_INDEXES, MOST_INDEXES)
    return folder / "worlds" / sha256(address.encode()).hexdigest()[:16]


def describe_author() -> str:
    """Return who this process is, for others that read what it writes."""
    try:
        user = f"{getuser()}@"
    except (OSError, KeyError, ImportError):
        user = ""
    return f"{user}{gethostname()}, process {os.getpid()}"


_BEGINNING = re.compile(r"scene (.*) ([0-9a-f]{12})")


@dataclass(frozen=True, slots=True)
class StoreChoice:
    """The store of a world (a folder, the URL of a SPARQL server, or None) and whether to empty it first.

    The URL may contain a password, so it is not shown; `name` is the place without it. `cancel` ends all waits for a
    server or for other processes. With `writes`, a store to which only a cell may write is refused at once.
    """

    place: str | None = field(default=None, repr=False)
    reset: bool = False
    writes: bool = False
    cancel: CancelToken = field(default_factory=CancelToken, repr=False, compare=False)

    def __post_init__(self) -> None:
        if self.reset and self.place is None:
            raise RequestError("--reset requires --store")

    @property
    def name(self) -> str:
        """The place without credentials, for messages."""
        return without_credentials(self.place or "")


NO_STORE = StoreChoice()


def load_world(scene: Path, vocabulary: Vocabulary, reporter: Reporter) -> WorldState:
    """Load a scene and report its warnings. DiagnosticsError if it has errors, ServiceError if it cannot be read."""
    try:
        return load_scene(
            scene, vocabulary, lambda found: reporter.show(with_shown_paths(found), read_scene_text(scene))
        )
    except SceneError as error:
        raise DiagnosticsError(with_shown_paths(error.problems), read_scene_text(scene)) from error
    except OSError as error:
        raise ServiceError(f"the scene {scene} cannot be read: {error.strerror}") from error


@contextmanager
def open_world(
    choice: StoreChoice, scene: Path | None, vocabulary: Vocabulary, reporter: Reporter
) -> Iterator[WorldModel]:
    """Open the world in a store, filled with the scene if it is empty; without a store, the world of the scene.

    DiagnosticsError or ServiceError if the scene or the store cannot be used.
    """
    if choice.place is None:
        assert scene is not None
        yield WorldModel(load_world(scene, vocabulary, reporter))
        return
    store = open_chosen_store(choice, choice.place, scene)
    try:
        state, sequence = read_or_fill(store, choice, scene, vocabulary, reporter)
        yield WorldModel(state, store, sequence)
    finally:
        store.close()


def open_chosen_store(choice: StoreChoice, place: str, scene: Path | None) -> OpenStore:
    """Open the store at a place; ServiceError if it cannot be opened, or if nothing is there to fill it with."""
    if scene is None and "://" not in place and not Path(place).exists():
        raise ServiceError(f"there is no store {place}; name the scene to fill it with")
    try:
        return open_store(place, choice.reset, choice.cancel, describe_author())
    except StoreError as error:
        raise ServiceError(str(error)) from error
    except OSError as error:
        raise _unusable(choice, error) from error


def read_or_fill(
    store: OpenStore, choice: StoreChoice, scene: Path | None, vocabulary: Vocabulary, reporter: Reporter
) -> tuple[WorldState, int]:
    """Return the world in a store and the number of its last write; an empty store is filled with the scene.

    DiagnosticsError or ServiceError if the scene or the store cannot be used.
    """
    try:
        if choice.writes:
            store.require_writable()
        return _world(store, scene, vocabulary, reporter)
    except StoreError as error:
        raise ServiceError(str(error)) from error
    except OSError as error:
        raise _unusable(choice, error) from error


def _unusable(choice: StoreChoice, error: OSError) -> ServiceError:
    return ServiceError(f"the store {choice.name} cannot be opened: {error.strerror}")


def _world(store: OpenStore, scene: Path | None, vocabulary: Vocabulary, reporter: Reporter) -> tuple[WorldState, int]:
    place = _find_index(store)
    state = None
    if place is not None:
        stored = StoredWorld(place.sequence, place.beginning, ())
        _compare(stored, scene, store, reporter)
        state = read_index(place, vocabulary)
    if place is None or state is None:
        stored = store.read()
        if not stored.triples:
            if scene is None:
                raise ServiceError(f"{store} is empty; name the scene to fill it with")
            state = load_world(scene, vocabulary, reporter)
            event = ChangeEvent((), identify_scene(scene), WorldState.empty(vocabulary), state)
            if store.append(event, stored.sequence):
                _keep_index(_find_index(store), stored.sequence + 1, vocabulary, state)
                reporter.say(f"{store}: filled with {scene.name}")
                return state, stored.sequence + 1
            stored = store.read()
        if place is None:
            _compare(stored, scene, store, reporter)
        state = build_world(stored.triples, vocabulary, str(store))
        _keep_index(place, stored.sequence, vocabulary, state)
    count = format_count(stored.sequence, "transaction")
    reporter.say(f"{store}: the world after {count}, filled with {_name(stored)}")
    return state, stored.sequence


def _find_index(store: OpenStore) -> IndexPlace | None:
    return store.find_index() if isinstance(store, Indexed) else None


def _keep_index(place: IndexPlace | None, sequence: int, vocabulary: Vocabulary, state: WorldState) -> None:
    """Write the index of a world after a transaction, unless there have been others meanwhile."""
    if place is not None and place.sequence == sequence:
        write_index(place, vocabulary, state)


def _compare(stored: StoredWorld, scene: Path | None, store: OpenStore, reporter: Reporter) -> None:
    """ServiceError for a store that was filled with another scene; a warning if that scene has changed since."""
    if scene is None or stored.beginning == identify_scene(scene):
        return
    if _name(stored) != scene.name:
        raise ServiceError(
            f"{store} was filled with {_name(stored)}, not with {scene.name}; "
            "name another store, or fill this one again with --reset"
        )
    reporter.say(f"warning: {scene} has changed since {store} was filled with it; --reset fills it again")


def identify_scene(scene: Path) -> str:
    """Return the identity of a scene: its name and a digest of its file. OSError if it cannot be read."""
    return f"scene {scene.name} {sha256(scene.read_bytes()).hexdigest()[:12]}"


def _name(stored: StoredWorld) -> str:
    found = _BEGINNING.fullmatch(stored.beginning)
    return found[1] if found else "something else"
