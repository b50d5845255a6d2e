"""One editor's session: its libraries, how it counts columns, and when problems are published."""

from __future__ import annotations

import asyncio
import logging
import traceback
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

from lsprotocol import types
from pygls.lsp.server import LanguageServer

from skillc.lsp import problems
from skillc.lsp.files import Root
from skillc.lsp.libraries import Libraries, View
from skillc.lsp.positions import Lines
from skillc.services import crash_reports
from skillc_compiler.ide.analysis import Analysis

log = logging.getLogger(__name__)
PAUSE_S = 0.15
"""For so long nothing may have been typed before problems are looked for, in seconds."""


@dataclass(frozen=True, slots=True)
class At:
    """A view of a file and a place in it, from 1."""

    view: View
    lines: Lines
    line: int
    column: int


@dataclass(frozen=True, slots=True)
class Published:
    """The files whose problems the editor has, and of which analysis; None where that failed."""

    analysis: Analysis | None
    uris: frozenset[str]


class Placed(Protocol):
    """A request that speaks of a place in a file."""

    @property
    def text_document(self) -> types.TextDocumentIdentifier:
        """The file."""
        ...

    @property
    def position(self) -> types.Position:
        """The place."""
        ...


@dataclass
class Session:
    """What lasts from the editor's first message to its last; `over` once it has said goodbye."""

    server: LanguageServer
    over: bool = False
    libraries: Libraries = field(default_factory=Libraries)
    _published: dict[Root, Published] = field(default_factory=dict)
    _failures: dict[str, str] = field(default_factory=dict)
    _waiting: asyncio.TimerHandle | None = None

    @property
    def encoding(self) -> str:
        """The encoding in whose units columns are counted."""
        agreed = self.server.workspace.position_encoding
        return types.PositionEncodingKind(agreed or types.PositionEncodingKind.Utf16).value

    def lines(self, view: View) -> Lines:
        """Return the lines of a view's library."""
        return Lines(view.analysis.texts, self.encoding)

    def at(self, params: Placed) -> At:
        """Return what a request speaks of."""
        view = self.libraries.view(params.text_document.uri)
        lines = self.lines(view)
        return At(view, lines, *lines.place(view.path, params.position))

    def schedule_publishing(self) -> None:
        """Publish all problems once nothing is typed for a while."""
        if self._waiting is not None:
            self._waiting.cancel()
        self._waiting = asyncio.get_running_loop().call_later(PAUSE_S, self.publish)

    def publish(self) -> None:
        """Publish the problems of every library that has changed; those that are gone are withdrawn."""
        roots = self.libraries.roots()
        for root in self._published.keys() - set(roots):
            self._withdraw(self._published.pop(root).uris)
        for root in roots:
            self._publish(root)

    def _publish(self, root: Root) -> None:
        """Publish those of one library. When skillc itself fails, that is published with what is known all the same."""
        before = self._published.get(root)
        analysis: Analysis | None
        try:
            analysis = self.libraries.analysis(root)
            if before is not None and before.analysis is analysis:
                return
            by_uri = problems.by_uri(self.libraries, root, analysis, self.encoding)
        except Exception as error:  # noqa: BLE001 - the boundary of a task
            analysis, by_uri = None, problems.after_failure(self.libraries, root, self._report(error), self.encoding)
        self._withdraw(before.uris - by_uri.keys() if before else frozenset())
        for uri, found in by_uri.items():
            self._send(uri, found)
        self._published[root] = Published(analysis, frozenset(by_uri))

    def _report(self, error: Exception) -> str:
        """Log a mistake of skillc's own, and return what is said of it; each one is written to one file only."""
        key = "".join(traceback.format_tb(error.__traceback__))
        if key not in self._failures:
            self._failures[key] = crash_reports.write_report(error, ["lsp"])
            log.error("analysing failed", exc_info=error)
        return self._failures[key]

    def folders(self, uris: list[str]) -> None:
        """Note which folders are open in the editor."""
        self.libraries.folders = tuple(self.libraries.file(uri) for uri in uris)

    def file(self, uri: str) -> Path:
        """Return the file of a URI."""
        return self.libraries.file(uri)

    def _withdraw(self, uris: frozenset[str]) -> None:
        for uri in uris:
            self._send(uri, [])

    def _send(self, uri: str, found: list[types.Diagnostic]) -> None:
        self.server.text_document_publish_diagnostics(types.PublishDiagnosticsParams(uri, found))
