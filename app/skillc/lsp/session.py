"""The state of one editor's session, and the publication of diagnostics."""

from __future__ import annotations

import asyncio
import logging
import traceback
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

from lsprotocol import types
from pygls.lsp.server import LanguageServer

from skillc.lsp import diagnostics as problems
from skillc.lsp.files import Root
from skillc.lsp.libraries import FileView, Libraries
from skillc.lsp.positions import PositionConverter
from skillc.services.reporting import crash_reports
from skillc_compiler.ide.analysis import Analysis
from skillc_compiler.ide.project_names import ProjectNames
from skillc_dsl.diagnostics import Diagnostic

log = logging.getLogger(__name__)
SHORT_PAUSE_S = 0.01
"""The diagnostics of texts are published when nothing has been typed for this time, in s."""
PAUSE_S = 0.15
"""Scenes, and the tasks in them, are checked when nothing has been typed for this time, in s."""


@dataclass(frozen=True, slots=True)
class At:
    """A file and a position in it: line and column from 1."""

    view: FileView
    lines: PositionConverter
    line: int
    column: int


@dataclass(frozen=True, slots=True)
class Published:
    """What was published last: the analysis (None if it failed), with what was found around it, and each file's list.

    Not `whole` if what is around the texts was found for an earlier analysis.
    """

    analysis: Analysis | None
    around: tuple[Diagnostic, ...]
    by_uri: Mapping[str, list[types.Diagnostic]]
    whole: bool


@dataclass(frozen=True, slots=True)
class AtName:
    """A position, line and column from 1, in a text of a project, and the names in all of these texts."""

    root: Root
    names: ProjectNames
    lines: PositionConverter
    path: str
    line: int
    column: int

    @property
    def place(self) -> tuple[str, int, int]:
        """The path, the line and the column."""
        return self.path, self.line, self.column


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
    """The state of a session; `over` once the editor has asked for a shutdown.

    `commands` are those that the editor carries out: the list `commands` in its initialization options.
    """

    server: LanguageServer
    over: bool = False
    commands: frozenset[str] = frozenset()
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

    def at_name(self, params: PositionParams) -> AtName:
        """Return the position of a request in a skill file, a scene or a vocabulary."""
        file = self.file(params.text_document.uri)
        root, names = self.libraries.names(file)
        found = (path for path in names.texts if self.libraries.find_file(root, path) == file)
        path = next(found, file.name)
        lines = PositionConverter(names.texts, self.encoding)
        return AtName(root, names, lines, path, *lines.place(path, params.position))

    def schedule_publishing(self) -> None:
        """Publish all diagnostics once nothing is typed any more: those of texts first, as scenes take longer."""
        self._wait(SHORT_PAUSE_S, self._publish_texts)

    def _wait(self, pause_s: float, publish: Callable[[], None]) -> None:
        if self._waiting is not None:
            self._waiting.cancel()
        self._waiting = asyncio.get_running_loop().call_later(pause_s, publish)

    def publish(self) -> None:
        """Publish the diagnostics of each library that has changed, and clear those of closed libraries."""
        roots = self.libraries.roots()
        for root in self._published.keys() - set(roots):
            self._send_changes(self._published.pop(root).by_uri, {})
        for root in roots:
            self._publish(root)

    def _publish_texts(self) -> None:
        """Publish the diagnostics of the texts of known libraries; those of scenes stay as they are for a moment."""
        for root in self.libraries.roots():
            if root in self._published:
                self._publish(root, self._published[root].around)
        self._wait(PAUSE_S, self.publish)

    def _publish(self, root: Root, around: tuple[Diagnostic, ...] | None = None) -> None:
        """Publish those of one library, with those `around` it if given; after an internal error, syntax errors."""
        before = self._published.get(root)
        whole, analysis = around is None, None
        try:
            analysis = self.libraries.analysis(root)
            if before is not None and before.analysis is analysis and (before.whole or not whole):
                return
            found = self.libraries.problems_around(root) if around is None else around
            by_uri = problems.diagnostics_by_uri(self.libraries, root, analysis, found, self.encoding)
        except Exception as error:  # noqa: BLE001 - the boundary of a task
            analysis, found, message = None, (), self._report(error)
            by_uri = problems.diagnostics_after_failure(self.libraries, root, message, self.encoding)
        self._send_changes(before.by_uri if before else {}, by_uri)
        self._published[root] = Published(analysis, found, by_uri, whole)

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

    def _send_changes(
        self, before: Mapping[str, list[types.Diagnostic]], now: Mapping[str, list[types.Diagnostic]]
    ) -> None:
        """Send the lists that differ from those before; a file that is not in a library any more has an empty one."""
        for uri in (*now, *(before.keys() - now.keys())):
            if before.get(uri) != now.get(uri, []):
                self._send(uri, now.get(uri, []))

    def _send(self, uri: str, found: list[types.Diagnostic]) -> None:
        self.server.text_document_publish_diagnostics(types.PublishDiagnosticsParams(uri, found))
