"""Whoever types a start as it is printed somewhere is logged in, and sees the cell and the task that it names."""

from __future__ import annotations

import socket
from pathlib import Path

import pytest
from click.testing import CliRunner
from playwright.sync_api import Browser, BrowserContext, Page, expect

from server.running import RunningServer, wait_until
from skillc.cli.main import skillc
from studio.conftest import OUT, PATIENCE
from studio.opening import make_code, origin_of, put_back
from studio.starts import Followed, Start, collect_starts, followed, of_each_kind, write_stands

pytestmark = pytest.mark.early

FOLLOWED_ELSEWHERE = ("--behind-proxy", "--backend cart", "--ros2")
"""What other tests start: a server that its proxy alone asks, one with the robot of another package, one in ROS 2."""
NOT_VALID = "The code in the address is wrong, was used before, or is older than a minute."
CARRY, TASK = "carry_all", ".:carry_all"


@pytest.fixture(scope="module")
def stands(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """The folders in which readers stand."""
    return write_stands(tmp_path_factory.mktemp("starts"))


def open_page(page: Page, start: Start, stand: Path, found: Followed) -> None:
    """Open the page of a server: as the studio does, by `skillc studio` beside a server, or with its token."""
    if start.command.startswith("studio"):
        page.goto(wait_until(found.find_address, bool))
        return
    file = found.state / "address"
    origin = wait_until(lambda: file.read_text().strip() if file.exists() else "", bool)
    if origin.startswith("https:"):
        page.goto(f"https://cells.example.org:{origin.rpartition(':')[2]}/")
        page.get_by_label("Token").fill((found.state / "admin.token").read_text().strip())
        page.keyboard.press("Enter")
        return
    page.goto(run_studio(stand, "--state", str(found.state)))


def run_studio(folder: Path, *words: str) -> str:
    """Type `skillc studio` in a folder in which a server runs; return the address that it prints."""
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        printed = CliRunner().invoke(skillc, ["studio", *words, "--no-browser"])
    assert printed.exit_code == 0, printed.output
    return printed.stdout.strip()


def check_shown(page: Page, cell: str, task: str) -> None:
    """Check that somebody is logged in and sees a cell and a task, and that the address keeps nothing of it."""
    page.locator(".workspace").wait_for()
    shown = page.get_by_role("combobox", name="Cell", exact=True)
    expect(shown).not_to_have_value("") if cell == "" else expect(shown).to_have_value(cell)
    if task:
        expect(page.locator(".run h3").first).to_have_text(task)
        page.get_by_role("button", name="Start", exact=True).wait_for()
    expect(page).to_have_url(page.url.partition("#")[0])


@pytest.mark.parametrize(
    ("command", "known"), [("studio", "studio clean_whiteboard"), ("serve", "serve my_project --cell cell.ttl")]
)
def test_a_start_of_each_kind_that_is_printed_shows_what_it_asks_for(
    browser: Browser, stands: dict[str, Path], command: str, known: str
) -> None:
    """Starts of the studio take the port that is printed, so none of them may run beside another."""
    starts = [each for each in collect_starts() if not any(word in each.command for word in FOLLOWED_ELSEWHERE)]
    chosen = [each for each in of_each_kind(starts) if each.words[0] == command]
    assert known in {each.command for each in chosen}
    for start in chosen:
        with socket.create_server(("127.0.0.1", 0)) as free:
            port = free.getsockname()[1]
        context = browser.new_context(ignore_https_errors=True, viewport={"width": 1280, "height": 800})
        context.set_default_timeout(8_000 * PATIENCE)
        with followed(start, stands, port) as found:
            page = context.new_page()
            open_page(page, start, stands[start.stand], found)
            check_shown(page, *start.shown)
            page.screenshot(path=OUT / f"start-{start.stand}-{start.command.replace('/', '-')[:80]}.png")
        context.close()


def test_a_second_start_shows_its_task_also_to_who_is_logged_in(context: BrowserContext, server: RunningServer) -> None:
    put_back(server)
    server.client.post(f"/operations/{server.submit(task='rest')['id']}/stop")
    first, second = context.new_page(), context.new_page()
    first.goto(run_studio(server.folder, "--state", "served"))
    check_shown(first, "yard", "")
    second.goto(run_studio(server.folder, TASK, "--state", "served"))
    check_shown(second, "yard", CARRY)
    first.keyboard.press("h")
    first.locator(".run-item").first.get_by_role("button", name="Replay").click()
    first.get_by_role("toolbar", name="Replay").wait_for()
    first.goto(run_studio(server.folder, ".:confirm", "--state", "served"))
    check_shown(first, "yard", "confirm")
    expect(first.get_by_role("toolbar", name="Replay")).to_be_hidden()


@pytest.mark.parametrize("kind", ["wrong", "used"])
def test_a_code_that_does_not_log_in_says_so_and_what_was_asked_for_is_shown_later(
    context: BrowserContext, server: RunningServer, kind: str
) -> None:
    code = make_code(server) if kind == "used" else "wrong"
    if kind == "used":
        server.client_of(code).post("/session").raise_for_status()
    page = context.new_page()
    page.goto(f"{origin_of(server)}/#code={code}&cell=yard&task={CARRY}")
    expect(page.get_by_role("alert").first).to_have_text(NOT_VALID)
    expect(page.locator(".login")).to_contain_text("Run skillc studio again in the folder of the server")
    assert page.url == f"{origin_of(server)}/#cell=yard&task={CARRY}"
    page.screenshot(path=OUT / f"login-{kind}.png")
    page.get_by_label("Token").fill(server.token)
    page.keyboard.press("Enter")
    check_shown(page, "yard", CARRY)


def test_a_used_code_does_not_log_out_and_names_that_are_missing_are_said(
    context: BrowserContext, server: RunningServer
) -> None:
    page = context.new_page()
    address = run_studio(server.folder, TASK, "--state", "served")
    page.goto(address)
    check_shown(page, "yard", CARRY)
    page.goto(address)
    expect(page.get_by_role("alert")).to_have_text(f"{NOT_VALID} You are still logged in as admin.")
    check_shown(page, "yard", CARRY)
    for fragment, said in (
        ("cell=barn&task=carry", "There is no cell barn; the server has yard."),
        ("cell=yard&task=fly", "The skills of this cell have no task fly."),
    ):
        page.goto(f"{origin_of(server)}/#{fragment}")
        expect(page.get_by_role("alert")).to_have_text(said)
