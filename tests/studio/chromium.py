"""The browser that shows the studio in tests and benchmarks: Chromium of the machine, which draws in software."""

from __future__ import annotations

import shutil

from playwright.sync_api import Browser, Playwright

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
FLAGS = (
    *("--no-sandbox", "--disable-background-networking", "--disable-component-update", "--disable-sync"),
    "--enable-unsafe-swiftshader",
    "--host-resolver-rules=MAP cells.example.org 127.0.0.1",
)


def launch(playwright: Playwright) -> Browser:
    """Start a browser without a window."""
    return playwright.chromium.launch(executable_path=CHROMIUM, args=list(FLAGS))
