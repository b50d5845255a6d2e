"""A desk to write at: a folder with a library, and an editor that has some of its files open."""

from __future__ import annotations

import asyncio
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from lsprotocol import types
from pytest_lsp import LanguageClient

from skillc_dsl.editions import NEWEST
from waiting import LONG_S


@dataclass
class Desk:
    """A folder with a library, and the files of it that are open; `|` marks the cursor in texts."""

    client: LanguageClient
    folder: Path
    versions: dict[str, int] = field(default_factory=dict)

    def uri(self, name: str) -> str:
        """Return the URI of a file."""
        return (self.folder / name).as_uri()

    def open(self, name: str, text: str) -> types.Position:
        """Open a text that need not be on disk, and return where the cursor is."""
        clean, position = split(text)
        self.versions[name] = 1
        item = types.TextDocumentItem(self.uri(name), "skill", 1, clean)
        self.client.text_document_did_open(types.DidOpenTextDocumentParams(item))
        return position

    def type(self, name: str, text: str) -> types.Position:
        """Change an open text, and return where the cursor is."""
        clean, position = split(text)
        self.versions[name] += 1
        document = types.VersionedTextDocumentIdentifier(self.versions[name], self.uri(name))
        change = types.TextDocumentContentChangeWholeDocument(clean)
        self.client.text_document_did_change(types.DidChangeTextDocumentParams(document, [change]))
        return position

    def close(self, name: str) -> None:
        """Close a file."""
        document = types.TextDocumentIdentifier(self.uri(name))
        self.client.text_document_did_close(types.DidCloseTextDocumentParams(document))
        self.versions.pop(name)

    def at(self, name: str, text: str) -> tuple[types.TextDocumentIdentifier, types.Position]:
        """Open or change a file, and return what a request about the cursor's place speaks of."""
        position = self.type(name, text) if name in self.versions else self.open(name, text)
        return types.TextDocumentIdentifier(self.uri(name)), position

    def library(self, **files: str) -> None:
        """Write files to the disk."""
        for name, text in files.items():
            (self.folder / f"{name}.skill").write_text(text, "utf-8")

    def project(self, edition: int = NEWEST) -> None:
        """Make the folder a project whose library is of an edition."""
        (self.folder / "skillc.toml").write_text(f'name = "own"\nedition = {edition}\n', "utf-8")

    async def completions(self, name: str, text: str) -> list[str]:
        """Return what is offered at the cursor."""
        found = await self.client.text_document_completion_async(types.CompletionParams(*self.at(name, text)))
        assert isinstance(found, types.CompletionList)
        return [item.label for item in found.items]

    async def problems(self, name: str, errors: Sequence[str] | None = None) -> list[types.Diagnostic]:
        """Return the errors of a file once they are those named, with `[]` once nothing at all is told of it.

        Without names, return whatever is told of it first, warnings too.
        """
        told: Sequence[types.Diagnostic] | None = None
        try:
            async with asyncio.timeout(LONG_S):
                while not _as_expected(told := self.client.diagnostics.get(self.uri(name)), errors):
                    await self.client.wait_for_notification(types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
        except TimeoutError:
            raise AssertionError(f"expected {errors}, not {told}") from None
        return _errors(told or ()) if errors else list(told or ())


def _as_expected(told: Sequence[types.Diagnostic] | None, errors: Sequence[str] | None) -> bool:
    if told is None or not errors:
        return told is not None and (errors is None or not told)
    return sorted(str(problem.code) for problem in _errors(told)) == sorted(errors)


def _errors(told: Sequence[types.Diagnostic]) -> list[types.Diagnostic]:
    return [problem for problem in told if problem.severity == types.DiagnosticSeverity.Error]


def split(text: str) -> tuple[str, types.Position]:
    """Take the `|` out of a text, and return where it was, in UTF-16; the start where there is none."""
    before, bar, after = text.partition("|")
    if not bar:
        return text, types.Position(0, 0)
    line = before.rpartition("\n")[2]
    return before + after, types.Position(before.count("\n"), len(line.encode("utf-16-le")) // 2)
