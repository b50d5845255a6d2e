"""Whoever is at a client answers what a skill asks: in the shell, by keys, from Python and by the API."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest
from click.shell_completion import ShellComplete

import skillc
from operating.terminal import Terminal
from server.running import RunningServer, wait_until
from server.test_client_commands import terminal_environment, type_in
from skillc.cli.main import skillc as command
from skillc.events import Requested
from waiting import LONG_S


@pytest.fixture
def here(server: RunningServer, monkeypatch: pytest.MonkeyPatch) -> RunningServer:
    monkeypatch.setenv("SKILLC_SERVER", f"http://127.0.0.1:{server.port}")
    monkeypatch.setenv("SKILLC_TOKEN", server.token)
    server.client.put("/cells/yard/pace", json={"factor": None})
    return server


def ask(server: RunningServer) -> str:
    """Start a task that asks; return the operation once it does."""
    name = str(server.submit(task="confirm")["id"])
    wait_until(lambda: server.client.get(f"/operations/{name}").json(), lambda found: found["prompts"])
    return name


def test_a_question_is_answered_in_the_shell(here: RunningServer) -> None:
    name = ask(here)
    assert f"{name}  yard  confirm  admin  running: asks: Is the cart free? (yes | no)" in type_in("ps").stdout
    offered = ShellComplete(command, {}, "skillc", "_SKILLC_COMPLETE").get_completions(["answer"], "y")
    assert [(each.value, each.help) for each in offered] == [("yes", "Is the cart free?")]
    refused = type_in("answer", "perhaps")
    assert refused.exit_code == 1 and "`perhaps` is no choice; there is `yes`, `no`" in refused.stderr
    assert type_in("answer", "yes").exit_code == 0
    assert type_in("wait", name).exit_code == 0
    assert "asks: Is the cart free? (yes | no)" in type_in("logs", name).stdout
    assert type_in("answer", "yes", name).exit_code == 1


def test_a_question_is_answered_from_python_with_who_it_was(here: RunningServer) -> None:
    ask(here)
    with skillc.connect() as connected:
        operation = connected.operation()
        assert [each.choices for each in operation.prompts] == [("yes", "no")]
        operation.answer("no")
        assert operation.wait(LONG_S).state == "failed"
        answers = [each.event.command for each in operation.events() if isinstance(each.event, Requested)]
    assert [(each.choice, each.who) for each in answers] == [("no", "admin")]  # type: ignore[union-attr]


def test_who_may_only_watch_cannot_answer(here: RunningServer) -> None:
    name = ask(here)
    token = here.client.post("/tokens", json={"name": "watcher", "role": "view"}).json()["token"]
    with here.client_of(token) as watcher:
        command = {"type": "answer", "choice": "yes"}
        assert watcher.post(f"/operations/{name}/commands", json=command).status_code == 403
    assert here.client.delete("/tokens/watcher").status_code == 204
    assert here.client.post(f"/operations/{name}/stop", json={}).status_code == 200


def test_keys_answer(here: RunningServer) -> None:
    name = ask(here)
    here.client.put("/cells/yard/pace", json={"factor": 0.2})
    with Terminal((sys.executable, "-m", "skillc", "attach", name), terminal_environment()) as terminal:
        terminal.expect(r"Is the cart free\?  1 yes  2 no  \(fails after (1 min 0|\d+) s\)")
        terminal.type("1")
        assert terminal.wait() == 0
    place = ("--library", str(here.folder), "--scene", str(here.folder / "yard.ttl"), "--backend", "kinematic")
    with Terminal(
        (sys.executable, "-m", "skillc", "run", *place, "--call", "Confirm()"), terminal_environment()
    ) as run:
        run.expect(r"Is the cart free\?  1 yes  2 no")
        run.type("2")
        assert run.wait() == 3


def test_without_a_terminal_the_question_is_printed(here: RunningServer, tmp_path: Path) -> None:
    name = ask(here)
    here.client.post(f"/operations/{name}/commands", json={"type": "answer", "choice": "yes"})
    assert "asks: Is the cart free?" in type_in("attach", name).stderr
    events = [json.loads(line)["event"] for line in type_in("logs", name, "--json").stdout.splitlines()]
    assert [len(each["prompts"]) for each in events if each["type"] == "prompts-changed"] == [1, 0]
