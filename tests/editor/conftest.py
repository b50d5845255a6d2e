"""One language server for all tests of the editor, spoken to over the real protocol, and a desk to write at."""

from __future__ import annotations

import itertools
import sys
from collections.abc import AsyncIterator, Iterator

import pytest
import pytest_lsp
from lsprotocol import types
from pytest_lsp import ClientServerConfig, LanguageClient, client_capabilities, make_test_lsp_client

from editor.desk import Desk

SERVER = [sys.executable, "-c", "from skillc.cli.main import main; main(['lsp', '--stdio'])"]
COMMANDS = ["skillc.run", "skillc.plan", "skillc.test", "skillc.showReferences"]
_numbers = itertools.count()


def make_client() -> LanguageClient:
    """Return an editor that grants what the server asks for, and remembers it."""
    made = make_test_lsp_client()
    made.registered = []

    @made.feature(types.CLIENT_REGISTER_CAPABILITY)
    def register(params: types.RegistrationParams) -> None:
        made.registered += [registration.method for registration in params.registrations]

    return made


@pytest_lsp.fixture(
    config=ClientServerConfig(server_command=SERVER, client_factory=make_client), scope="session", loop_scope="session"
)  # type: ignore[untyped-decorator]
async def client(lsp_client: LanguageClient, tmp_path_factory: pytest.TempPathFactory) -> AsyncIterator[None]:
    """Start a server for an editor that has one folder open, and see it off in the end."""
    folder = tmp_path_factory.getbasetemp()
    lsp_client.initialize_result = await lsp_client.initialize_session(
        types.InitializeParams(
            capabilities=client_capabilities("visual-studio-code"),
            initialization_options={"commands": COMMANDS},
            workspace_folders=[types.WorkspaceFolder(folder.as_uri(), "tests")],
        )
    )
    yield
    await lsp_client.shutdown_session()


@pytest.fixture
def desk(client: LanguageClient, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Desk]:
    """Return a desk with a folder of its own, and tidy it in the end."""
    desk = Desk(client, tmp_path_factory.mktemp(f"library_{next(_numbers)}"))
    yield desk
    for name in list(desk.versions):
        desk.close(name)
