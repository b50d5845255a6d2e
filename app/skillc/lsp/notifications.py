"""Handlers of notifications about files and folders: opened, changed, saved, closed."""

from __future__ import annotations

from collections.abc import Mapping

from lsprotocol import types

from skillc.lsp.session import Session
from skillc_ontology import catalogue

_WATCHED = ("**/*.skill", *(f"**/*{ending}" for ending in catalogue.ENDINGS), "**/skillc.toml")


def on_initialize(session: Session, params: types.InitializeParams) -> None:
    """Note which commands the editor carries out."""
    options = params.initialization_options
    named = options.get("commands") if isinstance(options, Mapping) else getattr(options, "commands", None)
    session.commands = frozenset(each for each in named or () if isinstance(each, str))


def on_initialized(session: Session, params: types.InitializedParams) -> None:
    """Store the open folders, and subscribe to changes of files on disk."""
    workspace = session.server.workspace
    session.folders([folder.uri for folder in workspace.folders.values()] or _root(workspace.root_uri))
    capabilities = session.server.client_capabilities.workspace
    watching = capabilities.did_change_watched_files if capabilities else None
    if watching and watching.dynamic_registration:
        options = types.DidChangeWatchedFilesRegistrationOptions([types.FileSystemWatcher(glob) for glob in _WATCHED])
        method = types.WORKSPACE_DID_CHANGE_WATCHED_FILES
        session.server.client_register_capability(
            types.RegistrationParams([types.Registration("watched-files", method, options)])
        )


def on_shutdown(session: Session, params: None) -> None:
    """Note that the editor has asked for a shutdown."""
    session.over = True


def on_folders_changed(session: Session, params: types.DidChangeWorkspaceFoldersParams) -> None:
    """Store the open folders."""
    session.folders([folder.uri for folder in session.server.workspace.folders.values()])
    session.schedule_publishing()


def on_open(session: Session, params: types.DidOpenTextDocumentParams) -> None:
    """Use the editor's text of a file from now on."""
    session.libraries.write(params.text_document.uri, params.text_document.text)
    session.publish()


def on_change(session: Session, params: types.DidChangeTextDocumentParams) -> None:
    """Store the new text of a file."""
    uri = params.text_document.uri
    session.libraries.write(uri, session.server.workspace.get_text_document(uri).source)
    session.schedule_publishing()


def on_save(session: Session, params: types.DidSaveTextDocumentParams) -> None:
    """Read a file from disk again."""
    session.libraries.forget(session.file(params.text_document.uri))
    session.schedule_publishing()


def on_close(session: Session, params: types.DidCloseTextDocumentParams) -> None:
    """Use the text of a file on disk from now on."""
    session.libraries.close(params.text_document.uri)
    session.publish()


def on_disk_change(session: Session, params: types.DidChangeWatchedFilesParams) -> None:
    """Read files again that another program has written, created or deleted."""
    for change in params.changes:
        session.libraries.forget(session.file(change.uri))
    session.schedule_publishing()


def _root(uri: str | None) -> list[str]:
    return [uri] if uri else []
