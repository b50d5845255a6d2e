"""Opens the store that an option names: a folder, or the address of a SPARQL server."""

from __future__ import annotations

from pathlib import Path
from typing import Protocol

from skillc_runtime.cancellation import CancelToken
from skillc_runtime.store.store import Store
from skillc_runtime.world.state.transactions import StoreError


class OpenStore(Store, Protocol):
    """An open store; as text it is its folder or address."""

    def close(self) -> None:
        """Close the store."""

    def require_writable(self) -> None:
        """Raise StoreError if only somebody else may write to the store."""


def open_store(place: str, reset: bool = False, cancel: CancelToken | None = None) -> OpenStore:
    """Open the store in a folder or at an `http://` or `https://` address; with `reset`, delete its contents.

    `cancel` ends all waits for a server or for other processes. StoreError when that is not possible, with the reason.
    """
    if "://" in place:
        return _open_on_server(place, reset, cancel)
    try:
        from skillc_runtime.store.disk import DiskStore
    except ImportError as error:
        raise StoreError(f"a store in a folder needs the file locks of Linux or macOS ({error})") from error
    return DiskStore(Path(place), reset, cancel)


def _open_on_server(address: str, reset: bool, cancel: CancelToken | None) -> OpenStore:
    from skillc_runtime.store.http import find_endpoint
    from skillc_runtime.store.sparql import SparqlStore

    return SparqlStore(find_endpoint(address, cancel=cancel), reset, cancel=cancel)
