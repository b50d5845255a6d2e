"""Stop means the cell, whoever started what: by the button and by the key, in every state of the page."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeAlias

import httpx
import pytest
from playwright.sync_api import Browser, BrowserContext, Page, Route, expect

from server.running import RunningServer, is_listening, start_server, wait_until
from server.test_leases import client_of
from server.test_trials import CARRY
from studio.conftest import OUT, PATIENCE
from studio.opening import choose, open_studio, put_back, wait_for_state

pytestmark = pytest.mark.early

KEY, KEY_EVERYWHERE = "x", "Control+Shift+X"
WHY = "admin: stopped in the studio"
Arrange: TypeAlias = Callable[[Page], object]


@pytest.fixture
def anna(server: RunningServer) -> Iterator[httpx.Client]:
    """Another client, with the role `operate`."""
    with client_of(server, "anna", "operate") as client:
        yield client


def start_rest(client: httpx.Client, server: RunningServer) -> str:
    """Let a client start what goes on until it is stopped; return the operation, which runs."""
    answer = client.post("/cells/yard/operations", json={"task": "rest"})
    assert answer.status_code == 201, answer.text
    operation = str(answer.json()["id"])
    server.wait_for(operation, "running")
    return operation


def press_button(page: Page) -> None:
    page.get_by_role("button", name="Stop", exact=True).click()


def show_end(page: Page) -> None:
    page.keyboard.press("h")
    page.locator(".run-item", has_text="stopped").first.locator(".run-show").click()
    wait_for_state(page, "stopped", "rest")


def show_replay(page: Page) -> None:
    page.keyboard.press("h")
    page.locator(".run-item").first.get_by_role("button", name="Replay").click()
    page.get_by_role("toolbar", name="Replay").wait_for()


def use_slider(page: Page) -> None:
    show_replay(page)
    page.get_by_role("slider", name="Time").focus()


def show_comparison(page: Page) -> None:
    page.keyboard.press("h")
    page.locator(".run-item").get_by_role("button", name="Compare").first.click()
    page.locator(".comparison-table").wait_for()


def show_series(page: Page) -> None:
    page.keyboard.press("h")
    page.get_by_role("tab", name="Jobs").click()
    page.locator(".series", has_text="Trials").first.click()
    page.get_by_role("main", name="Trials of carry").wait_for()


def ask_to_forget(page: Page) -> None:
    show_series(page)
    page.get_by_role("button", name="Forget").click()


def write_goal(page: Page) -> None:
    page.keyboard.press("r")
    page.get_by_role("combobox", name="Goal").fill("lab:Goal contain lab:crate-1")


def search_runs(page: Page) -> None:
    page.keyboard.press("h")
    page.get_by_label("Search in the runs").fill("carry")


def write_source(page: Page) -> None:
    page.keyboard.press("s")
    page.locator(".source-editor .cm-line").first.click()


def write_edit(page: Page) -> None:
    page.keyboard.press("f")
    page.get_by_role("button", name="Add", exact=True).click()
    page.get_by_role("button", name="Several facts").click()
    page.get_by_label("Fact 1").fill("lab:crate-1 ")


def enlarge(page: Page) -> None:
    page.keyboard.press("2")
    page.keyboard.press("m")


def open_lease(page: Page) -> None:
    page.get_by_role("button", name="Lease: free").click()


def show_help(page: Page) -> None:
    page.keyboard.press("?")
    page.get_by_role("dialog").wait_for()


STATES: dict[str, tuple[Arrange, str]] = {
    "an operation that has ended": (show_end, KEY),
    "the runs": (lambda page: page.keyboard.press("h"), KEY),
    "a search field": (search_runs, KEY_EVERYWHERE),
    "a replay": (show_replay, KEY),
    "the slider of a replay": (use_slider, KEY),
    "a comparison": (show_comparison, KEY),
    "a series of trials": (show_series, KEY),
    "a question": (ask_to_forget, KEY),
    "what to run next": (lambda page: page.keyboard.press("r"), KEY),
    "a plan that can be started": (lambda page: choose(page, "carry_all"), KEY),
    "a goal that is written": (write_goal, KEY_EVERYWHERE),
    "a fact that is written": (write_edit, KEY_EVERYWHERE),
    "source that is written": (write_source, KEY_EVERYWHERE),
    "one panel": (enlarge, KEY),
    "the 3-D view": (lambda page: page.locator(".scene-view canvas").click(), KEY),
    "a choice": (lambda page: page.get_by_role("combobox", name="Cell", exact=True).focus(), KEY),
    "the help": (show_help, KEY),
    "the lease": (open_lease, KEY),
}
"""What a page shows, how it comes to that, and the key that stops there."""


@pytest.fixture(scope="module")
def watching(browser: Browser, server: RunningServer) -> Iterator[Page]:
    """A page of a cell with operations that have ended, and a series of trials."""
    put_back(server)
    for _ in range(2):
        server.client.post(f"/operations/{start_rest(server.client, server)}/stop")
    begun = server.begin("trials", **CARRY, number=1)
    server.wait_for_job(begun["id"])
    context = browser.new_context(viewport={"width": 1280, "height": 800})
    context.set_default_timeout(8_000 * PATIENCE)
    page = context.new_page()
    open_studio(page, server)
    yield page
    context.close()
    server.client.delete(f"/jobs/{begun['id']}")


@pytest.mark.parametrize("state", STATES)
def test_the_key_and_the_button_stop_what_another_client_runs(
    watching: Page, server: RunningServer, anna: httpx.Client, state: str
) -> None:
    arrange, key = STATES[state]
    watching.reload()
    watching.locator(".topbar .operation .badge").wait_for()
    arrange(watching)
    for press in (lambda page: page.keyboard.press(key), press_button):
        operation = start_rest(anna, server)
        press(watching)
        assert server.wait_for(operation, "stopped")["reason"] == WHY
        expect(watching.locator(".messages")).to_contain_text("yard was stopped")


@pytest.mark.parametrize(
    ("first", "state"),
    [({"task": "carry_all", "approve": True}, "planned"), ({"task": "carry_two", "step": True}, "paused")],
)
def test_all_that_goes_on_is_stopped_whatever_its_state(
    watching: Page, server: RunningServer, anna: httpx.Client, first: dict[str, object], state: str
) -> None:
    watching.reload()
    watching.locator(".topbar .operation .badge").wait_for()
    show_end(watching)
    put_back(server)
    started = list[str]()
    waiting = {"task": "carry_all", "approve": True}
    for request, wanted in ((first, (state,)), (waiting, ("queued", "planned")), ({"task": "rest"}, ("running",))):
        started.append(str(anna.post("/cells/yard/operations", json=request).json()["id"]))
        server.wait_for(started[-1], *wanted)
    unseen = f"{first['task']} goes on and is not shown"
    pause = watching.get_by_role("button", name="Pause", exact=True)
    expect(pause).to_have_attribute("title", f"{unseen}; the strip on top leads to it.")
    watching.keyboard.press("p")
    expect(watching.get_by_role("alert").filter(has_text=unseen)).to_be_visible()
    watching.keyboard.press(KEY)
    expect(watching.get_by_role("status").filter(has_text="was stopped")).to_contain_text(
        "carry_all (anna), rest (anna)"
    )
    for operation in started:
        server.wait_for(operation, "stopped")


def test_a_key_that_writes_stops_nothing(watching: Page, server: RunningServer, anna: httpx.Client) -> None:
    watching.reload()
    watching.locator(".topbar .operation .badge").wait_for()
    operation = start_rest(anna, server)
    write_goal(watching)
    for key in ("x", "X", "Control+x"):
        watching.keyboard.press(key)
    expect(watching.get_by_role("combobox", name="Goal")).to_have_value("lab:Goal contain lab:crate-1xX")
    assert server.client.get(f"/operations/{operation}").json()["state"] == "running"
    watching.keyboard.press("Escape")
    watching.keyboard.press("Escape")
    watching.keyboard.press("X")
    server.wait_for(operation, "stopped")


def test_stop_without_a_connection_says_so_and_works_again_with_one(
    context: BrowserContext, fragile: RunningServer
) -> None:
    put_back(fragile)
    page = context.new_page()
    open_studio(page, fragile)
    fragile.process.kill()
    fragile.process.wait()
    page.get_by_text("no connection").wait_for()
    for press in (lambda page: page.keyboard.press(KEY), press_button):
        press(page)
        said = page.get_by_role("alert").filter(
            has_text="Whether yard stops is not known: the server cannot be reached"
        )
        expect(said).to_contain_text("Use the emergency stop of the machine.")
        said.get_by_role("button", name="Dismiss").click()
    page.screenshot(path=OUT / "stop-disconnected.png")
    fragile.process = start_server(fragile.folder, fragile.port)
    wait_until(lambda: is_listening(fragile.port), bool)
    page.get_by_text("no connection").wait_for(state="hidden")
    fragile.wait_ready()
    for press in (lambda page: page.keyboard.press(KEY), press_button):
        operation = fragile.submit(task="many")["id"]
        fragile.wait_for(operation, "running")
        press(page)
        assert fragile.wait_for(operation, "stopped")["reason"] == WHY


def test_stop_that_is_not_answered_says_so_meanwhile(watching: Page, server: RunningServer, anna: httpx.Client) -> None:
    watching.reload()
    watching.locator(".topbar .operation .badge").wait_for()
    held = list[Route]()
    watching.route("**/cells/yard/stop", lambda route: held.append(route))
    watching.keyboard.press(KEY)
    expect(watching.get_by_role("alert")).to_contain_text("not known: the server has not answered yet")
    held[0].continue_()
    expect(watching.get_by_role("status").filter(has_text="yard was stopped")).to_be_visible()
    watching.unroute("**/cells/yard/stop")
