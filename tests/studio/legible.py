"""Finds text on a page that cannot be read: cut off, outside of the window, or broken into single letters."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product
from typing import Literal

from playwright.sync_api import Page

from studio.conftest import OUT

SIZES = ((1280, 800), (1920, 1080))
SCHEMES: tuple[Literal["light"], Literal["dark"]] = ("light", "dark")

NEXT_FRAME = """() => new Promise((done) =>
    requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 100))))"""
FIND = """() => {
    const SLACK = 1.5, LEAST = 4;
    const name = (each) => `<${each.localName} class="${each.getAttribute("class") ?? ""}">`;
    const isShown = (each) => each.checkVisibility({ opacityProperty: true, visibilityProperty: true });
    // Editors, plots and the tree have their own ways to show more; names that end in dots say what they are.
    const OWN = ".cm-editor, .visually-hidden, option, script, style, [aria-hidden=true], .u-legend";
    const isWhole = (each) => getComputedStyle(each).textOverflow === "ellipsis" && each.closest("[title]") !== null;
    const clips = (style, way) => ["hidden", "clip"].includes(style[way]);
    const scrolls = (style, way) => ["auto", "scroll"].includes(style[way]);
    const found = new Set();
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    for (let node = walker.nextNode(); node !== null; node = walker.nextNode()) {
        const parent = node.parentElement;
        if (node.data.trim() === "" || parent === null || parent.closest(OWN) || !isShown(parent)) continue;
        const range = document.createRange();
        range.selectNodeContents(node);
        const box = range.getBoundingClientRect();
        if (box.width === 0) continue;
        const text = node.data.trim().slice(0, 60);
        let [left, right, top, bottom] = [box.left, box.right, box.top, box.bottom];
        let [freeX, freeY] = [false, false];
        for (let each = parent; each !== null && each !== document.body; each = each.parentElement) {
            const [style, around] = [getComputedStyle(each), each.getBoundingClientRect()];
            if (style.display === "inline") continue;
            freeX ||= scrolls(style, "overflowX");
            freeY ||= scrolls(style, "overflowY");
            if (isWhole(each)) { freeX = true; continue; }
            if (!freeX && clips(style, "overflowX") && (right > around.right + SLACK || left < around.left - SLACK))
                found.add(`cut off at the side: "${text}" in ${name(each)}`);
            if (!freeY && clips(style, "overflowY") && (bottom > around.bottom + SLACK || top < around.top - SLACK))
                found.add(`cut off at the end: "${text}" in ${name(each)}`);
        }
        if (!freeX && (right > innerWidth + SLACK || left < -SLACK)) found.add(`beyond the window: "${text}"`);
        if (!freeY && (bottom > innerHeight + SLACK || top < -SLACK)) found.add(`below the window: "${text}"`);
        for (const word of node.data.matchAll(/\\S+/g)) {
            if (word[0].length < 2) continue;
            range.setStart(node, word.index);
            range.setEnd(node, word.index + word[0].length);
            const lines = new Set([...range.getClientRects()].map((each) => Math.round(each.top))).size;
            if (lines > 1 && word[0].length / lines < LEAST)
                found.add(`broken into letters: "${word[0].slice(0, 60)}" in ${name(parent)}`);
        }
    }
    for (const each of document.querySelectorAll("body *")) {
        const style = getComputedStyle(each);
        if (!scrolls(style, "overflowX") || each.closest(".cm-editor") || !isShown(each)) continue;
        if (each.scrollWidth > each.clientWidth + SLACK && !each.matches("[data-wide]"))
            found.add(`has to be scrolled to the side: ${name(each)}`);
    }
    for (const each of document.querySelectorAll("button, select, label, .badge")) {
        if (!isShown(each) || each.closest(OWN) || isWhole(each)) continue;
        if (each.localName === "label" || getComputedStyle(each).display === "inline") continue;
        if (each.scrollWidth > each.clientWidth + SLACK)
            found.add(`too wide for its frame: "${each.textContent.trim().slice(0, 60)}" ${name(each)}`);
    }
    return [...found];
}"""


def find_illegible(page: Page) -> list[str]:
    """Return what cannot be read on a page as it is now."""
    return [str(each) for each in page.evaluate(FIND)]


def in_each_look(page: Page, state: str) -> Iterator[str]:
    """Show a state in each size, light and dark; keep a picture of each for people to look at, and yield its name."""
    OUT.mkdir(parents=True, exist_ok=True)
    for (width, height), scheme in product(SIZES, SCHEMES):
        page.set_viewport_size({"width": width, "height": height})
        page.emulate_media(color_scheme=scheme)
        page.evaluate(NEXT_FRAME)
        name = f"{state} {scheme} {width}"
        page.screenshot(path=OUT / f"legible-{name.replace(' ', '-')}.png")
        yield name
