"""The world that a store keeps for the commands: filled with a scene at first, afterwards as it was left."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from hashlib import sha256
from pathlib import Path

import click

from skillc_compiler.library.vocabulary import Vocabulary
from skillc_runtime.commands._keeping import Keeping
from skillc_runtime.store.contents import world_of
from skillc_runtime.store.opening import OpenStore, open_store
from skillc_runtime.store.store import StoredWorld
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.transactions import ChangeEvent, StoreError
from skillc_runtime.world.state.world_state import WorldState

_BEGINNING = re.compile(r"scene (.*) ([0-9a-f]{12})")


def kept_world(
    keeping: Keeping, scene: Path | None, vocabulary: Vocabulary, load: Callable[[Path], WorldState]
) -> WorldModel:
    """Return the world in a store, which is filled with the scene if it is empty; exit with what is wrong with it.

    The store is closed when the command ends.
    """
    assert keeping.place is not None
    try:
        if scene is None and "://" not in keeping.place and not Path(keeping.place).exists():
            raise StoreError(f"there is no store {keeping.place}; name the scene to begin with")
        store = open_store(keeping.place, keeping.reset)
        click.get_current_context().call_on_close(store.close)
        return _world(store, scene, vocabulary, load)
    except StoreError as error:
        click.echo(f"error: {error}", err=True)
    except OSError as error:
        click.echo(f"error: the store {keeping.name} cannot be opened: {error.strerror}", err=True)
    sys.exit(1)


def _world(
    store: OpenStore, scene: Path | None, vocabulary: Vocabulary, load: Callable[[Path], WorldState]
) -> WorldModel:
    kept = store.read()
    if not kept.triples:
        if scene is None:
            raise StoreError(f"{store} is empty; name the scene to begin with")
        state = load(scene)
        event = ChangeEvent((), _beginning(scene), WorldState.empty(vocabulary), state)
        if store.append(event, kept.sequence):
            click.echo(f"{store}: filled with {scene.name}", err=True)
            return WorldModel(state, store, kept.sequence + 1)
        kept = store.read()
    _compare(kept, scene, store)
    state = world_of(kept.triples, vocabulary, str(store))
    click.echo(f"{store}: the world after {_counted(kept.sequence)}, which began as {_name(kept)}", err=True)
    return WorldModel(state, store, kept.sequence)


def _compare(kept: StoredWorld, scene: Path | None, store: OpenStore) -> None:
    """Refuse a store that began with another scene than a command names; tell of one that has changed since."""
    if scene is None or kept.beginning == _beginning(scene):
        return
    if _name(kept) != scene.name:
        raise StoreError(
            f"{store} holds a world that began as {_name(kept)}, not as {scene.name}; "
            "name another store, or fill this one anew with --reset"
        )
    click.echo(f"warning: {scene} is not what {store} began with; --reset would fill it anew", err=True)


def _beginning(scene: Path) -> str:
    """Return how a world that begins with a scene is marked: by the name and a digest of its file."""
    return f"scene {scene.name} {sha256(scene.read_bytes()).hexdigest()[:12]}"


def _name(kept: StoredWorld) -> str:
    found = _BEGINNING.fullmatch(kept.beginning)
    return found[1] if found else "something else"


def _counted(transactions: int) -> str:
    return f"{transactions} transaction" + "s" * (transactions != 1)
