"""Makes the pictures of the studio in the documentation: the page of a cell that wipes a whiteboard, in Chromium.

In the first run the eraser is not where it is believed to be; the second one is paused while it wipes.
"""

from __future__ import annotations

import io
import signal
import socket
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import msgspec
from PIL import Image
from playwright.sync_api import Browser, Page, WebSocketRoute, sync_playwright

from docs.pages import ROOT
from server.running import RunningServer, is_listening, start_server, wait_until
from studio.chromium import launch
from studio.opening import ENDS, make_code, origin_of, start, wait_for_state
from waiting import LONG_S

PICTURES = ROOT / "docs/pictures"
SIZE, QUALITY = {"width": 1440, "height": 900}, 85
CELL, TASK = "ur5e_whiteboard", "clean_whiteboard"
ERASER, ASIDE_M = "http://example.org/lab#Eraser-1", 0.3
DRIVE_HOME = "lab:Heron-1 skiros:at lab:Dock"
FAST, REAL = 4.0, 1.0
WIPES_S, PAUSED_S = 50.0, 57.0
"""When the arm has wiped for a while, and when the run is paused, in s after its start."""
PRESSES_MS, DRAWN_MS = 500, 1500
"""How long a tool that presses is looked at after a pause, and until the 3-D view is drawn with all pixels."""
TURNED = 75 / 360
"""How far the 3-D view is turned, so that the side of the board that is wiped is seen, in turns."""
READY_MS = 120_000


@dataclass
class Samples:
    """The samples that a page gets; while they are held it gets none, so that what is drawn comes to rest."""

    time_s: float = 0.0
    are_held: bool = False

    def pass_on(self, page: Page) -> None:
        """Pass the samples on to a page."""
        page.route_web_socket("**/samples", self._connect)

    def _connect(self, page_side: WebSocketRoute) -> None:
        def take(message: str | bytes) -> None:
            if not self.are_held:
                self.time_s = msgspec.msgpack.decode(bytes(message))["time_s"]
                page_side.send(message)

        page_side.connect_to_server().on_message(take)

    def wait_until(self, page: Page, time_s: float) -> None:
        """Wait until a time of the cell in s."""
        while self.time_s < time_s:
            page.wait_for_timeout(20)


def write_studio_pictures() -> Iterator[Path]:
    """Write all pictures of the studio; yield their files."""
    with (
        tempfile.TemporaryDirectory() as folder,
        serve_cell(Path(folder)) as server,
        sync_playwright() as playwright,
    ):
        browser, samples = launch(playwright), Samples()
        page = open_page(browser, server, samples)
        failed = fail_to_pick(page, server)
        yield save_panels(page, "why", "tree", "details")
        wipe_until_paused(page, server, samples)
        page.locator(".tree-row", has_text="FollowPath").first.click()
        yield save(shoot(page), "light")
        yield save_panels(page, "plan", "signals", key="g")
        page.emulate_media(color_scheme="dark")
        page.locator(".tree-row", has_text="Wipe").first.click()
        yield save(shoot(page), "dark")
        page.emulate_media(color_scheme="light")
        samples.are_held = False
        compare_with(page, server, failed)
        yield save(shoot(page), "comparison")
        page.keyboard.press("Escape")
        server.process.send_signal(signal.SIGTERM)
        page.get_by_text("no connection").wait_for()
        yield save(page.locator(".topbar").screenshot(), "disconnected")
        browser.close()


@contextmanager
def serve_cell(folder: Path) -> Iterator[RunningServer]:
    """Serve the cell of the task, simulated, until the end of a `with` statement."""
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    process = start_server(folder, port, ("--backend", "mujoco"), ("wiping",), ("--cell", f"{CELL}.ttl"))
    try:
        wait_until(lambda: is_listening(port), bool)
        server = RunningServer(folder, process, port, None)
        wait_until(lambda: server.client.get(f"/cells/{CELL}").json(), lambda it: it.get("state") == "operational")
        yield server
    finally:
        process.send_signal(signal.SIGTERM)
        process.wait(LONG_S)


def open_page(browser: Browser, server: RunningServer, samples: Samples) -> Page:
    """Open the page of the cell."""
    page = browser.new_page(viewport=SIZE, color_scheme="light")
    page.set_default_timeout(READY_MS)
    samples.pass_on(page)
    page.goto(f"{origin_of(server)}/#code={make_code(server)}")
    page.get_by_text("operational", exact=True).wait_for()
    return page


def fail_to_pick(page: Page, server: RunningServer) -> str:
    """Let the task fail, as the eraser lies elsewhere, and put it back; return the operation. The robot drives home."""
    move_eraser(server, ASIDE_M)
    set_pace(server, FAST)
    start(page, TASK)
    wait_for_state(page, "failed", TASK)
    page.locator(".tree-row", has_text="Pick").first.click()
    operation = str(server.client.get(f"/cells/{CELL}/operations").json()[0]["id"])
    set_pace(server, None)
    home = server.client.post(f"/cells/{CELL}/operations", json={"goal": DRIVE_HOME}).json()["id"]
    server.wait_for(home, *ENDS)
    move_eraser(server, -ASIDE_M)
    return operation


def wipe_until_paused(page: Page, server: RunningServer, samples: Samples) -> None:
    """Run the task until it is paused while it wipes, and look at the board; the samples are held then."""
    set_pace(server, FAST)
    start(page, TASK)
    wait_for_state(page, "running", TASK)
    begun_s = samples.time_s
    samples.wait_until(page, begun_s + WIPES_S)
    set_pace(server, REAL)
    samples.wait_until(page, begun_s + PAUSED_S)
    page.keyboard.press("p")
    wait_for_state(page, "paused", TASK)
    page.wait_for_timeout(PRESSES_MS)
    samples.are_held = True
    page.locator(".tree-row", has_text="Wipe").first.click()
    page.get_by_role("group", name="View").get_by_role("button", name="Fit").click()
    page.wait_for_timeout(DRAWN_MS)
    turn_scene(page)


def turn_scene(page: Page) -> None:
    """Turn the 3-D view with the mouse."""
    box = page.locator(".scene-view canvas").bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 4, box["y"] + 0.85 * box["height"]
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + TURNED * box["height"], y, steps=5)
    page.mouse.up()


def compare_with(page: Page, server: RunningServer, other: str) -> None:
    """Let the operation that is shown end, and compare it with another one."""
    set_pace(server, None)
    page.keyboard.press("p")
    wait_for_state(page, "succeeded", TASK)
    page.keyboard.press("h")
    run = page.locator(".run-item", has=page.locator(f'[title="{other}"]'))
    run.get_by_role("button", name="Compare").click()
    page.locator(".comparison-table").wait_for()


def move_eraser(server: RunningServer, by_m: float) -> None:
    """Move the eraser along x in the simulated reality, which the cell is not told."""
    body = {"type": "move", "thing": ERASER, "by_m": [by_m, 0.0, 0.0]}
    server.client.post(f"/cells/{CELL}/disturbances", json=body).raise_for_status()


def set_pace(server: RunningServer, factor: float | None) -> None:
    """Set the pace of the cell: real time times a factor, or as fast as it computes."""
    server.client.put(f"/cells/{CELL}/pace", json={"factor": factor}).raise_for_status()


def save_panels(page: Page, name: str, *panels: str, key: str = "") -> Path:
    """Save the picture of panels that form a rectangle; after a key is pressed, which is pressed again then."""
    if key:
        page.keyboard.press(key)
    boxes = [page.locator(f"[data-panel={each}]").bounding_box() for each in panels]
    found = [each for each in boxes if each is not None]
    left, top = min(each["x"] for each in found), min(each["y"] for each in found)
    right = max(each["x"] + each["width"] for each in found)
    bottom = max(each["y"] + each["height"] for each in found)
    picture = Image.open(io.BytesIO(shoot(page))).crop((int(left), int(top), int(right), int(bottom)))
    if key:
        page.keyboard.press(key)
    return _save(picture, name)


def shoot(page: Page) -> bytes:
    """Return a picture of the page once the pointer points at nothing, and all is drawn."""
    page.mouse.move(0, 0)
    page.wait_for_timeout(DRAWN_MS)
    return page.screenshot()


def save(picture: bytes, name: str) -> Path:
    """Save a picture of the page under a name; return its file."""
    return _save(Image.open(io.BytesIO(picture)), name)


def _save(picture: Image.Image, name: str) -> Path:
    file = PICTURES / f"studio-{name}.webp"
    picture.convert("RGB").save(file, quality=QUALITY, method=6)
    return file


if __name__ == "__main__":
    for made in write_studio_pictures():
        print(made.relative_to(ROOT))
