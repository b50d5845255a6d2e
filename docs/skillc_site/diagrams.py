"""Draws the flow charts of the pages as SVG in the colours of the site; forges draw the same text with Mermaid."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from html import escape

EDGE = re.compile(r'(\w+)(?:\["([^"]+)"\])? -->(?:\|([^|]+)\|)? (\w+)(?:\["([^"]+)"\])?')
CHARACTER, HEIGHT, GAP, ROW, MARGIN, LONGEST = 6.6, 44, 26, 90, 8, 30
"""Sizes in pixels, and the number of characters after which a label is broken."""


@dataclass(slots=True)
class Chart:
    """A flow chart: labels of nodes, edges with their labels, and the row of each node."""

    labels: dict[str, str] = field(default_factory=dict)
    edges: list[tuple[str, str, str]] = field(default_factory=list)
    rows: dict[str, int] = field(default_factory=dict)


def draw_flowchart(text: str) -> str:
    """Return the flow chart as an SVG element; ValueError for a line that is not `a["label"] -->|label| b["label"]`."""
    chart = _read(text)
    centres = _place(chart)
    width = max(x + _width(chart.labels[node]) / 2 for node, (x, _) in centres.items()) + MARGIN
    height = max(y for _, y in centres.values()) + HEIGHT / 2 + MARGIN
    parts = [*(_edge(edge, centres) for edge in chart.edges), *(_box(chart.labels[n], centres[n]) for n in centres)]
    size = f'viewBox="0 0 {width:.0f} {height:.0f}" width="{width:.0f}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" role="img" {size}>'
    return f'<div class="chart">{head}{"".join(parts)}</svg></div>'


def _read(text: str) -> Chart:
    chart = Chart()
    for line in text.strip().splitlines()[1:]:
        found = EDGE.fullmatch(line.strip())
        if found is None:
            raise ValueError(f"not an edge of a flow chart: {line}")
        for name, label in ((found[1], found[2]), (found[4], found[5])):
            chart.labels.setdefault(name, label or name)
            if label:
                chart.labels[name] = label
        chart.edges.append((found[1], found[4], found[3] or ""))
    for _ in chart.labels:  # the longest path has at most as many edges as there are nodes
        for start, end, _ in chart.edges:
            chart.rows[end] = max(chart.rows.get(end, 0), chart.rows.setdefault(start, 0) + 1)
    return chart


def _place(chart: Chart) -> dict[str, tuple[float, float]]:
    """Return the centres of the nodes: in each row those with predecessors further left stand further left."""
    centres: dict[str, tuple[float, float]] = {}
    for row in range(max(chart.rows.values()) + 1):
        members = [node for node in chart.labels if chart.rows[node] == row]
        members.sort(key=lambda node: _mean([centres[a][0] for a, b, _ in chart.edges if b == node and a in centres]))
        left = float(MARGIN)
        for node in members:
            above = _mean([centres[a][0] for a, b, _ in chart.edges if b == node and a in centres])
            half = _width(chart.labels[node]) / 2
            x = max(left + half, above)
            centres[node] = (x, MARGIN + HEIGHT / 2 + row * ROW)
            left = x + half + GAP
    return centres


def _mean(numbers: list[float]) -> float:
    return sum(numbers) / len(numbers) if numbers else 0.0


def _lines(label: str) -> list[str]:
    lines = [""]
    for word in label.split():
        if lines[-1] and len(lines[-1]) + len(word) >= LONGEST:
            lines.append("")
        lines[-1] = f"{lines[-1]} {word}".strip()
    return lines


def _width(label: str) -> float:
    return max(len(line) for line in _lines(label)) * CHARACTER + 20


def _box(label: str, centre: tuple[float, float]) -> str:
    x, y, width = *centre, _width(label)
    lines = _lines(label)
    first = y + 4 - (len(lines) - 1) * 8
    rows = "".join(
        f'<tspan x="{x:.1f}" y="{first + 16 * n:.1f}">{escape(line)}</tspan>' for n, line in enumerate(lines)
    )
    frame = f'x="{x - width / 2:.1f}" y="{y - HEIGHT / 2:.1f}" width="{width:.1f}" height="{HEIGHT}" rx="5"'
    return f"<rect {frame}/><text>{rows}</text>"


def _edge(edge: tuple[str, str, str], centres: dict[str, tuple[float, float]]) -> str:
    (x, y), (to_x, to_y), label = centres[edge[0]], centres[edge[1]], edge[2]
    start, end = y + HEIGHT / 2, to_y - HEIGHT / 2
    middle = (start + end) / 2
    line = f'<path d="M{x:.1f} {start:.1f} C{x:.1f} {middle:.1f} {to_x:.1f} {middle:.1f} {to_x:.1f} {end - 5:.1f}"/>'
    tip = f'<path class="tip" d="M{to_x - 4:.1f} {end - 7:.1f} L{to_x:.1f} {end:.1f} L{to_x + 4:.1f} {end - 7:.1f} Z"/>'
    return f'{line}{tip}<text class="label" x="{(x + to_x) / 2 + 5:.1f}" y="{middle + 4:.1f}">{escape(label)}</text>'
