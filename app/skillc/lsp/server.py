"""The language server: maps each request to its handler."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial
from importlib.metadata import version
from typing import Any, BinaryIO, TypeAlias, cast

from lsprotocol import types
from pygls.lsp.server import LanguageServer

from skillc.errors import OutputError
from skillc.lsp import edits as writing
from skillc.lsp import hints, lenses, testing
from skillc.lsp import notifications as documents
from skillc.lsp import queries as reading
from skillc.lsp.files import is_rdf
from skillc.lsp.messages import MessageReader, MessageWriter, Protocol
from skillc.lsp.session import Session

Handler: TypeAlias = Callable[[Session, Any], object]

_LEGEND = types.SemanticTokensLegend(list(reading.TOKEN_KINDS), ["declaration"])
_FIXES = [types.CodeActionKind.QuickFix, writing.FIX_ALL]
HANDLERS: tuple[tuple[str, Handler, object], ...] = (
    (types.INITIALIZE, documents.on_initialize, None),
    (types.INITIALIZED, documents.on_initialized, None),
    (types.SHUTDOWN, documents.on_shutdown, None),
    (types.WORKSPACE_DID_CHANGE_WORKSPACE_FOLDERS, documents.on_folders_changed, None),
    (types.WORKSPACE_DID_CHANGE_WATCHED_FILES, documents.on_disk_change, None),
    (types.TEXT_DOCUMENT_DID_OPEN, documents.on_open, None),
    (types.TEXT_DOCUMENT_DID_CHANGE, documents.on_change, None),
    (types.TEXT_DOCUMENT_DID_SAVE, documents.on_save, None),
    (types.TEXT_DOCUMENT_DID_CLOSE, documents.on_close, None),
    (types.TEXT_DOCUMENT_HOVER, reading.show_hover, None),
    (types.TEXT_DOCUMENT_DEFINITION, reading.find_definition, None),
    (types.TEXT_DOCUMENT_IMPLEMENTATION, reading.find_implementations, None),
    (types.TEXT_DOCUMENT_REFERENCES, reading.find_references, None),
    (types.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT, reading.find_highlights, None),
    (types.TEXT_DOCUMENT_DOCUMENT_SYMBOL, reading.list_document_symbols, None),
    (types.WORKSPACE_SYMBOL, reading.list_workspace_symbols, None),
    (types.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL, reading.encode_semantic_tokens, _LEGEND),
    (types.TEXT_DOCUMENT_CODE_LENS, lenses.show_lenses, None),
    (types.TEXT_DOCUMENT_INLAY_HINT, hints.show_hints, None),
    (types.TEXT_DOCUMENT_FOLDING_RANGE, reading.find_folds, None),
    (types.TEXT_DOCUMENT_SIGNATURE_HELP, reading.show_signature, types.SignatureHelpOptions(["(", ","])),
    (
        types.TEXT_DOCUMENT_COMPLETION,
        writing.offer_completions,
        types.CompletionOptions([".", "(", ",", ":", '"', " "]),
    ),
    (types.TEXT_DOCUMENT_PREPARE_RENAME, writing.prepare_rename, None),
    (types.TEXT_DOCUMENT_RENAME, writing.rename, types.RenameOptions(prepare_provider=True)),
    (types.TEXT_DOCUMENT_CODE_ACTION, writing.offer_code_actions, types.CodeActionOptions(_FIXES)),
    (types.TEXT_DOCUMENT_FORMATTING, writing.format_document, None),
    (testing.METHOD, testing.run_test, None),
)

FOR_TURTLE = (
    types.TEXT_DOCUMENT_DID_OPEN,
    types.TEXT_DOCUMENT_DID_CHANGE,
    types.TEXT_DOCUMENT_DID_SAVE,
    types.TEXT_DOCUMENT_DID_CLOSE,
    types.TEXT_DOCUMENT_CODE_ACTION,
    types.TEXT_DOCUMENT_INLAY_HINT,
    types.TEXT_DOCUMENT_DEFINITION,
    types.TEXT_DOCUMENT_REFERENCES,
    types.TEXT_DOCUMENT_PREPARE_RENAME,
    types.TEXT_DOCUMENT_RENAME,
)
"""The requests that are also answered for scenes and vocabularies."""


def make_session() -> Session:
    """Return a session whose server is ready to start.

    Editors are asked for whole texts: pygls applies incremental changes with lines that also end at form feeds and
    U+2028, which end a line neither in the protocol nor in the language.
    """
    server = LanguageServer("skillc", version("skillc"), types.TextDocumentSyncKind.Full, protocol_cls=Protocol)
    session = Session(server)
    for method, answer, options in HANDLERS:
        asked = answer if method in FOR_TURTLE else partial(_for_skill_files, answer)
        server.feature(method, options)(partial(asked, session))
    return session


def _for_skill_files(answer: Handler, session: Session, params: Any) -> object:
    """Answer a request about a skill file; return None for a scene or a vocabulary."""
    document = getattr(params, "text_document", None)
    if document is not None and is_rdf(session.file(document.uri)):
        return None
    return answer(session, params)


def serve() -> bool:
    """Serve on stdin and stdout until the input ends, and return whether the editor asked for the shutdown.

    MalformedMessage if the input is not a message, OutputError if answers cannot be written.
    """
    session = make_session()
    answers = MessageWriter(sys.stdout.buffer)
    # wait ends: when the editor closes the input
    session.server.start_io(cast(BinaryIO, MessageReader(sys.stdin.buffer, answers)), cast(BinaryIO, answers))
    if answers.refused is not None:
        raise OutputError(answers.refused)
    return session.over
