"""The log of a server: a JSON object a line, with what was requested and how cells are, in files that are rotated."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from logging.handlers import RotatingFileHandler
from pathlib import Path

import msgspec

from skillc.errors import ServiceError

MAX_BYTES, FILES = 10_000_000, 5
"""The size of a file, and how many older ones are kept."""
_LOGGER = logging.getLogger("skillc.server")
_LOGGERS = {_LOGGER: logging.INFO, logging.getLogger("uvicorn.error"): logging.WARNING}


def log(event: str, **fields: str | float) -> None:
    """Write an entry, if there is a log."""
    _LOGGER.info(event, extra={"fields": fields})


@contextmanager
def logging_to(file: Path | None) -> Iterator[None]:
    """Write the log to a file in a `with` statement; without a file there is none. ServiceError if that cannot be."""
    if file is None:
        handler: logging.Handler = logging.NullHandler()
    else:
        try:
            handler = RotatingFileHandler(file, maxBytes=MAX_BYTES, backupCount=FILES, encoding="utf-8")
        except OSError as error:
            raise ServiceError(f"the log {file} cannot be written: {error.strerror}") from error
    handler.setFormatter(_JsonFormatter())
    for logger, level in _LOGGERS.items():
        logger.addHandler(handler)
        logger.setLevel(level)
        logger.propagate = False
    try:
        yield
    finally:
        for logger in _LOGGERS:
            logger.removeHandler(handler)
        handler.close()


class _JsonFormatter(logging.Formatter):
    def format(self, record: logging.LogRecord) -> str:
        """Return a record as a line of JSON, in which no text of a client can begin another line."""
        time = datetime.fromtimestamp(record.created, UTC).isoformat(timespec="milliseconds")
        entry = {"time": time, "level": record.levelname.lower(), "event": record.getMessage()}
        fields: dict[str, str | float] = getattr(record, "fields", {})
        error = {"error": self.formatException(record.exc_info)} if record.exc_info else {}
        return msgspec.json.encode({**entry, **fields, **error}).decode()
