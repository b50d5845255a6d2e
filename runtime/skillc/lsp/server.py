"""The language server: which request is answered by which function."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial
from importlib.metadata import version
from typing import Any, BinaryIO, TypeAlias, cast

from lsprotocol import types
from pygls.lsp.server import LanguageServer

from skillc.lsp import documents, reading, writing
from skillc.lsp.files import is_turtle
from skillc.lsp.messages import Answers, Messages, Protocol
from skillc.lsp.session import Session
from skillc.services.errors import OutputError

Answer: TypeAlias = Callable[[Session, Any], object]

_LEGEND = types.SemanticTokensLegend(list(reading.TOKEN_KINDS), ["declaration"])
_FIXES = [types.CodeActionKind.QuickFix, writing.FIX_ALL]
ANSWERS: tuple[tuple[str, Answer, object], ...] = (
    (types.INITIALIZED, documents.initialized, None),
    (types.SHUTDOWN, documents.shut_down, None),
    (types.WORKSPACE_DID_CHANGE_WORKSPACE_FOLDERS, documents.folders_changed, None),
    (types.WORKSPACE_DID_CHANGE_WATCHED_FILES, documents.changed_on_disk, None),
    (types.TEXT_DOCUMENT_DID_OPEN, documents.opened, None),
    (types.TEXT_DOCUMENT_DID_CHANGE, documents.changed, None),
    (types.TEXT_DOCUMENT_DID_SAVE, documents.saved, None),
    (types.TEXT_DOCUMENT_DID_CLOSE, documents.closed, None),
    (types.TEXT_DOCUMENT_HOVER, reading.hovered, None),
    (types.TEXT_DOCUMENT_DEFINITION, reading.definition, None),
    (types.TEXT_DOCUMENT_IMPLEMENTATION, reading.implementation, None),
    (types.TEXT_DOCUMENT_REFERENCES, reading.references, None),
    (types.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT, reading.highlights, None),
    (types.TEXT_DOCUMENT_DOCUMENT_SYMBOL, reading.document_symbols, None),
    (types.WORKSPACE_SYMBOL, reading.workspace_symbols, None),
    (types.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL, reading.colours, _LEGEND),
    (types.TEXT_DOCUMENT_FOLDING_RANGE, reading.folding, None),
    (types.TEXT_DOCUMENT_SIGNATURE_HELP, reading.signature_help, types.SignatureHelpOptions(["(", ","])),
    (types.TEXT_DOCUMENT_COMPLETION, writing.completion, types.CompletionOptions([".", "(", ",", ":", '"', " "])),
    (types.TEXT_DOCUMENT_PREPARE_RENAME, writing.prepare_rename, None),
    (types.TEXT_DOCUMENT_RENAME, writing.rename, types.RenameOptions(prepare_provider=True)),
    (types.TEXT_DOCUMENT_CODE_ACTION, writing.code_actions, types.CodeActionOptions(_FIXES)),
    (types.TEXT_DOCUMENT_FORMATTING, writing.formatting, None),
)

OF_TURTLE = (
    types.TEXT_DOCUMENT_DID_OPEN,
    types.TEXT_DOCUMENT_DID_CHANGE,
    types.TEXT_DOCUMENT_DID_SAVE,
    types.TEXT_DOCUMENT_DID_CLOSE,
    types.TEXT_DOCUMENT_CODE_ACTION,
)
"""What is answered for scenes and vocabularies, too."""


def make_session() -> Session:
    """Return a session whose server is ready to start.

    Editors send whole texts: pygls applies parts of texts by lines that end also at form feeds and U+2028, where
    neither the protocol nor the language ends a line.
    """
    server = LanguageServer("skillc", version("skillc"), types.TextDocumentSyncKind.Full, protocol_cls=Protocol)
    session = Session(server)
    for method, answer, options in ANSWERS:
        asked = answer if method in OF_TURTLE else partial(_of_skills, answer)
        server.feature(method, options)(partial(asked, session))
    return session


def _of_skills(answer: Answer, session: Session, params: Any) -> object:
    """Answer what is asked of a file of skills; nothing of a scene or a vocabulary."""
    document = getattr(params, "text_document", None)
    if document is not None and is_turtle(session.file(document.uri)):
        return None
    return answer(session, params)


def serve() -> bool:
    """Serve on stdin and stdout until the editor leaves, and return whether it said goodbye.

    Malformed for what is no message, OutputError where answers cannot be written.
    """
    session = make_session()
    answers = Answers(sys.stdout.buffer)
    session.server.start_io(cast(BinaryIO, Messages(sys.stdin.buffer, answers)), cast(BinaryIO, answers))
    if answers.refused is not None:
        raise OutputError(answers.refused)
    return session.over
