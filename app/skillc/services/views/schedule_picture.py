"""Draws a plan as a schedule: a bar for each step over time."""

from __future__ import annotations

from collections.abc import Sequence
from xml.sax.saxutils import escape

from skillc_compiler.emit.picture.svg import STYLE

ROW, BAR, HEAD, FOOT, MARGIN = 24, 16, 30, 28, 12
CHARACTER, CHART = 7.3, 420
MOST_CHARACTERS = 64
"""The most characters of a step's text that are shown."""
MAX_TICKS = 8


def draw_schedule(bars: Sequence[tuple[str, float, float]], title: str) -> str:
    """Return an SVG file. Each bar has a text, its start and its duration in s; the axis is in s from the start."""
    texts = [_shorten(text) for text, _, _ in bars]
    left = MARGIN + CHARACTER * max(map(len, texts), default=0) + MARGIN
    end_s = max((start + duration for _, start, duration in bars), default=0.0) or 1.0
    scale = CHART / end_s
    width = max(left + CHART + 4 * MARGIN, 2 * MARGIN + CHARACTER * len(title))
    height = HEAD + ROW * len(bars) + FOOT
    rows = [
        _row(HEAD + ROW * number, text, bar, left, scale)
        for number, (text, bar) in enumerate(zip(texts, bars, strict=True))
    ]
    ticks = [_tick(each, left + each * scale, height) for each in _choose_ticks(end_s)]
    parts = [f'<text class="title" x="{MARGIN}" y="18">{escape(title)}</text>', *ticks, *rows]
    size = f'width="{width:.0f}" height="{height}" viewBox="0 0 {width:.0f} {height}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" class="picture" role="img" {size}>'
    return f"{head}<title>{escape(title)}</title><style>{escape(STYLE)}</style>{''.join(parts)}</svg>\n"


def _row(top: int, text: str, bar: tuple[str, float, float], left: float, scale: float) -> str:
    whole, start, duration = bar
    place = f'x="{left + start * scale:.1f}" y="{top + (ROW - BAR) // 2}"'
    shape = f'<rect class="box call" {place} width="{max(2.0, duration * scale):.1f}" height="{BAR}" rx="2">'
    told = f"<title>{escape(whole)}: {duration:.1f} s from {start:.1f} s</title></rect>"
    return f'<text x="{MARGIN}" y="{top + ROW // 2 + 4}">{escape(text)}</text>{shape}{told}'


def _tick(at_s: float, x: float, height: int) -> str:
    line = f'<path d="M{x:.1f} {HEAD - 4}V{height - FOOT + 4}"/>'
    return f'{line}<text x="{x:.1f}" y="{height - 8}" text-anchor="middle">{at_s:g} s</text>'


def _choose_ticks(end_s: float) -> list[float]:
    """Return round times from 0 to the end, in s."""
    step = 0.1
    for factor in (2.0, 2.5, 2.0) * 6:
        if end_s / step <= MAX_TICKS:
            break
        step *= factor
    return [number * step for number in range(int(end_s / step) + 1)]


def _shorten(text: str) -> str:
    return text if len(text) <= MOST_CHARACTERS else f"{text[: MOST_CHARACTERS - 1]}…"
