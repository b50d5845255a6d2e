"""Measures the page of the studio in Chromium: its size, how fast it shows what happens, and what watching pages cost.

`--operations N` sets over how many operations the memory of a page is watched. CPU times are those of the processes.
"""

from __future__ import annotations

import argparse
import gzip
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from statistics import median, quantiles

from _processes import cpu_s
from playwright.sync_api import Browser, CDPSession, Page, sync_playwright
from serving import find_cell

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))

from server.running import RunningServer
from server.running import serving as serving_yard
from skillc.server.studio_page import STUDIO_FILES
from studio.chromium import CHROMIUM, launch
from studio.opening import open_studio, origin_of, warm_up

NODES, UPDATES_HZ, ROW_PX = 1_000, 10, 24
OPENINGS, PAGES, OPERATIONS = 5, 8, 60
SECONDS = 10.0
SETTLE_MS = 1000
"""How long a page has after its 3-D view has been made, which is the last to come."""
READY_MS = 120_000
WATCH = """
window.delays = [];
const Socket = window.WebSocket;
window.WebSocket = class extends Socket {
    constructor(...given) {
        super(...given);
        this.addEventListener("message", ({data}) => {
            if (typeof data !== "string") return;
            const made = JSON.parse(data).map((each) => each.wall_time_ns / 1e6).filter((each) => each > 0);
            const shown = () => {
                const now = performance.timeOrigin + performance.now();
                window.delays.push(...made.map((each) => now - each));
            };
            requestAnimationFrame(() => requestAnimationFrame(shown));
        });
    }
};
"""
"""Notes how many ms after an event of the cell the frame that shows it is done."""
FIRST_ROW = """
window.firstRow = new Promise((resolve) => {
    new MutationObserver((_, observer) => {
        if (document.querySelector(".tree-row") === null) return;
        observer.disconnect();
        requestAnimationFrame(() => requestAnimationFrame(() => resolve(performance.now())));
    }).observe(document, {childList: true, subtree: true});
});
"""
COUNT_FRAMES = "() => { window.count = 0; const next = () => { count++; requestAnimationFrame(next); }; next(); }"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--operations", type=int, default=OPERATIONS, help="after how many operations memory is read")
    wanted = parser.parse_args()
    if CHROMIUM is None or not (STUDIO_FILES / "index.html").exists():
        print("nothing is measured: there is no Chromium, or the studio is not built")
        return
    measure_size()
    with sync_playwright() as playwright, tempfile.TemporaryDirectory() as folder:
        browser = launch(playwright)
        write_nodes(Path(folder))
        with serving_yard(Path(folder)) as server:
            warm_up(server)
            measure_first_paint(browser, server)
            measure_events(browser, server)
            measure_nodes(browser, server)
            measure_watchers(browser, server)
            measure_memory(browser, server, wanted.operations)
        browser.close()


def measure_size() -> None:
    """Print how large the page is, as it is sent."""
    files = [each for each in STUDIO_FILES.rglob("*") if each.is_file() and each.name != "stamp.txt"]
    total, sent = (sum(map(count, files)) for count in (lambda f: f.stat().st_size, lambda f: len(compress(f))))
    print(f"page: {sent / 1e6:.2f} MB compressed, {sent / total:.2f} x its files")


def compress(path: Path) -> bytes:
    return gzip.compress(path.read_bytes(), 9)


def write_nodes(folder: Path) -> None:
    """Write a task of NODES steps, of which UPDATES_HZ end in a second."""
    steps = "\n".join(f"        wait {1000 // UPDATES_HZ} ms" for _ in range(NODES))
    text = f'task nodes {{\n    scene "yard.ttl"\n    do seq {{\n{steps}\n    }}\n}}\n'
    (folder / "nodes.skill").write_text(text, encoding="utf-8")


@contextmanager
def shown(browser: Browser, server: RunningServer, height: int = 800, script: str = "") -> Iterator[Page]:
    """Open the page in a browser of its own; a script runs before it."""
    context = browser.new_context(viewport={"width": 1280, "height": height})
    context.set_default_timeout(READY_MS)
    page = context.new_page()
    page.add_init_script(script)
    open_studio(page, server)
    yield page
    context.close()


@contextmanager
def running(server: RunningServer, pace: float | None) -> Iterator[str]:
    """Let the task of many nodes run at a pace; stop it afterwards."""
    server.client.put("/cells/yard/pace", json={"factor": pace})
    operation = server.submit(task="nodes")["id"]
    server.wait_for(operation, "running")
    yield operation
    server.client.post(f"/operations/{operation}/stop", json={})
    server.wait_for(operation, "stopped")


def measure_first_paint(browser: Browser, server: RunningServer) -> None:
    """Print the time until a live tree is painted, relative to that of a page that is nothing but a number."""
    trees, least = list[float](), list[float]()
    with running(server, 1.0), shown(browser, server, script=FIRST_ROW) as page:
        for _ in range(OPENINGS):
            page.goto(f"{origin_of(server)}/api/v1/health")
            least.append(float(page.evaluate("performance.getEntriesByType('navigation')[0].duration")))
            page.goto(origin_of(server))
            trees.append(float(page.evaluate("window.firstRow")))
    print(f"first paint with a live tree of {NODES} nodes: {median(trees):.0f} ms, ", end="")
    print(f"{median(trees) / median(least):.1f} x a page with one value")


def measure_events(browser: Browser, server: RunningServer) -> None:
    """Print the time from an event in the cell to the end of the frame that shows it, at real pace."""
    with running(server, 1.0), shown(browser, server, script=WATCH) as page:
        page.locator(".scene-view").wait_for()
        page.wait_for_timeout(SETTLE_MS)
        page.evaluate("() => { window.delays = []; }")
        page.wait_for_timeout(SECONDS * 1e3)
        delays = sorted(page.evaluate("window.delays"))
    print(f"event to pixel: median {median(delays):.0f} ms, p95 {quantiles(delays, n=20)[18]:.0f} ms", end="")
    print(f", {len(delays)} events")


def measure_nodes(browser: Browser, server: RunningServer) -> None:
    """Print the script of a frame while NODES nodes are in sight and some of them change."""
    with running(server, 1.0), shown(browser, server, height=NODES * ROW_PX + 400) as page:
        page.locator(".tree-row").first.wait_for()
        page.get_by_role("button", name="Enlarge Tree").click()
        devtools = page.context.new_cdp_session(page)
        devtools.send("Performance.enable")
        rows = page.locator(".tree-row").count()
        page.evaluate(COUNT_FRAMES)
        before, frames = read_metric(devtools, "ScriptDuration"), page.evaluate("window.count")
        page.wait_for_timeout(SECONDS * 1e3)
        script = read_metric(devtools, "ScriptDuration") - before
        drawn = page.evaluate("window.count") - frames
    print(
        f"{rows} nodes in sight, {UPDATES_HZ} steps a second: {script / SECONDS / UPDATES_HZ * 1e3:.1f} ms of script ",
        end="",
    )
    print(f"an update, {drawn / SECONDS:.0f} frames/s, {script / SECONDS:.3f} of the time")


def read_metric(devtools: CDPSession, name: str) -> float:
    metrics = devtools.send("Performance.getMetrics")["metrics"]
    return next(float(each["value"]) for each in metrics if each["name"] == name)


def measure_watchers(browser: Browser, server: RunningServer) -> None:
    """Print the CPU time of the cell in a simulated second with pages that show it, relative to that without."""
    cell = find_cell(server.process.pid)
    spent = list[float]()
    for number in (0, PAGES):
        with running(server, 1.0):
            contexts = [browser.new_context() for _ in range(number)]
            for each in contexts:
                open_studio(each.new_page(), server)
            before, began = cpu_s(cell), time.monotonic()
            time.sleep(SECONDS)
            spent.append((cpu_s(cell) - before) / (time.monotonic() - began))
            for each in contexts:
                each.close()
    print(f"{PAGES} pages: {spent[1] - spent[0]:+.3f} s of CPU a simulated second of the cell, ", end="")
    print(f"{spent[1] / spent[0]:.2f} x without")


def measure_memory(browser: Browser, server: RunningServer, operations: int) -> None:
    """Print how the heap of a page grows over operations, after a sixth of them and after all."""
    server.client.put("/cells/yard/pace", json={"factor": None})
    heaps = list[float]()
    with shown(browser, server) as page:
        devtools = page.context.new_cdp_session(page)
        devtools.send("Performance.enable")
        for number in range(1, operations + 1):
            where = {"crate": "lab:crate-1", "to": ("lab:Goal", "lab:Start")[number % 2]}
            server.wait_for(server.submit(task="carry", arguments=where)["id"], "succeeded")
            if number in (operations // 6, operations):
                devtools.send("HeapProfiler.collectGarbage")
                heaps.append(read_metric(devtools, "JSHeapUsedSize"))
    print(f"heap of a page after {operations} operations: {heaps[1] / 1e6:.1f} MB, ", end="")
    print(f"{heaps[1] / heaps[0]:.3f} x that after {operations // 6}")


if __name__ == "__main__":
    main()
