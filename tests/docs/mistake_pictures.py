"""Makes the picture of docs/mistakes.md in which the editor of the studio shows mistakes of the page, in Chromium."""

from __future__ import annotations

import io
import tempfile
from collections.abc import Iterator
from pathlib import Path

from PIL import Image
from playwright.sync_api import FloatRect, Page, sync_playwright

from docs.mistakes_page import PAGE, Mistake, read_library, read_mistakes
from docs.pages import ROOT
from running_cells.yard import write_yard
from server.running import serving
from studio.chromium import launch
from studio.opening import open_studio

PICTURE = ROOT / "docs/pictures/mistakes-editor.webp"
SHOWN = (0, 1, 2, 3)
"""The numbers of the mistakes in the picture, two in a row."""
PIXELS, QUALITY = 2, 85
WINDOW = {"width": 618, "height": 1800}
"""The size of the page: all lines of a file are in sight, as marks of others are not drawn."""
WIDTH, HEIGHT, ABOVE = 600, 230, 100
"""The size of the picture of a mistake, and how much of it is above the mistake, in CSS pixels."""
GAP = 12
READY_MS = 60_000


def write_mistake_picture() -> Path:
    """Write the picture; return its file."""
    text = PAGE.read_text("utf-8")
    library, mistakes = read_library(text), list(read_mistakes(text))
    pictures = list(take_pictures(library, [mistakes[each] for each in SHOWN]))
    size = pictures[0].size
    rows, gap = -(-len(pictures) // 2), GAP * PIXELS
    sheet = Image.new("RGB", (2 * size[0] + gap, rows * (size[1] + gap) - gap), "white")
    for number, picture in enumerate(pictures):
        sheet.paste(picture, (number % 2 * (size[0] + gap), number // 2 * (size[1] + gap)))
    sheet.save(PICTURE, quality=QUALITY, method=6)
    return PICTURE


def take_pictures(library: dict[str, str], mistakes: list[Mistake]) -> Iterator[Image.Image]:
    """Yield the picture of each mistake, made in a library that is right before and after it."""

    def write(folder: Path, takes_ms: int) -> None:
        write_yard(folder, takes_ms)
        for name, text in library.items():
            (folder / name).write_text(text, "utf-8")

    with (
        tempfile.TemporaryDirectory() as folder,
        serving(Path(folder), write=write) as server,
        sync_playwright() as playwright,
    ):
        browser = launch(playwright)
        page = browser.new_page(viewport=WINDOW, device_scale_factor=PIXELS, color_scheme="light")
        page.set_default_timeout(READY_MS)
        open_studio(page, server)
        page.keyboard.press("s")
        page.get_by_role("button", name="Enlarge Details").click()
        for mistake in mistakes:
            text = library[mistake.file]
            (server.folder / mistake.file).write_text(text.replace(mistake.old, mistake.new), "utf-8")
            yield take_picture(page, mistake.file)
            (server.folder / mistake.file).write_text(text, "utf-8")
            page.locator(".cm-lint-marker-error").first.wait_for(state="detached")
        browser.close()


def take_picture(page: Page, file: str) -> Image.Image:
    """Return the picture of the first mistake in a file, with what the editor says of it."""
    page.get_by_role("combobox", name="File").select_option(file)
    found = page.locator(".cm-lintRange-error").first
    found.wait_for()
    page.locator(".cm-lint-marker-error").first.hover()
    page.locator(".cm-tooltip-lint .cm-diagnostic").first.wait_for()
    editor, place = page.locator(".source-editor").bounding_box(), found.bounding_box()
    assert editor is not None and place is not None
    top = min(max(editor["y"], place["y"] - ABOVE), WINDOW["height"] - HEIGHT)
    clip: FloatRect = {"x": editor["x"], "y": top, "width": WIDTH, "height": HEIGHT}
    return Image.open(io.BytesIO(page.screenshot(clip=clip)))


if __name__ == "__main__":
    print(write_mistake_picture().relative_to(ROOT))
