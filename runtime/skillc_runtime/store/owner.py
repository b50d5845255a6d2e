"""The owner of a store on disk: while a cell has its world there, nobody else writes to it."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from skillc_runtime.cancellation import CancelToken
from skillc_runtime.platforms.file_locks import try_lock
from skillc_runtime.store.file_lock import lock_file
from skillc_runtime.store.store_lock import describe_holders
from skillc_runtime.world.state.transactions import StoreError

PATIENCE_S = 5.0
"""How long who becomes the owner waits for writers, which need less, and for an owner that ends."""
MAX_NAME_BYTES = 500


class StoreOwnership:
    """Who may write to a store: its owner if it has one, else everybody; the system releases it with the process."""

    def __init__(self, path: Path) -> None:
        """Use the lock file at `path`, which exists once somebody has written."""
        self._path = path
        self._file: int | None = None

    def acquire(self, name: str, cancel: CancelToken) -> None:
        """Become the owner, which messages call `name`; StoreError if there is another one, or it cannot be written."""
        file = self._open(os.O_RDWR)
        try:
            if not lock_file(file, False, cancel.limited(PATIENCE_S)):
                raise self._refuse(file)
            os.ftruncate(file, os.write(file, f"{name} (process {os.getpid()})".encode()))
        except BaseException:
            os.close(file)
            raise
        self._file = file

    def release(self) -> None:
        """Let others write again, if this is the owner."""
        if self._file is not None:
            os.close(self._file)
            self._file = None

    @contextmanager
    def writing(self) -> Iterator[None]:
        """Keep others from becoming the owner in a `with` statement; StoreError if somebody else is the owner."""
        if self._file is not None:
            yield
            return
        file = self._open(os.O_RDONLY)
        try:
            if not try_lock(file, shared=True):
                raise self._refuse(file)
            yield
        finally:
            os.close(file)

    def _open(self, access: int) -> int:
        try:
            return os.open(self._path, access | os.O_CREAT, 0o666)
        except OSError as error:
            raise StoreError(f"nothing can be written to {self._path.parent}: {error.strerror}") from error

    def _refuse(self, file: int) -> StoreError:
        """Return the error that names the owner."""
        os.lseek(file, 0, os.SEEK_SET)
        owner = os.read(file, MAX_NAME_BYTES).decode(errors="replace") or describe_holders(file)
        return StoreError(
            f"{self._path.parent} belongs to {owner}, and nobody else may write to it: submit operations with "
            "`skillc start`, change the world with `skillc scene edit --cell`"
        )
