"""What the editor says of its files and folders."""

from __future__ import annotations

from lsprotocol import types

from skillc.lsp.session import Session

_WATCHED = ("**/*.skill", "**/*.ttl")


def initialized(session: Session, params: types.InitializedParams) -> None:
    """Note the folders that are open, and ask to be told of changes on disk."""
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


def shut_down(session: Session, params: None) -> None:
    """Note that the editor has said goodbye."""
    session.over = True


def folders_changed(session: Session, params: types.DidChangeWorkspaceFoldersParams) -> None:
    """Note which folders are open."""
    session.folders([folder.uri for folder in session.server.workspace.folders.values()])
    session.schedule_publishing()


def opened(session: Session, params: types.DidOpenTextDocumentParams) -> None:
    """Take the text of a file from the editor."""
    session.libraries.write(params.text_document.uri, params.text_document.text)
    session.publish()


def changed(session: Session, params: types.DidChangeTextDocumentParams) -> None:
    """Take the new text of a file."""
    uri = params.text_document.uri
    session.libraries.write(uri, session.server.workspace.get_text_document(uri).source)
    session.schedule_publishing()


def saved(session: Session, params: types.DidSaveTextDocumentParams) -> None:
    """Look at the disk again."""
    session.libraries.forget(session.file(params.text_document.uri))
    session.schedule_publishing()


def closed(session: Session, params: types.DidCloseTextDocumentParams) -> None:
    """Take the text of a file from the disk again."""
    session.libraries.close(params.text_document.uri)
    session.publish()


def changed_on_disk(session: Session, params: types.DidChangeWatchedFilesParams) -> None:
    """Look at files again that something else has written, made or deleted."""
    for change in params.changes:
        session.libraries.forget(session.file(change.uri))
    session.schedule_publishing()


def _root(uri: str | None) -> list[str]:
    return [uri] if uri else []
