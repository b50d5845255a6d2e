"""Runs: the history is searched, a recording is dropped on the page, and two runs are shown side by side."""

from __future__ import annotations

import base64

import pytest
from playwright.sync_api import Page, expect

from server.running import RunningServer
from studio.accessibility import check_axe
from studio.opening import FINISHED, start, wait_for_state

DROP = """async ([name, content, type]) => {
    const bytes = Uint8Array.from(atob(content), (each) => each.charCodeAt(0));
    const data = new DataTransfer();
    data.items.add(new File([bytes], name));
    document.querySelector(".tree").dispatchEvent(
        new DragEvent(type, { dataTransfer: data, bubbles: true, cancelable: true }));
}"""


def run_fast(server: RunningServer, **request: object) -> str:
    """Run an operation to its end, and return its id."""
    server.client.put("/cells/yard/pace", json={"factor": None})
    operation = str(server.submit(**request)["id"])
    server.wait_for(operation, "succeeded", "failed", "stopped")
    return operation


def carry(server: RunningServer, crate: int) -> str:
    arguments = {"crate": f"lab:crate-{crate}", "to": "lab:Goal"}
    return run_fast(server, task="carry", arguments=arguments)


@pytest.mark.parametrize(
    "scheme", [pytest.param(each, marks=pytest.mark.looks(color_scheme=each)) for each in ("light", "dark")]
)
def test_two_runs_are_compared_as_skillc_diff_does(page: Page, server: RunningServer, scheme: str) -> None:
    one = run_fast(server, task="carry_all")
    server.put_back()
    other = run_fast(server, task="carry_two")
    page.keyboard.press("h")
    page.locator(f'.run-show[title="{one}"]').click()
    page.locator(".run-item", has=page.locator(f'[title="{other}"]')).get_by_role("button", name="Compare").click()
    compared = page.get_by_role("main", name="Two runs side by side")
    compared.locator(".comparison-table").wait_for()
    told = server.client.get(f"/operations/{one}/diff", params={"other": other}).json()
    assert len(told["differences"]) > 4
    expect(compared.locator(".differences tbody tr")).to_have_count(len(told["differences"]))
    numbers = [server.client.get(f"/operations/{each}/why").json()["calls"] for each in (one, other)]
    wanted = {each["number"] for calls in numbers for each in calls}
    shown = compared.locator(".comparison-table tbody th .mono").all_inner_texts()
    assert {number for each in shown for number in each.split(" / ")} == wanted
    assert any(" / " in each for each in shown), "calls of the same are in one line, whatever their numbers"
    check_axe(page, f"comparison-{scheme}")
    expect(compared.get_by_text("not in this run").first).to_be_visible()
    compared.get_by_role("button", name="Swap").click()
    expect(compared.locator("thead strong").first).to_have_attribute("title", str(other))
    page.keyboard.press("Escape")
    expect(compared).to_be_hidden()
    expect(page.locator(".tree")).to_be_visible()


def test_equal_runs_have_no_call_that_differs(page: Page, server: RunningServer) -> None:
    one = run_fast(server, task="carry_all")
    server.put_back()
    other = run_fast(server, task="carry_all")
    page.keyboard.press("h")
    page.locator(f'.run-show[title="{one}"]').click()
    page.locator(".run-item", has=page.locator(f'[title="{other}"]')).get_by_role("button", name="Compare").click()
    expect(page.locator(".comparison-call")).to_have_count(24)
    assert page.locator(".is-different").count() == 0
    page.get_by_label("only what differs").check()
    expect(page.get_by_text("All calls are the same")).to_be_visible()


def test_a_call_of_a_comparison_is_shown_in_its_run(page: Page, server: RunningServer) -> None:
    one, other = carry(server, 0), carry(server, 1)
    page.keyboard.press("h")
    page.locator(f'.run-show[title="{one}"]').click()
    page.locator(".run-item", has=page.locator(f'[title="{other}"]')).get_by_role("button", name="Compare").click()
    page.locator(".comparison-table .comparison-call").nth(3).click()
    expect(page.locator(".topbar .operation")).to_have_attribute("title", other)
    expect(page.locator(".tree-row[aria-selected=true] .node-name")).to_have_text("Unload")


def test_the_whole_history_is_searched(page: Page, server: RunningServer) -> None:
    goal = "lab:Goal contain lab:crate-5"
    old = run_fast(server, goal=goal)
    for _ in range(55):
        run_fast(server, goal=goal)
    page.reload()
    page.locator(".workspace").wait_for()
    page.keyboard.press("h")
    expect(page.locator(".run-item").nth(49)).to_be_attached()
    assert page.locator(f'[title="{old}"]').count() == 0
    page.get_by_label("Search in the runs").fill(f"succeeded {old}")
    expect(page.locator(".run-item")).to_have_count(1)
    page.get_by_label("Search in the runs").fill("no_such_word")
    expect(page.get_by_text("No run of this cell has these words.")).to_be_visible()
    page.get_by_label("Search in the runs").fill("")
    before = page.locator(".run-item").count()
    page.get_by_role("button", name="Show older runs").click()
    expect(page.locator(".run-item").nth(before)).to_be_attached()


def test_a_recording_is_dropped_anywhere_on_the_page(page: Page, server: RunningServer) -> None:
    operation = carry(server, 2)
    recording = base64.b64encode(server.client.get(f"/operations/{operation}/recording").content).decode()
    page.evaluate(DROP, ["crate.mcap", recording, "dragover"])
    expect(page.get_by_text("Drop the recording (.mcap) to play it")).to_be_visible()
    page.evaluate(DROP, ["crate.mcap", recording, "drop"])
    expect(page.locator(".topbar .operation")).to_contain_text("crate.mcap")
    expect(page.locator(".tree-row[aria-level='1'].is-success")).to_have_count(2)
    page.evaluate(DROP, ["broken.mcap", base64.b64encode(b"nothing").decode(), "drop"])
    expect(page.get_by_role("alert")).to_contain_text("This recording cannot be read")


def test_runs_that_cannot_be_compared_are_refused_with_a_reason(page: Page, server: RunningServer) -> None:
    one, other = carry(server, 3), carry(server, 4)
    page.keyboard.press("h")
    page.locator(f'.run-show[title="{one}"]').click()
    page.route("**/diff?*", lambda route: route.abort("connectionrefused"))
    page.locator(".run-item", has=page.locator(f'[title="{other}"]')).get_by_role("button", name="Compare").click()
    expect(page.get_by_role("alert")).to_contain_text("the server cannot be reached")
    expect(page.locator(".tree")).to_be_visible()


def test_a_run_that_goes_on_is_compared_with_one_that_has_ended(page: Page, server: RunningServer) -> None:
    ended = carry(server, 1)
    server.client.put("/cells/yard/pace", json={"factor": 0.2})
    start(page, "carry_all")
    wait_for_state(page, "running")
    page.keyboard.press("h")
    page.locator(".run-item", has=page.locator(f'[title="{ended}"]')).get_by_role("button", name="Compare").click()
    expect(page.locator(".comparison-table thead .badge").first).to_contain_text("running")
    page.get_by_role("button", name="Close").click()
    server.client.put("/cells/yard/pace", json={"factor": None})
    wait_for_state(page, FINISHED)
