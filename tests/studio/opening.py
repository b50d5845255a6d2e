"""Opens the page of a server, as `skillc studio` does."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from functools import partial

from playwright.sync_api import Page

from server.running import RunningServer, wait_until

EXPECTED_ERRORS = (
    "401 (Unauthorized)",
    "ERR_CONNECTION_REFUSED",
    "WebSocket connection to",
    "409 (Conflict)",
    "422 (Unprocessable",
    "503 (Service Unavailable)",
)
"""What browsers write to the console for answers and losses that the page shows itself."""


FINISHED = "finished, not verified"
"""The end of a task in the yard, where nobody looks whether the crates are there."""


def make_code(server: RunningServer) -> str:
    """Return a code that is good for one login."""
    answer = server.client.post("/login-codes")
    assert answer.status_code == 201, answer.text
    return str(answer.json()["code"])


def origin_of(server: RunningServer) -> str:
    return server.url.removesuffix("/api/v1")


def open_studio(page: Page, server: RunningServer) -> None:
    """Open the page with a code, and wait until the tasks of the cell are there."""
    warm_up(server)
    page.goto(f"{origin_of(server)}/#code={make_code(server)}")
    page.locator(".workspace").wait_for()
    page.get_by_text("operational").wait_for()


def warm_up(server: RunningServer) -> None:
    """Let the workers of a server start, which takes them several seconds; a server that is busy refuses meanwhile."""
    get = partial(server.client.get, timeout=120.0)
    with ThreadPoolExecutor() as together:
        asked = [partial(get, f"/cells/yard/{part}") for part in ("library", "world")]
        answers = [together.submit(wait_until, each, lambda answer: answer.is_success) for each in asked]
    for each in answers:
        each.result()


def choose(page: Page, task: str) -> None:
    """Choose a task, and wait for its plan."""
    page.keyboard.press("r")
    page.get_by_role("list", name="Tasks").get_by_role("button", name=task).first.click()


def start(page: Page, task: str) -> None:
    """Choose a task, see its plan, and start it."""
    choose(page, task)
    page.get_by_role("region", name="Plan").or_(page.locator(".plan")).first.wait_for()
    page.get_by_role("button", name="Start", exact=True).click()


def wait_for_state(page: Page, state: str, task: str = "carry_all") -> None:
    """Wait until the bar on top says the state of an operation of a task."""
    shown = page.locator(".topbar .operation", has=page.locator("strong", has_text=task))
    shown.locator(".badge", has_text=state).wait_for()
