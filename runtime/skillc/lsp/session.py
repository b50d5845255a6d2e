"""The state of one editor's session, and the publication of diagnostics."""

from __future__ import annotations

import asyncio
import logging
import traceback
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

from lsprotocol import types
from pygls.lsp.server import LanguageServer

from skillc.lsp import diagnostics as problems
from skillc.lsp.files import Root
from skillc.lsp.libraries import FileView, Libraries
from skillc.lsp.positions import PositionConverter
from skillc.services import crash_reports
from skillc_compiler.ide.analysis import Analysis

log = logging.getLogger(__name__)
PAUSE_S = 0.15
"""Diagnostics are published when nothing has been typed for this time, in s."""


@dataclass(frozen=True, slots=True)
class At:
    """A file and a position in it: line and column from 1."""

    view: FileView
    lines: PositionConverter
    line: int
    column: int


@dataclass(frozen=True, slots=True)
class Published:
    """The analysis (None if it failed) that was published last, and the files that were published."""

    analysis: Analysis | None
    uris: frozenset[str]


class PositionParams(Protocol):
    """The parameters of a request about a position in a file."""

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
    """The state of a session; `over` once the editor has asked for a shutdown."""

    server: LanguageServer
    over: bool = False
    libraries: Libraries = field(default_factory=Libraries)
    _published: dict[Root, Published] = field(default_factory=dict)
    _failures: dict[str, str] = field(default_factory=dict)
    _waiting: asyncio.TimerHandle | None = None

    @property
    def encoding(self) -> str:
        """The negotiated encoding, in whose units columns are counted."""
        agreed = self.server.workspace.position_encoding
        return types.PositionEncodingKind(agreed or types.PositionEncodingKind.Utf16).value

    def lines(self, view: FileView) -> PositionConverter:
        """Return the position converter for a view's library."""
        return PositionConverter(view.analysis.texts, self.encoding)

    def at(self, params: PositionParams) -> At:
        """Return the file and position of a request."""
        view = self.libraries.view(params.text_document.uri)
        lines = self.lines(view)
        return At(view, lines, *lines.place(view.path, params.position))

    def schedule_publishing(self) -> None:
        """Publish all diagnostics when nothing has been typed for PAUSE_S."""
        if self._waiting is not None:
            self._waiting.cancel()
        self._waiting = asyncio.get_running_loop().call_later(PAUSE_S, self.publish)

    def publish(self) -> None:
        """Publish the diagnostics of each library that has changed, and clear those of closed libraries."""
        roots = self.libraries.roots()
        for root in self._published.keys() - set(roots):
            self._withdraw(self._published.pop(root).uris)
        for root in roots:
            self._publish(root)

    def _publish(self, root: Root) -> None:
        """Publish those of one library; after an internal error, its message and the syntax errors."""
        before = self._published.get(root)
        analysis: Analysis | None
        try:
            analysis = self.libraries.analysis(root)
            if before is not None and before.analysis is analysis:
                return
            by_uri = problems.diagnostics_by_uri(self.libraries, root, analysis, self.encoding)
        except Exception as error:  # noqa: BLE001 - the boundary of a task
            analysis, message = None, self._report(error)
            by_uri = problems.diagnostics_after_failure(self.libraries, root, message, self.encoding)
        self._withdraw(before.uris - by_uri.keys() if before else frozenset())
        for uri, found in by_uri.items():
            self._send(uri, found)
        self._published[root] = Published(analysis, frozenset(by_uri))

    def _report(self, error: Exception) -> str:
        """Log an internal error and return its message; the crash report of equal errors is written once."""
        key = "".join(traceback.format_tb(error.__traceback__))
        if key not in self._failures:
            self._failures[key] = crash_reports.write_report(error, ["lsp"])
            log.error("analysing failed", exc_info=error)
        return self._failures[key]

    def folders(self, uris: list[str]) -> None:
        """Set the folders that are open in the editor."""
        self.libraries.folders = tuple(self.libraries.file(uri) for uri in uris)

    def file(self, uri: str) -> Path:
        """Return the file of a URI."""
        return self.libraries.file(uri)

    def _withdraw(self, uris: frozenset[str]) -> None:
        for uri in uris:
            self._send(uri, [])

    def _send(self, uri: str, found: list[types.Diagnostic]) -> None:
        self.server.text_document_publish_diagnostics(types.PublishDiagnosticsParams(uri, found))
