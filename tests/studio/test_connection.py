"""The page while its server dies and comes back, and while cells are off."""

from __future__ import annotations

from pathlib import Path

from playwright.sync_api import BrowserContext, expect

from server.running import RunningServer, is_listening, start_server, wait_until
from studio.opening import FINISHED, open_studio, put_back, start, wait_for_state


def test_a_server_that_is_killed_and_comes_back(context: BrowserContext, fragile: RunningServer) -> None:
    put_back(fragile)
    fragile.client.put("/cells/yard/pace", json={"factor": None})
    page = context.new_page()
    open_studio(page, fragile)
    start(page, "carry_all")
    wait_for_state(page, FINISHED)
    rows = page.locator(".tree-row").first
    before = rows.get_attribute("aria-setsize")
    fragile.process.kill()
    fragile.process.wait()
    expect(page.get_by_text("no connection")).to_be_visible()
    fragile.process = start_server(fragile.folder, fragile.port)
    wait_until(lambda: is_listening(fragile.port), bool)
    expect(page.get_by_text("no connection")).to_be_hidden()
    assert before is not None
    expect(rows).to_have_attribute("aria-setsize", before)
    expect(page.locator(".plan-step .is-good")).to_have_count(12)
    fragile.wait_ready()
    page.keyboard.press("h")
    expect(page.locator(".run-item").first).to_contain_text("carry_all")


def test_a_cell_that_dies_is_said_and_its_operation_is_interrupted(
    context: BrowserContext, fragile: RunningServer
) -> None:
    put_back(fragile)
    fragile.client.put("/cells/yard/pace", json={"factor": 0.5})
    page = context.new_page()
    open_studio(page, fragile)
    start(page, "carry_all")
    wait_for_state(page, "running")
    _kill_cell(fragile.process.pid)
    wait_for_state(page, "interrupted")
    page.locator(".decisions button", has_text="Plan again").wait_for()  # the cell starts first
    page.locator(".decisions button", has_text="Plan again").click()
    wait_for_state(page, "running")
    put_back(fragile)


def _kill_cell(server: int) -> None:
    """Kill the process of the only cell of a server: its child that runs `skillc.cells.process`."""
    import os
    import signal

    for entry in Path("/proc").glob("[0-9]*"):
        try:
            parent = int((entry / "stat").read_text().rsplit(")", 1)[1].split()[1])
            command = (entry / "cmdline").read_bytes()
        except (OSError, IndexError):
            continue
        if parent == server and b"skillc.cells.process" in command:
            os.kill(int(entry.name), signal.SIGKILL)
