"""The source: rename in all files, format, quick fixes, and a file that somebody else has changed meanwhile."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, BrowserContext, Locator, Page, expect

from server.running import RunningServer, serving, wait_until
from studio.accessibility import check_axe
from studio.opening import open_studio

pytestmark = pytest.mark.early


@pytest.fixture(scope="module")
def own_server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningServer]:
    """A server whose library these tests change."""
    with serving(tmp_path_factory.mktemp("source")) as running:
        yield running


@pytest.fixture
def source(own_server: RunningServer, context: BrowserContext) -> Iterator[Page]:
    """A page that shows the source of the yard, as it was at first."""
    file = own_server.folder / "yard.skill"
    before = file.read_text("utf-8")
    page = context.new_page()
    open_studio(page, own_server)
    page.keyboard.press("s")
    page.get_by_label("Source of yard.skill").wait_for()
    yield page
    file.write_text(before, "utf-8")


def write(page: Page, text: str, after: str) -> Locator:
    """Write a text at the end of the first line with another text."""
    line = page.locator(".source-editor .cm-line", has_text=after).first
    line.click()
    page.keyboard.press("End")
    page.keyboard.insert_text(text)
    return line


def read(server: RunningServer) -> str:
    return (server.folder / "yard.skill").read_text("utf-8")


def test_a_skill_is_renamed_where_it_is_used(source: Page, own_server: RunningServer) -> None:
    declaration = source.locator(".source-editor .cm-line", has_text="skill Load {")
    declaration.click(position={"x": 50, "y": 8})
    source.keyboard.press("F2")
    field = source.get_by_label("New name")
    expect(field).to_have_value("Load")
    field.fill("Un load")
    source.get_by_role("button", name="Rename in all files").click()
    expect(source.locator(".edit-form [role=alert]")).to_be_visible()
    field.fill("PutOnCart")
    source.get_by_role("button", name="Rename in all files").click()
    expect(source.get_by_text("Load is PutOnCart now")).to_be_visible()
    expect(source.locator(".source-editor")).to_contain_text("skill PutOnCart {")
    text = read(own_server)
    assert "skill PutOnCart {" in text and "impl by_hand of PutOnCart" in text and "Load(" not in text
    assert text.count("PutOnCart(cart:") == 2


def test_a_text_is_formatted_and_saved(source: Page, own_server: RunningServer) -> None:
    write(source, "  # carries", "class lab:Cart")
    before = read(own_server)
    source.locator(".source-editor .cm-line", has_text="skill Load {").click()
    source.keyboard.press("Home")
    source.keyboard.insert_text("    ")
    source.get_by_role("button", name="Format").click()
    formatted = source.locator(".source-editor .cm-line", has_text="skill Load {")
    expect(formatted).to_have_js_property("textContent", "skill Load {")
    source.keyboard.press("Control+s")
    expect(source.get_by_role("button", name="Save", exact=True)).to_be_disabled()
    saved = wait_until(lambda: read(own_server), lambda text: text != before)
    assert "\nskill Load {" in saved and "# carries" in saved


def test_a_problem_has_a_fix(source: Page) -> None:
    line = source.locator(".source-editor .cm-line", has_text="pre   cart contain crate")
    line.click()
    source.keyboard.press("End")
    for _ in range(5):
        source.keyboard.press("Backspace")
    source.keyboard.insert_text("crte")
    expect(source.locator(".cm-lintRange-error").first).to_be_visible()
    source.keyboard.press("ArrowLeft")
    fixed = source.locator(".source-editor .cm-line", has_text="pre   cart contain crate")
    for _ in range(20):
        source.keyboard.press("Control+.")
        if fixed.count() == 1:
            break
        source.wait_for_timeout(250)
    expect(fixed).to_have_count(1)
    expect(source.get_by_role("button", name="Revert")).to_be_disabled()


def test_a_problem_is_shown_still_after_the_file_is_saved_and_another_view_was_shown(source: Page) -> None:
    write(source, "crte", "pre   cart contain crate")
    problem = source.locator(".cm-lintRange-error").first
    expect(problem).to_be_visible()
    source.keyboard.press("Control+s")
    expect(source.get_by_role("button", name="Save", exact=True)).to_be_disabled()
    expect(problem).to_be_visible()
    source.keyboard.insert_text("a")
    expect(source.locator(".cm-line", has_text="cratecrtea")).to_be_visible()
    source.get_by_role("button", name="Revert").click()
    expect(source.locator(".cm-line", has_text="cratecrtea")).to_be_hidden()
    expect(problem).to_be_visible()
    source.get_by_role("tab", name="Why").click()
    source.get_by_role("tab", name="Source").click()
    expect(problem).to_be_visible()


def test_a_problem_is_shown_however_fast_somebody_writes(source: Page) -> None:
    write(source, "crte", "pre   cart contain crate")
    write(source, "", "pre   cart != to")
    for each in "  # a comment that takes some time to write, with much to say":
        source.keyboard.type(each)
    expect(source.locator(".cm-lintRange-error").first).to_be_visible()


def test_a_file_that_others_change_is_read_again_with_its_problems(source: Page, own_server: RunningServer) -> None:
    changed = read(own_server).replace("pre   cart contain crate", "pre   cart contain crte")
    (own_server.folder / "yard.skill").write_text(changed, "utf-8")
    expect(source.locator(".source-editor")).to_contain_text("contain crte")
    expect(source.locator(".cm-lintRange-error").first).to_be_visible()


@pytest.mark.parametrize(
    "scheme", [pytest.param(each, marks=pytest.mark.looks(color_scheme=each)) for each in ("light", "dark")]
)
def test_a_file_that_was_changed_meanwhile_is_shown_side_by_side(
    source: Page, own_server: RunningServer, scheme: str
) -> None:
    write(source, "  # mine", "class lab:Cart")
    file = own_server.folder / "yard.skill"
    theirs = read(own_server).replace("# Crates are carried", "# All crates are carried")
    file.write_text(theirs, "utf-8")
    source.get_by_role("button", name="Save", exact=True).click()
    conflict = source.get_by_role("main", name="yard.skill has changed on disk")
    expect(conflict.get_by_label("yard.skill on disk")).to_contain_text("# All crates are carried")
    expect(conflict.get_by_label("Your yard.skill")).to_contain_text("# mine")
    check_axe(source, f"conflict-{scheme}")
    assert file.read_text("utf-8") == theirs
    source.get_by_role("button", name="Close").click()
    expect(source.locator(".source-editor")).to_contain_text("# mine")
    source.get_by_role("button", name="Compare", exact=True).click()
    conflict.get_by_role("button", name="Take this over").first.click()
    conflict.get_by_role("button", name="Save mine").click()
    expect(conflict).to_be_hidden()
    expect(source.locator(".source-editor")).to_contain_text("# All crates are carried")
    saved = wait_until(lambda: read(own_server), lambda text: "# mine" in text)
    assert "# All crates are carried" in saved


TALL = {"viewport": {"width": 1280, "height": 2400}}


@pytest.mark.parametrize(
    "scheme", [pytest.param(each, marks=pytest.mark.looks(color_scheme=each, **TALL)) for each in ("light", "dark")]
)
def test_hints_and_lenses_are_beside_the_text(source: Page, scheme: str) -> None:
    lenses, hints = source.locator(".cm-lens"), source.locator(".cm-hint")
    expect(lenses).to_have_text(["3 references"] * 3 + ["run", "plan", "run", "plan", "run"])
    expect(hints).to_have_text([", from: lab:Start"] * 2)
    check_axe(source, f"lenses-{scheme}")
    write(source, "\nclass Van < lab:Cart", "class lab:Cart")
    expect(lenses.first).to_have_text("4 references")
    expect(lenses.nth(1)).to_have_text("0 references")


@pytest.mark.looks(**TALL)
def test_a_lens_leads_to_references_and_plans_a_task(source: Page) -> None:
    source.locator(".cm-lens", has_text="reference").nth(1).click()
    places = source.get_by_role("region", name="3 references")
    expect(places.get_by_role("button", name="yard.skill:")).to_have_count(3)
    places.get_by_role("button", name="yard.skill:").last.click()
    chosen = source.locator(".cm-line.cm-chosen")
    expect(chosen).to_contain_text("Load(cart: lab:Cart-1, crate: lab:crate-0")
    chosen.click(position={"x": 80, "y": 8})
    source.keyboard.press("Shift+F12")
    around = source.get_by_role("region", name="4 places")
    expect(around).to_be_visible()
    source.keyboard.press("Escape")
    expect(around).to_have_count(0)
    source.locator(".cm-lens", has_text="plan").last.click()
    expect(source.get_by_role("heading", name="carry_all")).to_be_visible()
    expect(source.locator(".preview-step").first).to_be_visible()


CARRIED = """

test carried {
    scene  "yard.ttl"
    do     Load(cart: lab:Cart-1, crate: lab:crate-0)
    expect lab:Cart-1 contain lab:crate-0
}
"""


def test_a_lens_runs_a_test_as_it_is_written_now(source: Page) -> None:
    source.locator(".source-editor .cm-content").click()
    source.keyboard.press("Control+End")
    source.keyboard.insert_text(CARRIED)
    run, result = source.locator(".cm-lens", has_text="test"), source.locator(".cm-lens-result")
    run.click()
    expect(result).to_contain_text("passed: ")
    write(source, "", "expect lab:Cart-1 contain lab:crate-0")
    source.keyboard.press("Backspace")
    source.keyboard.insert_text("1")
    expect(result).to_have_count(0)
    run.click()
    expect(result).to_contain_text("failed: ")


def test_who_may_not_edit_reads(browser: Browser, own_server: RunningServer) -> None:
    made = own_server.client.post("/tokens", json={"name": "reader", "role": "operate"}).json()
    page = browser.new_context().new_page()
    page.goto(own_server.url.removesuffix("/api/v1"))
    page.get_by_label("Token").fill(made["token"])
    page.keyboard.press("Enter")
    page.locator(".workspace").wait_for()
    page.keyboard.press("s")
    page.get_by_label("Source of yard.skill").wait_for()
    for name in ("Format", "Rename", "Save"):
        expect(page.get_by_role("button", name=name, exact=True)).to_be_disabled()
    page.context.close()
