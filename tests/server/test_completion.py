"""A shell offers what the server has; what bash makes of it is seen in a real one, with its own ends of words."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from click.shell_completion import ShellComplete

from operating.terminal import Terminal
from server.running import RunningServer, find_cell_process, wait_until
from server.test_client_commands import here, terminal_environment, type_in  # noqa: F401
from skillc.cli.main import VARIABLE, skillc

BASH = ("bash", "--norc", "--noprofile", "-i")


@pytest.fixture
def shell(here: RunningServer, tmp_path: Path) -> Iterator[Terminal]:  # noqa: F811
    path = f"{Path(sys.executable).parent}:{os.environ['PATH']}"
    with Terminal(BASH, {**terminal_environment(), "PATH": path, "PS1": "> "}, folder=tmp_path) as terminal:
        terminal.type('eval "$(skillc completion bash)"; echo ready\n')
        terminal.expect(r"\nready\s")
        yield terminal


def press_tab(shell: Terminal, line: str, pattern: str) -> None:
    """Type a line, and a tab twice: what is offered is a match of a pattern. Empty the line again."""
    shell.type(f"{line}\t\t")
    shell.expect(pattern)
    shell.type("\x15")


def offer(*words: str) -> dict[str, str | None]:
    """Return what is offered for the last of some words, with what is said about each."""
    found = ShellComplete(skillc, {}, "skillc", VARIABLE).get_completions(list(words[:-1]), words[-1])
    return {each.value: each.help for each in found}


@pytest.mark.sim
def test_bash_completes_tasks_and_their_arguments(here: RunningServer, shell: Terminal) -> None:  # noqa: F811
    assert here.client.get("/cells/yard/library").status_code == 200  # a worker answers at once from now on
    press_tab(shell, "skillc start carry_a", "start carry_all ")
    press_tab(shell, "skillc start carry cr", r"carry crate=[^ ]")
    press_tab(shell, "skillc start carry crate=lab:crate-", r"\scrate-0 .*\scrate-5")
    press_tab(shell, "skillc start carry to=lab:S", "to=lab:Start ")


def test_names_of_the_server_are_offered(here: RunningServer) -> None:  # noqa: F811
    assert here.client.get("/cells/yard/library").status_code == 200  # a worker answers at once from now on
    tasks = {"carry": "Bring one crate to a place.", "carry_two": "Bring two crates in this order."}
    assert tasks.items() <= offer("start", "").items() and list(offer("rehearse", "carry_a")) == ["carry_all"]
    assert "carry_two" in offer("plan", "--cell", "yard", "carry") and "carry_two" not in offer("plan", "carry")
    assert offer("start", "carry", "") == {"crate=": "skiros:Product", "to=": "skiros:Location"}
    assert list(offer("trials", "--cell", "yard", "carry", "to=lab:Goal", "")) == ["crate="]
    assert offer("start", "carry", "crate=lab:crate-5") == {"crate=lab:crate-5": "skiros:Product"}
    assert list(offer("start", "carry", "to=")) == ["to=lab:Cart-1", "to=lab:Goal", "to=lab:Start"]
    assert list(offer("start", "carry_two", "--breakpoints", "Un")) == ["Unload"]
    assert offer("world", "--cell", "yard", "--show", "lab:Ca") == {"lab:Cart-1": "lab:Cart"}
    assert offer("world", "--show", "lab:Ca") == {}
    assert type_in("token", "add", "eve", "--role", "view").exit_code == 0
    assert offer("token", "revoke", "e") == {"eve": "view"}
    assert type_in("token", "revoke", "eve").exit_code == 0


@pytest.mark.sim
def test_operations_are_offered_where_they_make_sense(here: RunningServer) -> None:  # noqa: F811
    here.put_back(pace=0.1)
    ended = here.submit(goal="lab:Start contain lab:crate-0")["id"]
    here.wait_for(ended, "succeeded")
    broken = here.submit(task="carry_all")["id"]
    here.wait_for(broken, "running")
    os.kill(find_cell_process(here), signal.SIGKILL)
    wait_until(lambda: here.client.get(f"/operations/{broken}").json(), lambda it: it.get("decisions"))
    waiting = here.submit(task="carry_all", approve=True)["id"]
    here.wait_for(waiting, "planned")
    assert {ended, broken, waiting} <= offer("logs", "").keys()
    offered = {each: offer(each, "").keys() & {ended, broken, waiting} for each in ("approve", "replan", "retry")}
    assert offered == {"approve": {waiting}, "replan": {broken, waiting}, "retry": {broken}}
    here.submit(continues=broken, decision="replan", approve=True)
