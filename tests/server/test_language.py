"""The language server for pages: it completes and checks the texts of a library, and sees no other file."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import pytest
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed

from server.running import RunningServer, wait_until
from skillc.server.context import MAX_OF_CLIENT
from skillc.server.language import stream
from waiting import LONG_S

OWN = "skill:///yard/yard.skill"
Json = dict[str, Any]


class Editor:
    """A page that edits."""

    def __init__(self, socket: ClientConnection) -> None:
        self.socket, self.count = socket, 0
        self.diagnostics: dict[str, list[Json]] = {}

    async def ask(self, method: str, params: object) -> Json:
        """Make a request and return its answer; diagnostics that come before it are kept."""
        self.count += 1
        number = self.count
        await self.socket.send(json.dumps({"jsonrpc": "2.0", "id": number, "method": method, "params": params}))
        while (message := await self.receive()).get("id") != number or "method" in message:
            pass
        return message

    async def tell(self, method: str, params: object) -> None:
        await self.socket.send(json.dumps({"jsonrpc": "2.0", "method": method, "params": params}))

    async def receive(self) -> Json:
        message: Json = json.loads(await asyncio.wait_for(self.socket.recv(), LONG_S))
        if message.get("method") == "textDocument/publishDiagnostics":
            self.diagnostics[message["params"]["uri"]] = message["params"]["diagnostics"]
        return message

    async def open(self, uri: str, text: str) -> None:
        document = {"uri": uri, "languageId": "skill", "version": 1, "text": text}
        await self.tell("textDocument/didOpen", {"textDocument": document})

    async def wait_for_diagnostics(self, uri: str) -> list[Json]:
        while uri not in self.diagnostics:
            await self.receive()
        return self.diagnostics.pop(uri)


@asynccontextmanager
async def editing(server: RunningServer, token: str | None = None, start: bool = True) -> AsyncIterator[Editor]:
    """Yield a page that is connected with a language server, which has started."""
    async with connect(f"{server.url.replace('http', 'ws')}/lsp", max_size=2**24) as socket:
        await socket.send(json.dumps({"token": token or server.token, "library": "yard"}))
        editor = Editor(socket)
        if start:
            asked = {"rootUri": "file:///etc", "rootPath": "/", "capabilities": {}}
            options = {"initializationOptions": {"commands": ["skillc.plan", "skillc.showReferences"]}}
            answer = await editor.ask("initialize", {**asked, **options})
            assert answer["result"]["capabilities"]["hoverProvider"]
            await editor.tell("initialized", {})
        yield editor


def run(server: RunningServer, edit: Callable[[Editor], Awaitable[None]]) -> None:
    async def connected() -> None:
        async with editing(server) as editor:
            await edit(editor)

    asyncio.run(connected())


def test_a_page_that_leaves_while_much_is_sent_leaves_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    program = "import pathlib, sys; pathlib.Path('begun').touch(); sys.stdout.write(1_000_000 * 'x')"
    (tmp_path / "much.py").write_text(program, "utf-8")
    monkeypatch.setattr(stream, "MODULE", "much")

    async def leave() -> None:
        async with asyncio.timeout(LONG_S), stream.language_server({"PYTHONPATH": str(tmp_path)}, str(tmp_path)):
            while not (tmp_path / "begun").exists():
                await asyncio.sleep(0.05)
            await asyncio.sleep(0.5)

    asyncio.run(leave())


def place(text: str, word: str) -> Json:
    line = next(number for number, each in enumerate(text.splitlines()) if word in each)
    return {"line": line, "character": text.splitlines()[line].index(word) + 1}


def test_a_page_edits_a_text(server: RunningServer) -> None:
    text = (server.folder / "yard.skill").read_text()

    async def edit(editor: Editor) -> None:
        await editor.open(OWN, text.replace("pre   from contain crate", "pre   from contian crate"))
        (found,) = await editor.wait_for_diagnostics(OWN)
        assert "contian" in found["message"]
        change = {"textDocument": {"uri": OWN, "version": 2}, "contentChanges": [{"text": text}]}
        await editor.tell("textDocument/didChange", change)
        assert await editor.wait_for_diagnostics(OWN) == []
        where = {"textDocument": {"uri": OWN}, "position": place(text, "Load(cart")}
        hover = await editor.ask("textDocument/hover", where)
        assert "Load" in str(hover["result"]["contents"])
        defined = await editor.ask("textDocument/definition", where)
        assert OWN in str(defined["result"]) and "file:" not in str(defined)
        renamed = await editor.ask("textDocument/rename", {**where, "newName": "Fetch"})
        assert OWN in str(renamed["result"]) and "file:" not in str(renamed)
        lenses = (await editor.ask("textDocument/codeLens", where))["result"]
        planned = [each["command"]["arguments"][0] for each in lenses if each["command"]["command"] == "skillc.plan"]
        named = [["plan", f"yard:{task}"] for task in ("carry", "carry_all")]
        assert [each["arguments"] for each in planned] == named and str(server.folder) not in str(lenses)
        offered = await editor.ask("textDocument/completion", where)
        assert offered["result"]
        formatted = await editor.ask(
            "textDocument/formatting", {**where, "options": {"tabSize": 4, "insertSpaces": True}}
        )
        assert "error" not in formatted

    run(server, edit)


@pytest.mark.parametrize(
    "uri",
    [
        "file:///etc/passwd",
        "skill:///yard/../secret.skill",
        "skill:///yard/%2e%2e/secret.skill",
        "skill:///other/yard.skill",
        "skill://yard/yard.skill",
        "skill:///yard/new.skill",
        "untitled:yard.skill",
        "yard.skill",
        "",
    ],
)
def test_nothing_but_the_texts_of_the_library_is_opened(server: RunningServer, uri: str) -> None:
    async def edit(editor: Editor) -> None:
        await editor.open(uri, "use skiros\n")  # a notification has no answer
        answer = await editor.ask(
            "textDocument/hover", {"textDocument": {"uri": uri}, "position": {"line": 0, "character": 0}}
        )
        assert answer["error"]["code"] == -32602, answer
        assert not editor.diagnostics

    run(server, edit)


def test_the_folder_that_a_page_names_is_not_taken(server: RunningServer) -> None:
    async def edit(editor: Editor) -> None:
        text = (server.folder / "yard.skill").read_text()
        await editor.open(OWN, text)
        await editor.wait_for_diagnostics(OWN)
        symbols = await editor.ask("workspace/symbol", {"query": ""})
        assert "Load" in str(symbols["result"]) and "Secret" not in str(symbols)

    run(server, edit)


@pytest.mark.parametrize(
    "method", ["workspace/executeCommand", "workspace/didChangeWorkspaceFolders", "workspace/applyEdit", "$/setTrace"]
)
def test_other_methods_are_refused(server: RunningServer, method: str) -> None:
    async def edit(editor: Editor) -> None:
        answer = await editor.ask(method, {"event": {"added": [{"uri": "file:///etc", "name": "etc"}], "removed": []}})
        assert answer["error"]["code"] == -32601

    run(server, edit)


def test_tests_are_run_for_those_who_may_edit(server: RunningServer) -> None:
    token = server.client.post("/tokens", json={"name": "operator", "role": "operate"}).json()["token"]

    async def ask() -> None:
        asked = {"textDocument": {"uri": OWN}, "name": "none"}
        async with editing(server) as editor:
            assert "there is no test `none`" in (await editor.ask("skillc/runTest", asked))["error"]["message"]
        async with editing(server, token) as editor:
            assert "the role `edit`" in (await editor.ask("skillc/runTest", asked))["error"]["message"]

    asyncio.run(ask())


def children_of(process: int) -> set[int]:
    return {int(each) for each in Path(f"/proc/{process}/task/{process}/children").read_text().split()}


def language_servers(server: RunningServer) -> set[int]:
    found = set[int]()
    for each in children_of(server.process.pid):
        try:
            command = Path(f"/proc/{each}/cmdline").read_bytes()
        except OSError:
            continue
        found |= {each} if b"language_server" in command else set()
    return found


def test_its_process_ends_with_the_page(server: RunningServer) -> None:
    async def edit() -> None:
        async with editing(server) as editor:
            assert len(language_servers(server)) == 1
            editor.socket.transport.abort()

    asyncio.run(edit())
    wait_until(lambda: language_servers(server), lambda found: not found)


def test_it_ends_when_its_token_is_revoked(server: RunningServer) -> None:
    token = server.client.post("/tokens", json={"name": "leaver", "role": "view"}).json()["token"]

    async def edit() -> int:
        async with editing(server, token) as editor:
            server.client.delete("/tokens/leaver")
            with pytest.raises(ConnectionClosed) as closed:
                await editor.ask("workspace/symbol", {"query": ""})
        assert closed.value.rcvd is not None
        return closed.value.rcvd.code

    assert asyncio.run(edit()) == 1008
    wait_until(lambda: language_servers(server), lambda found: not found)


def test_a_client_has_few_of_them(server: RunningServer) -> None:
    async def crowd() -> int:
        async def open_one(depth: int) -> int:
            async with editing(server, start=depth == 0) as editor:
                if depth < MAX_OF_CLIENT:
                    return await open_one(depth + 1)
                with pytest.raises(ConnectionClosed) as closed:
                    await editor.receive()
            assert closed.value.rcvd is not None
            return closed.value.rcvd.code

        return await open_one(0)

    assert asyncio.run(crowd()) == 1013
    wait_until(lambda: language_servers(server), lambda found: not found)


@pytest.mark.parametrize("content", ["[]", "nothing", "[" * 100_000, '{"a":' * 50_000, "1", b"\x00"])
def test_what_is_no_message_closes_the_connection_alone(server: RunningServer, content: str | bytes) -> None:
    async def edit() -> int:
        async with editing(server, start=False) as editor:
            await editor.socket.send(content)
            with pytest.raises(ConnectionClosed) as closed:
                await editor.receive()
        assert closed.value.rcvd is not None
        return closed.value.rcvd.code

    assert asyncio.run(edit()) == 1008
    assert server.client.get("/cells/yard").status_code == 200


@pytest.mark.parametrize("hello", ["{}", '{"library": "yard"}', '{"library": "yard", "token": "wrong"}'])
def test_without_a_token_there_is_none(server: RunningServer, hello: str) -> None:
    async def greet() -> int:
        async with connect(f"{server.url.replace('http', 'ws')}/lsp") as socket:
            await socket.send(hello)
            with pytest.raises(ConnectionClosed) as closed:
                await socket.recv()
        assert closed.value.rcvd is not None
        return closed.value.rcvd.code

    assert asyncio.run(greet()) == 1008 and not language_servers(server)
