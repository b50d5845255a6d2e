"""The strip above all views: what others do in the cell, what asks and waits; and a cell that is reset and saved."""

from __future__ import annotations

import re

from playwright.sync_api import Locator, Page, expect

from server.running import RunningServer
from server.test_leases import client_of
from studio.opening import FINISHED, press_start, start, wait_for_state


def strip(page: Page) -> Locator:
    return page.get_by_role("navigation", name="What goes on in the cell")


def open_menu(page: Page) -> Locator:
    page.get_by_role("button", name="Reset or save the cell").click()
    return page.get_by_role("region", name="Reset or save the cell")


def count_steps(server: RunningServer) -> int:
    """Return how many calls the last operation has made."""
    (last,) = server.client.get("/cells/yard/operations", params={"limit": 1}).json()
    events = server.client.get(f"/operations/{last['id']}/events").json()
    return sum(each["event"]["type"] == "implementation-chosen" for each in events)


def test_a_cell_is_reset_so_that_the_same_task_has_something_to_do_again(page: Page, server: RunningServer) -> None:
    start(page, "carry_all")
    wait_for_state(page, FINISHED)
    first = count_steps(server)
    page.get_by_role("button", name="Run something else").click()
    page.get_by_role("list", name="Tasks").get_by_role("button", name="carry_all").first.click()
    page.get_by_text("Nothing to do: the goal holds already.").wait_for()
    page.get_by_role("button", name="Reset yard to its scene").click()
    page.get_by_text("yard is again as its scene says.").wait_for()
    expect(page.locator(".preview-step")).to_have_count(first)
    press_start(page)
    wait_for_state(page, FINISHED)
    assert count_steps(server) == first > 0


def test_a_cell_is_saved_and_restored_and_that_is_refused_while_something_goes_on(
    page: Page, server: RunningServer
) -> None:
    menu = open_menu(page)
    menu.get_by_role("textbox", name="Name of the checkpoint").fill("..")
    expect(menu.get_by_role("button", name="Save", exact=True)).to_be_disabled()
    menu.get_by_role("textbox", name="Name of the checkpoint").fill("fresh")
    menu.get_by_role("button", name="Save", exact=True).click()
    checkpoint = menu.get_by_role("list", name="Checkpoints").get_by_role("listitem").filter(has_text="fresh")
    expect(checkpoint).to_contain_text("admin")
    with client_of(server, "ada", "operate") as ada:
        rest = ada.post("/cells/yard/operations", json={"task": "rest"}).json()["id"]
        expect(menu.get_by_text("rest goes on or waits; stop it, or wait until it has ended.")).to_be_visible()
        expect(checkpoint.get_by_role("button", name="Restore")).to_be_disabled()
        expect(menu.get_by_role("button", name="Reset to the scene")).to_be_disabled()
        ada.post(f"/operations/{rest}/stop")
    checkpoint.get_by_role("button", name="Restore").click()
    page.get_by_text("yard is again as it was saved as fresh.").wait_for()
    checkpoint = open_menu(page).get_by_role("list", name="Checkpoints").get_by_role("listitem")
    checkpoint.get_by_role("button", name="Remove").click()
    page.get_by_text("This cell was not saved yet.").wait_for()


def test_what_another_client_does_is_seen_and_its_question_is_one_click_away(page: Page, server: RunningServer) -> None:
    start(page, "carry_all")
    wait_for_state(page, FINISHED)
    expect(strip(page)).to_contain_text("Nothing goes on in yard.")
    page.get_by_role("tab", name="Jobs").click()
    with client_of(server, "ada", "operate") as ada:
        asks = ada.post("/cells/yard/operations", json={"task": "confirm"}).json()["id"]
        item = strip(page).get_by_role("button", name="confirm")
        expect(item).to_contain_text("asks")
        expect(item).to_contain_text("ada")
        expect(item).to_contain_text(re.compile(r"\d+ s left"))
        item.click()
        choices = page.locator(".run .choices")
        expect(choices.get_by_role("button").first).to_be_focused()
        expect(page.locator(".run").get_by_text(re.compile("left, then"))).to_be_visible()
        choices.get_by_role("button").first.click()
        server.wait_for(asks, "succeeded", "failed")
        expect(strip(page)).to_contain_text("Nothing goes on in yard.")


def test_what_waits_is_put_in_another_order(page: Page, server: RunningServer) -> None:
    with client_of(server, "ada", "operate") as ada:

        def submit(task: str, **settings: object) -> str:
            return str(ada.post("/cells/yard/operations", json={"task": task, **settings}).json()["id"])

        holder = submit("carry_all", step=True)
        server.wait_for(holder, "paused")
        first, second = submit("carry_two"), submit("carry_all")
        for each in (first, second):
            server.wait_for(each, "queued")
        expect(strip(page).get_by_role("button", name="paused")).to_contain_text("carry_all")
        page.get_by_role("button", name="Queue: 2 waiting").click()
        queue = page.get_by_role("region", name="Queue of the cell").get_by_role("listitem")
        expect(queue.nth(0)).to_contain_text("carry_two (ada)")
        queue.nth(1).get_by_role("button", name="Earlier").click()
        expect(queue.nth(1)).to_contain_text("carry_two (ada)")
        assert [each["id"] for each in server.client.get("/cells/yard/queue").json()] == [second, first]
        expect(queue.nth(0).get_by_role("button", name="Earlier")).to_be_disabled()
        page.keyboard.press("x")
        expect(strip(page)).to_contain_text("Nothing goes on in yard.")


def test_a_cell_that_has_stopped_says_why_and_what_has_to_be_done(page: Page, server: RunningServer) -> None:
    disturb = "/cells/yard/disturbances"
    assert server.client.post(disturb, json={"type": "emergency-stop"}).is_success
    expect(strip(page).get_by_role("alert")).to_contain_text("an emergency stop is pressed. Nothing runs until")
    assert server.client.post(disturb, json={"type": "emergency-stop", "pressed": False}).is_success
    page.get_by_role("button", name="Acknowledge").click()
    expect(strip(page)).to_contain_text("Nothing goes on in yard.")
