"""Texts and names that try to be more than text are text in every view: they open, load, turn and widen nothing."""

from __future__ import annotations

from collections.abc import Iterator
from urllib.parse import urlsplit

import pytest
from playwright.sync_api import BrowserContext, Page, expect

from running_cells.hostile import LINK, LONG, MARKUP, TEXT, THING, write_hostile_yard
from server.running import RunningServer, serving
from studio.conftest import OUT
from studio.opening import EXPECTED_ERRORS, open_studio, origin_of, wait_for_state

WHY = f"because of {TEXT}"[:480]
FOUND = """() => {
    const isTurned = (text) => /[\\u202a-\\u202e\\u2066-\\u2069]/.test(text);
    const texts = (element) => [...element.childNodes].filter((each) => each.nodeType === 3);
    const own = (element) => texts(element).map((each) => each.data).join("");
    const isWide = (each) =>
        each.scrollWidth > each.clientWidth + 1 || each.getBoundingClientRect().right > innerWidth;
    const boxes = ".topbar > *, .panel, .panel-head, .full-page, dialog, .messages, .run, .details, .scroll, "
        + ".view-tools > *, .tree-row, .comparison > *, .trials > *";
    const made = ".hostile, img:not(.cm-widgetBuffer), iframe, object, embed, a[href^='javascript']";
    const all = [...document.querySelectorAll("body *")];
    const turned = all.filter((each) => isTurned(own(each)) && !each.closest(".cm-editor, svg, option, textarea"));
    return {
        elements: document.querySelectorAll(made).length,
        turning: turned.filter((each) => getComputedStyle(each).unicodeBidi === "normal").map((each) => each.outerHTML),
        wide: [...document.querySelectorAll(boxes)].filter(isWide).map((each) => each.className),
        title: document.title,
    };
}"""
"""What hostile texts have made of the page: elements, lines that they turn round, and what they have made too wide."""


@pytest.fixture(scope="module")
def hostile(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningServer]:
    with serving(tmp_path_factory.mktemp("hostile"), takes_ms=10, write=write_hostile_yard) as running:
        running.client.put("/cells/yard/pace", json={"factor": None})
        edits = [f'<{THING}> skiros:FrameId "{TEXT}"']
        assert running.client.post("/cells/yard/world/edits", json={"edits": edits, "why": WHY}).status_code == 204
        yield running


@pytest.fixture
def page(context: BrowserContext, hostile: RunningServer) -> Iterator[Page]:
    """A page of the server; nothing that it has shown may have had an effect."""
    page = context.new_page()
    effects: list[str] = []
    page.on("pageerror", lambda error: effects.append(str(error)))
    page.on("dialog", lambda dialog: (effects.append(dialog.message), dialog.dismiss()))
    page.on("console", lambda message: effects.append(message.text) if message.type == "error" else None)
    page.on("request", lambda request: effects.append(request.url) if not _is_own(request.url, hostile) else None)
    open_studio(page, hostile)
    yield page
    assert [each for each in effects if not any(known in each for known in EXPECTED_ERRORS)] == []


def _is_own(url: str, server: RunningServer) -> bool:
    return urlsplit(url).netloc == urlsplit(origin_of(server)).netloc or url.startswith(("data:", "blob:"))


def _check(page: Page, view: str, *texts: str) -> None:
    """Check that texts are in the page as they are, and that no text has become anything else."""
    for each in texts:
        expect(page.locator("body")).to_contain_text(each)
    page.screenshot(path=OUT / f"hostile-{view}.png")
    found = page.evaluate(FOUND)
    assert found == {"elements": 0, "turning": [], "wide": [], "title": "skillc studio"}, (view, found)


def _doubt(page: Page, answer: str | None) -> None:
    """Start the task that asks; answer it."""
    page.keyboard.press("r")
    page.get_by_role("list", name="Tasks").get_by_role("button", name="doubt").click()
    page.get_by_role("combobox", name="about").fill("lab:crate-1")
    page.keyboard.press("Escape")
    _check(page, "parameters", MARKUP)
    page.get_by_role("button", name="Start", exact=True).click()
    page.get_by_role("alert").filter(has_text="hostile").wait_for()
    _check(page, "question", TEXT)
    if answer is not None:
        page.get_by_role("button", name=answer, exact=True).click()


def test_hostile_texts_are_text_while_a_task_is_chosen_and_run(page: Page) -> None:
    page.keyboard.press("r")
    page.get_by_role("list", name="Tasks").wait_for()
    _check(page, "tasks", TEXT, LONG)
    _doubt(page, MARKUP)
    wait_for_state(page, "failed", "doubt")
    _check(page, "failed", TEXT)
    page.locator(".tree-row", has_text="Doubt").first.click()
    page.get_by_label("all nodes").check()
    _check(page, "why", LONG)
    page.get_by_role("button", name="Explain in sentences").click()
    page.locator(".explained").wait_for()
    _check(page, "explained", MARKUP)
    page.keyboard.press("e")
    _check(page, "events", MARKUP)
    page.keyboard.press("s")
    page.get_by_label("Source of <img").wait_for()
    expect(page.locator(".cm-specialChar").first).to_be_visible()
    _check(page, "source", MARKUP)
    page.keyboard.press("Escape")
    page.keyboard.press("r")
    page.locator(".offer", has=page.get_by_text(LONG, exact=True)).click()
    page.locator(".preview-step").first.wait_for()
    page.keyboard.press("g")
    page.locator(".gantt").wait_for()
    _check(page, "plan", LONG)


def test_hostile_texts_are_text_in_the_world(page: Page) -> None:
    page.keyboard.press("f")
    _check(page, "facts", TEXT, LINK)
    for view in ("graph", "history", "differences"):
        page.get_by_label("What to show").select_option(view)
        page.locator(".world-graph, .world tbody tr").first.wait_for()
        _check(page, view)
    page.get_by_label("What to show").select_option("facts")
    page.locator(".world tbody button.link", has_text=LINK).first.click()
    page.keyboard.press("m")
    _check(page, "thing", LINK)
    page.keyboard.press("m")
    page.keyboard.press("w")
    _check(page, "thing-details", TEXT)
    page.keyboard.press("f")
    page.get_by_role("button", name="Add", exact=True).click()
    page.get_by_role("button", name="Several facts").click()
    page.get_by_label("Fact 1").fill(f"lab:crate-1 nonsense {TEXT}")
    page.get_by_label("Why", exact=True).fill(WHY)
    page.get_by_role("button", name="Change", exact=True).click()
    page.get_by_role("alert").wait_for()
    _check(page, "message")


def test_hostile_texts_are_text_in_runs_comparisons_and_trials(page: Page, hostile: RunningServer) -> None:
    for reason in (WHY, "no reason"):
        operation = hostile.submit(task="doubt", arguments={"about": "lab:crate-1"})["id"]
        hostile.client.post(f"/operations/{operation}/stop", json={"reason": reason})
        hostile.wait_for(operation, "stopped")
    begun = hostile.begin("trials", task=LONG, number=2)["id"]
    page.keyboard.press("h")
    page.locator(".run-item", has_text="doubt").nth(1).locator(".run-show").click()
    page.get_by_role("tab", name="Why").click()
    _check(page, "runs", MARKUP)
    page.locator(".run-item").first.get_by_role("button", name="Compare").click()
    page.locator(".comparison-table").wait_for()
    _check(page, "comparison")
    page.keyboard.press("Escape")
    page.get_by_role("tab", name="Jobs").click()
    hostile.wait_for_job(begun)
    expect(page.locator(".series", has_text="Trials").first).to_contain_text("passed")
    _check(page, "series", LONG)
    page.locator(".series", has_text="Trials").first.click()
    page.locator(".distribution").first.wait_for()
    _check(page, "trials", LONG)
