"""Measures the 3-D view of the demo cell in Chromium, which draws in software: frames a second, and what one costs.

Frames are counted while somebody turns the view, and while the task runs at real pace. CPU times of the browser say
what a frame costs also on a machine that has other work.
"""

from __future__ import annotations

import os
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path
from statistics import median

import httpx
from playwright.sync_api import Page, sync_playwright

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))

from serving import serving, submit

from skillc.server.studio_page import STUDIO_FILES
from studio.chromium import CHROMIUM, launch

WIDTH, HEIGHT = 1000, 700
"""The size of the picture in pixels."""
BESIDE = 18, 108
"""The size of what is around the picture in the page."""
CELL, TASK = "ur5e_whiteboard", "clean_whiteboard"
SECONDS = 8.0
READY_MS = 120_000
CANVAS = ".scene-view canvas"
OBSERVE = """() => {
    window.drawn = [];
    const take = (list) => drawn.push(...list.getEntriesByName("scene drawn").map((each) =>
        [each.duration, each.detail.calls, each.detail.triangles]));
    new PerformanceObserver(take).observe({type: "measure"});
}"""
TURN = f"""() => {{
    const canvas = document.querySelector("{CANVAS}");
    const turn = (step) => {{
        const box = canvas.getBoundingClientRect();
        const clientX = box.x + box.width / 2 + 100 * Math.sin(step / 10);
        const at = {{clientX, clientY: box.y + 600, pointerId: 1, isPrimary: true, buttons: 1, button: -1}};
        canvas.dispatchEvent(new PointerEvent("pointermove", {{...at, bubbles: true, pointerType: "mouse"}}));
        if (window.turning) requestAnimationFrame(() => turn(step + 1));
    }};
    window.turning = true;
    turn(0);
}}"""


def main() -> None:
    if CHROMIUM is None or not (STUDIO_FILES / "index.html").exists():
        print("nothing is measured: there is no Chromium, or the studio is not built")
        return
    with (
        tempfile.TemporaryDirectory() as folder,
        serving(Path(folder), CELL, "mujoco") as (client, _, _),
        sync_playwright() as playwright,
    ):
        browser = launch(playwright)
        page = browser.new_page(viewport={"width": WIDTH + BESIDE[0], "height": HEIGHT + BESIDE[1]})
        open_scene(page, client)
        box = page.locator(CANVAS).bounding_box()
        assert box is not None
        page.mouse.move(box["x"] + box["width"] / 2, box["y"] + 600)
        page.mouse.down()
        page.evaluate(TURN)
        measure(page, "the view turns")
        page.evaluate("() => { window.turning = false; }")
        page.mouse.up()
        client.put(f"/cells/{CELL}/pace", json={"factor": 1.0})
        operation = submit(client, CELL, TASK)
        page.locator(".topbar .badge", has_text="running").wait_for()
        measure(page, "the task runs")
        client.post(f"/operations/{operation}/stop", json={})
        browser.close()


def open_scene(page: Page, client: httpx.Client) -> None:
    """Show the 3-D view in the whole page, and wait until it stands still."""
    page.set_default_timeout(READY_MS)
    code = client.post("/login-codes").json()["code"]
    page.goto(f"{client.base_url.copy_with(path='/')}#code={code}")
    page.get_by_role("button", name="Enlarge 3-D").click()
    page.locator(".scene-label").first.wait_for()
    page.evaluate(OBSERVE)


def measure(page: Page, when: str) -> None:
    """Print frames a second, what is drawn, and CPU times of a frame: of the page, and of what draws it."""
    page.evaluate("() => { window.drawn = []; }")
    before, began = read_cpu_s(), time.monotonic()
    page.wait_for_timeout(SECONDS * 1e3)
    frames, seconds = page.evaluate("window.drawn"), time.monotonic() - began
    spent, count = read_cpu_s(), max(1, len(frames))
    spent.subtract(before)
    script = sorted(each[0] for each in frames)
    print(f"{when}: {count / seconds:.1f} frames/s, {max(each[1] for each in frames)} draw calls, ", end="")
    print(
        f"{max(each[2] for each in frames)} triangles, {median(script):.1f} ms of script; CPU time of a frame: ", end=""
    )
    print(", ".join(f"{name} {1e3 * spent[name] / count:.0f} ms" for name in ("gpu-process", "renderer")))


def read_cpu_s() -> Counter[str]:
    """Return the CPU time in s of the processes of the browser by kind; they are descendants of this one."""
    parents, found = dict[int, int](), dict[int, tuple[str, float]]()
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            fields = (entry / "stat").read_text().rsplit(")", 1)[1].split()
            command = (entry / "cmdline").read_bytes().decode(errors="replace").replace("\0", " ")
        except OSError:
            continue
        parents[int(entry.name)] = int(fields[1])
        kind = command.partition("--type=")[2].partition(" ")[0]
        found[int(entry.name)] = kind, (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
    total = Counter[str]()
    for pid, (kind, seconds) in found.items():
        total[kind] += seconds if is_below(pid, parents) else 0.0
    return total


def is_below(pid: int, parents: dict[int, int]) -> bool:
    """Whether a process was started by this one, or by one that was."""
    while pid > 1 and pid != os.getpid():
        pid = parents.get(pid, 0)
    return pid == os.getpid()


if __name__ == "__main__":
    main()
