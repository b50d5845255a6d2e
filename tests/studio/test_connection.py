"""The page while its server dies and comes back, and while cells are off."""

from __future__ import annotations

from pathlib import Path

from playwright.sync_api import BrowserContext, expect

from server.running import is_listening, serving, start_server, wait_until
from studio.opening import FINISHED, open_studio, start, wait_for_state


def test_a_server_that_is_killed_and_comes_back(context: BrowserContext, tmp_path: Path) -> None:
    with serving(tmp_path) as server:
        page = context.new_page()
        open_studio(page, server)
        start(page, "carry_all")
        wait_for_state(page, FINISHED)
        rows = page.locator(".tree-row").first
        before = rows.get_attribute("aria-setsize")
        server.process.kill()
        server.process.wait()
        expect(page.get_by_text("no connection")).to_be_visible()
        again = start_server(tmp_path, server.port)
        try:
            wait_until(lambda: is_listening(server.port), bool)
            expect(page.get_by_text("no connection")).to_be_hidden()
            assert before is not None
            expect(rows).to_have_attribute("aria-setsize", before)
            expect(page.locator(".plan-step .is-good")).to_have_count(12)
            server.wait_ready()
            page.keyboard.press("h")
            expect(page.locator(".run-item").first).to_contain_text("carry_all")
        finally:
            again.terminate()
            again.wait(30.0)


def test_a_cell_that_dies_is_said_and_its_operation_is_interrupted(context: BrowserContext, tmp_path: Path) -> None:
    with serving(tmp_path, takes_ms=2000) as server:
        server.client.put("/cells/yard/pace", json={"factor": 0.5})
        page = context.new_page()
        open_studio(page, server)
        start(page, "carry_all")
        wait_for_state(page, "running")
        _kill_cell(server.process.pid)
        wait_for_state(page, "interrupted")
        page.locator(".decisions button", has_text="Plan again").wait_for(timeout=60_000)  # the cell starts first
        page.locator(".decisions button", has_text="Plan again").click()
        wait_for_state(page, "running")


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
