"""Sessions of twenty edits with the language server: it answers all that is asked, and shows what `check` finds."""

from __future__ import annotations

from pathlib import Path
from random import Random

from fuzz.kinds._lsp import Server
from fuzz.kinds._texts import change, make_text
from skillc.services.check import library_checks
from skillc.services.library.files import find_library

EDITS = 20
SECONDS = 60.0
NAME = "input.skill"
_AT_PLACE = ("hover", "completion", "definition", "references", "documentHighlight", "signatureHelp", "prepareRename")
_OF_FILE = ("documentSymbol", "foldingRange", "semanticTokens/full", "formatting")
_MORE: dict[str, dict[str, object]] = {
    "references": {"context": {"includeDeclaration": True}},
    "formatting": {"options": {"tabSize": 4, "insertSpaces": True}},
}
_servers: list[Server] = []
"""The server that this process keeps for its sessions, once there is one."""


def run_case(random: Random, folder: Path) -> None:
    """Open a file, edit it and ask about places in it; compare now and then what is shown with what `check` finds."""
    if not _servers:
        _servers.append(Server())
    try:
        _edit(_servers[0], random, folder)
    except BaseException:
        _servers.pop().stop()
        raise


def _edit(server: Server, random: Random, folder: Path) -> None:
    document = {"uri": (folder / NAME).as_uri()}
    text = _written(folder, make_text(random))
    opened = {**document, "languageId": "skill", "version": 1, "text": text}
    server.notify("textDocument/didOpen", {"textDocument": opened})
    for number in range(EDITS):
        text = _written(folder, change(text, random) if random.random() < 0.9 else make_text(random))
        version = {**document, "version": number + 2}
        server.notify("textDocument/didChange", {"textDocument": version, "contentChanges": [{"text": text}]})
        if random.random() < 0.5:
            _ask(server, random, document, text)
        if number == EDITS - 1 or random.random() < 0.2:
            server.wait_for_diagnostics(document["uri"], _checked(folder))
    server.notify("textDocument/didClose", {"textDocument": document})


def _ask(server: Server, random: Random, document: dict[str, str], text: str) -> None:
    lines = text.split("\n")
    line = random.randrange(len(lines) + 1)
    place = {"line": line, "character": random.randrange(len(lines[line]) + 2 if line < len(lines) else 2)}
    params = {"textDocument": document, "position": place}
    method = random.choice([*2 * _AT_PLACE, *_OF_FILE])
    server.request(f"textDocument/{method}", {**params, **_MORE.get(method, {})})
    whole = {"start": {"line": 0, "character": 0}, "end": place}
    about = {"textDocument": document, "range": whole, "context": {"diagnostics": []}}
    server.request("textDocument/codeAction", about)


def _checked(folder: Path) -> list[tuple[int, str]]:
    """Return the line and name of each problem that `skillc check` finds in the file."""
    found = library_checks.check_library(find_library(folder), None)
    return sorted((each.span.line, each.name) for each in found if Path(each.span.path).name == NAME)


def _written(folder: Path, text: str) -> str:
    """Write a text that an editor may have into the folder and return it."""
    encoded = text.encode("utf-8", "replace")
    (folder / NAME).write_bytes(encoded)
    return encoded.decode("utf-8")
