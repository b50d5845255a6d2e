"""What every call of the API passes: errors become one family, ontology folders of projects last for one call."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

from skillc.errors import RequestError, ServiceError
from skillc.extras import naming_extras
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Source
from skillc_ontology import catalogue
from skillc_runtime.recording.history.question import QuestionError
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.state.model import WorldError
from skillc_runtime.world.state.names import NoSuchName
from skillc_runtime.world.state.transactions import StoreError

WRONG_REQUESTS = (NoSuchName, QuestionError, WorldError)


class NoticeList:
    """A reporter that keeps what a service reports: its messages and the warnings."""

    def __init__(self) -> None:
        self.messages: list[str] = []
        self.warnings: list[Diagnostic] = []

    def say(self, message: str) -> None:
        """Keep a message."""
        self.messages.append(message)

    def show(self, diagnostics: Sequence[Diagnostic], texts: Mapping[str, Source]) -> None:
        """Keep warnings."""
        self.warnings += diagnostics


@contextmanager
def api_call(folders: Iterable[Path] = ()) -> Iterator[None]:
    """Run a `with` block as a call of the API, which sees these ontology folders too.

    RequestError for what the world model or a recording refuses, ServiceError for a store that cannot be used.
    """
    with catalogue.folder_scope(folders), naming_extras():
        try:
            yield
        except WRONG_REQUESTS as error:
            raise RequestError(str(error)) from error
        except (StoreError, FrameError) as error:
            raise ServiceError(str(error)) from error


@contextmanager
def refusing_values() -> Iterator[None]:
    """Turn the ValueError of a transaction, such as for an unknown relation, into a RequestError."""
    try:
        yield
    except ValueError as error:
        raise RequestError(str(error)) from error
