"""Opens the page of a server, as `skillc studio` does."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from functools import partial

from playwright.sync_api import Page

from running_cells.yard import CRATES
from server.running import RunningServer, wait_until
from waiting import LONG_S

EXPECTED_ERRORS = (
    "401 (Unauthorized)",
    "ERR_CONNECTION_REFUSED",
    "WebSocket connection to",
    "409 (Conflict)",
    "422 (Unprocessable",
    "503 (Service Unavailable)",
)
"""What browsers write to the console for answers and losses that the page shows itself."""


ENDS = ("succeeded", "failed", "stopped", "interrupted")
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
    page.get_by_text("operational", exact=True).wait_for()


def warm_up(server: RunningServer) -> None:
    """Let the workers of a server start, which takes them several seconds; a server that is busy refuses meanwhile."""
    get = partial(server.client.get, timeout=LONG_S)
    with ThreadPoolExecutor() as together:
        asked = [partial(get, f"/cells/yard/{part}") for part in ("library", "world")]
        answers = [together.submit(wait_until, each, lambda answer: answer.is_success) for each in asked]
    for each in answers:
        each.result()


def put_back(server: RunningServer) -> None:
    """Stop what goes on, and say that all crates are where they were at first; the pace is real then."""
    client = server.client
    for each in client.get("/cells/yard/operations").json():
        if each["state"] not in ENDS:
            client.post(f"/operations/{each['id']}/stop", json={"reason": "the next test begins"})
            server.wait_for(each["id"], *ENDS)
    facts = client.get("/cells/yard/world", params={"limit": 1000}).json()["facts"]
    contained = [each["fact"] for each in facts if each["fact"].get("relation", {}).get("label") == "contain"]
    moved = {each["object"]["label"]: each["subject"]["label"] for each in contained}
    edits = [
        edit
        for crate, place in moved.items()
        if place != "lab:Start"
        for edit in (f"not {place} skiros:contain {crate}", f"lab:Start skiros:contain {crate}")
    ]
    if edits:
        answer = client.post("/cells/yard/world/edits", json={"edits": edits, "why": "the next test begins"})
        assert answer.status_code == 204, answer.text
    assert len(moved) == CRATES
    client.put("/cells/yard/pace", json={"factor": 1.0})


def choose(page: Page, task: str) -> None:
    """Choose a task."""
    page.keyboard.press("r")
    page.get_by_role("list", name="Tasks").get_by_role("button", name=task).first.click()


def choose_planned(page: Page, task: str) -> None:
    """Choose a task, and wait for its plan."""
    choose(page, task)
    page.locator(".preview-step").first.wait_for()


def start(page: Page, task: str) -> None:
    """Choose a task, see its plan, and start it."""
    choose_planned(page, task)
    press_start(page)


def press_start(page: Page) -> None:
    """Start what is chosen; return when the page shows it instead of what ran before."""
    button = page.get_by_role("button", name="Start", exact=True)
    button.click()
    button.wait_for(state="detached")


def wait_for_state(page: Page, state: str, task: str = "carry_all") -> None:
    """Wait until the bar on top says the state of an operation of a task."""
    shown = page.locator(".topbar .operation", has=page.locator("strong", has_text=task))
    shown.locator(".badge", has_text=state).wait_for()


LAST_EVENT = """() => new Promise((resolve) => {
    const end = skillcStudio.told.subscribe((state) => {
        if (state.ended === null) return;
        resolve(state.lastEvent);
        queueMicrotask(() => end());
    });
})"""


def wait_for_last_event(page: Page) -> int:
    """Wait until the page has the event that an operation has ended; return its number."""
    return int(page.evaluate(LAST_EVENT))
