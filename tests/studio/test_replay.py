"""A replay is as it was live: the state after each event, and all that is shown at the end."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from playwright.sync_api import Page, expect

from server.running import RunningServer
from studio.opening import FINISHED, start, wait_for_last_event, wait_for_state

ONE_BY_ONE = """(() => {
    const later = (what) => requestAnimationFrame(() => requestAnimationFrame(what));
    const { set } = Object.getOwnPropertyDescriptor(WebSocket.prototype, "onmessage");
    Object.defineProperty(WebSocket.prototype, "onmessage", { set(take) {
        const waiting = [];
        const next = () => {
            take({ data: JSON.stringify([waiting.shift()]) });
            if (waiting.length > 0) later(next);
        };
        set.call(this, (message) => {
            const found = typeof message.data === "string" ? JSON.parse(message.data) : [];
            if (found[0]?.sequence === undefined) return take(message);
            waiting.push(...found);
            if (waiting.length === found.length) later(next);
        });
    } });
})()"""
"""Gives the page each event alone, in a frame of its own, however many come at once."""
COLLECT = """() => {
    window.frames_ = {};
    window.stopCollecting?.();
    window.stopCollecting = skillcStudio.told.subscribe((state) => {
        if (state.lastEvent === 0) window.frames_ = {};  // Another operation is shown.
        const { time, ...rest } = { ...state, nodes: [...state.nodes] };
        window.frames_[state.lastEvent] = JSON.stringify(rest);
    });
}"""
SEEK_EVERYWHERE = """(times) => {
    const slider = document.querySelector(".replay-bar input[type=range]");
    for (const each of times) {
        slider.value = each;
        slider.dispatchEvent(new Event("input", { bubbles: true }));
    }
}"""

HAS_TREE = "(tree) => JSON.stringify(skillcStudio.planned.value) === JSON.stringify(JSON.parse(tree))"
"""Whether the page has this tree of the operation that it shows."""


@pytest.fixture
def page(context: object, page: Page) -> Page:
    """The page, which gets its events one by one."""
    page.add_init_script(ONE_BY_ONE)
    page.reload()
    page.locator(".workspace").wait_for()
    page.get_by_label("all nodes").check()
    page.evaluate(COLLECT)
    return page


def _read_frames(page: Page) -> dict[int, str]:
    """Return the states that the page has had since it was asked to collect them, by the number of their last event."""
    return {int(number): state for number, state in page.evaluate("window.frames_").items() if int(number) > 0}


def _read_shown(page: Page) -> dict[str, str]:
    """Return what is shown of a run, by panel."""
    page.get_by_role("tab", name="Plan over time").click()
    page.get_by_role("tab", name="Run", exact=True).click()
    page.get_by_role("tab", name="Why").click()
    shown = {
        "tree": ".tree",
        "state": ".topbar .operation .badge:not(:has-text('recording'))",
        "clock": ".topbar .clock",
        "plan": ".run .plan ol",
        "state in the panel": ".run .badge",
        "plan over time": "[data-panel=signals] .panel-body",
        "why": ".details > :not(.explanation):not(:last-child)",
        "number of lines": "#tab-events",
    }
    return {name: "\n".join(page.locator(each).all_inner_texts()) for name, each in shown.items()}


def _carry(page: Page) -> None:
    start(page, "carry_all")
    wait_for_state(page, FINISHED)


def _ask(page: Page, answer: str, end: str) -> None:
    page.keyboard.press("r")
    page.get_by_role("list", name="Tasks").get_by_role("button", name="confirm").click()
    page.get_by_role("button", name="Start", exact=True).click()
    page.get_by_role("button", name=answer, exact=True).click()
    wait_for_state(page, end, "confirm")


RUNS: dict[str, Callable[[Page], None]] = {
    "a plan": _carry,
    "a question": lambda page: _ask(page, "yes", "succeeded"),
    "a failure": lambda page: _ask(page, "no", "failed"),
}


@pytest.mark.parametrize("kind", RUNS)
def test_a_replay_is_as_it_was_live(page: Page, server: RunningServer, kind: str) -> None:
    RUNS[kind](page)
    wait_for_last_event(page)
    operation = server.client.get("/cells/yard/operations").json()[0]["id"]
    events = server.client.get(f"/operations/{operation}/events", params={"limit": 1000}).json()
    live = _read_frames(page)
    assert list(live) == [each["sequence"] for each in events]
    # The page asks for the tree of the plan a moment after what has changed it.
    tree = server.client.get(f"/operations/{operation}/tree").text
    page.wait_for_function(HAS_TREE, arg=tree)
    shown = _read_shown(page)
    page.keyboard.press("h")
    page.locator(".run-item").first.get_by_role("button", name="Replay").click()
    expect(page.get_by_role("toolbar", name="Replay")).to_be_visible()
    assert _read_shown(page) == shown
    times = sorted({each["event"]["time"] for each in events})
    page.evaluate(COLLECT)
    page.evaluate(SEEK_EVERYWHERE, [*times, *reversed(times)])
    replayed = _read_frames(page)
    assert len(replayed) == len(times) > 1, "each time has a state of its own"
    assert replayed == {each: live[each] for each in replayed}
