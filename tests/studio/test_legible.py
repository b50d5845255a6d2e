"""Every view in every state can be read: no text is cut off, outside of the window, or broken into single letters."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest
from playwright.sync_api import Browser, Page

from running_cells.asking import write_question
from server.running import RunningServer, serving_bench
from studio.conftest import PATIENCE
from studio.legible import find_illegible, in_each_look
from studio.opening import choose, choose_planned, open_studio, origin_of

pytestmark = pytest.mark.early

Look = Callable[[str], None]
REST = 'task rest {\n    scene "yard.ttl"\n    do seq { wait 600 s }\n}\n'
MISTAKE = "lab:crate-1.Wieght == 2 kg"


@pytest.fixture(scope="module")
def cells(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningServer]:
    """A server of a yard in which somebody is asked, and of a bench with an arm."""
    folder = tmp_path_factory.mktemp("legible")
    write_question(folder)
    (folder / "rest.skill").write_text(REST, encoding="utf-8")
    with serving_bench(folder) as running:
        yield running


def test_all_text_can_be_read_in_every_view_and_state(browser: Browser, cells: RunningServer) -> None:
    context = browser.new_context(viewport={"width": 1280, "height": 800})
    context.set_default_timeout(8_000 * PATIENCE)
    page = context.new_page()
    problems: list[str] = []
    states: list[str] = []

    def look(state: str) -> None:
        states.append(state)
        for shown in in_each_look(page, state):
            problems.extend(f"{shown}: {each}" for each in find_illegible(page))

    page.goto(origin_of(cells))
    page.get_by_label("Token").wait_for()
    look("login")
    open_studio(page, cells)
    for walk in (walk_arm, walk_choice, walk_running, walk_question, walk_world, walk_past, walk_viewer):
        walk(page, cells, look)
    context.close()
    assert len(states) > 25
    assert problems == []


def walk_arm(page: Page, cells: RunningServer, look: Look) -> None:
    page.get_by_role("combobox", name="Cell", exact=True).select_option("bench")
    page.locator(".scene-label", has_text="Part-A").wait_for()
    look("nothing has run")
    page.locator(".scene-menu summary, summary", has_text="Show").first.click()
    look("what the 3-D view shows")
    page.locator(".scene-menu summary, summary", has_text="Show").first.click()
    for tool in ("Measure", "Move in reality", "Correct belief"):
        page.get_by_role("button", name=tool).click()
        look(tool)
    page.get_by_role("button", name="Select", exact=True).click()
    page.get_by_role("combobox", name="Cell", exact=True).select_option("yard")


def walk_choice(page: Page, cells: RunningServer, look: Look) -> None:
    page.keyboard.press("r")
    page.get_by_role("list", name="Tasks").wait_for()
    look("tasks")
    page.get_by_role("combobox", name="Goal").fill(MISTAKE)
    page.keyboard.press("Escape")
    page.get_by_role("button", name="Plan for this goal").click()
    page.locator(".notice.bad").wait_for()
    look("goal with a mistake")
    page.keyboard.press("r")
    page.get_by_role("button", name="‹ all tasks").click()
    choose(page, "carry")
    look("parameters of a task")
    page.get_by_role("button", name="‹ all tasks").click()
    choose_planned(page, "carry_all")
    page.locator(".run details summary").first.click()
    look("plan")
    page.keyboard.press("g")
    page.locator(".gantt").wait_for()
    look("plan over time")
    page.keyboard.press("g")


def walk_running(page: Page, cells: RunningServer, look: Look) -> None:
    cells.client.put("/cells/yard/pace", json={"factor": 1.0})
    page.get_by_role("button", name="Start", exact=True).click()
    page.locator(".topbar .badge", has_text="running").wait_for()
    page.get_by_role("button", name="Pause").click()
    page.locator(".topbar .badge", has_text="paused").wait_for()
    look("paused")
    page.get_by_label("all nodes").check()
    look("all nodes")
    page.get_by_label("all nodes").uncheck()
    page.get_by_role("button", name="Resume").click()
    cells.client.put("/cells/yard/pace", json={"factor": None})
    page.locator(".topbar .badge", has_text="finished, not verified").wait_for()
    look("ended")
    for key, name in {"w": "why", "s": "source", "e": "events", "h": "runs"}.items():
        page.keyboard.press("Escape")
        page.keyboard.press("2")
        page.keyboard.press(key)
        page.wait_for_timeout(500)
        look(name)
    page.locator(".plan-step, .tree-row").first.click()
    page.keyboard.press("w")
    look("why of a step")
    for key in "12345":
        page.keyboard.press(key)
        page.keyboard.press("m")
        look(f"panel {key} enlarged")
        page.keyboard.press("m")
    page.keyboard.press("?")
    look("help")
    page.keyboard.press("Escape")


def walk_question(page: Page, cells: RunningServer, look: Look) -> None:
    choose(page, "confirm")
    page.get_by_role("button", name="Start", exact=True).click()
    page.get_by_role("button", name="no", exact=True).or_(page.get_by_label("Answer")).first.wait_for()
    look("question")
    page.get_by_role("button", name="free", exact=True).or_(page.get_by_role("button", name="no", exact=True)).click()
    page.locator(".topbar .badge", has_text="failed").wait_for()
    look("failed")
    page.locator(".tree-row", has_text="Confirm").first.click()
    page.keyboard.press("w")
    look("why of a failure")
    page.get_by_role("button", name="Explain in sentences").click()
    page.locator(".explained").wait_for()
    look("explained")


def walk_world(page: Page, cells: RunningServer, look: Look) -> None:
    edit = {"edits": ['lab:crate-2.FrameId == "a name"'], "why": "it has a long reason, which nobody could guess"}
    assert cells.client.post("/cells/yard/world/edits", json=edit).status_code == 204
    page.keyboard.press("f")
    page.locator(".world tbody tr").first.wait_for()
    look("facts")
    page.locator(".world .fact-edit", has_text="contain").first.click()
    page.get_by_label("Value", exact=True).wait_for()
    look("fact that is edited")
    page.keyboard.press("Escape")
    page.get_by_role("button", name="Add", exact=True).click()
    page.get_by_label("Thing", exact=True).fill("lab:crate-2")
    page.get_by_label("What is stated").select_option(label="Weight: Mass")
    look("fact that is added")
    page.get_by_role("button", name="Several facts").click()
    look("several facts")
    page.get_by_role("button", name="Cancel").click()
    for view in ("graph", "who changed what", "between two times", "what robots can do"):
        page.get_by_label("What to show").select_option(label=view)
        page.wait_for_timeout(500)
        look(view)
    page.get_by_label("What to show").select_option(label="facts")


def walk_past(page: Page, cells: RunningServer, look: Look) -> None:
    page.keyboard.press("Escape")
    page.keyboard.press("h")
    page.locator(".run-item", has_text="carry_all").get_by_role("button", name="Compare").first.click()
    page.locator(".comparison-table").wait_for()
    look("two runs side by side")
    page.keyboard.press("Escape")
    page.locator(".run-item", has_text="carry_all").get_by_role("button", name="Replay").first.click()
    page.get_by_role("button", name="Back to the cell").wait_for()
    look("replay")
    page.get_by_role("button", name="Back to the cell").click()
    page.get_by_role("tab", name="Jobs").click()
    page.get_by_role("button", name="New trials").click()
    page.get_by_label("Task", exact=True).select_option("carry")
    look("new trials")


def walk_viewer(page: Page, cells: RunningServer, look: Look) -> None:
    """The page of somebody who may only see, while another client has the lease and rests."""
    made = cells.client.post("/tokens", json={"name": "visitor-with-a-long-name", "role": "view"}).json()
    cells.client.put("/cells/yard/pace", json={"factor": 1.0})
    cells.client.put("/cells/yard/lease", json={})
    cells.submit(task="rest")
    page.get_by_role("button", name="admin", exact=True).click()
    page.get_by_label("Token").fill(made["token"])
    page.keyboard.press("Enter")
    page.locator(".workspace").wait_for()
    page.keyboard.press("h")
    page.locator(".run-show", has_text="rest").first.click()
    page.locator(".topbar .badge", has_text="running").wait_for()
    look("viewer")
    page.keyboard.press("r")
    page.get_by_role("button", name="carry_all").click()
    page.locator(".run .plan").wait_for()
    look("plan of a viewer")
    cells.client.post("/cells/yard/stop")
