"""What was learned as one self-contained HTML page: front, importances, fresh trials, the change, the runs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations
from os.path import relpath
from pathlib import Path

from jinja2 import Environment, PackageLoader, StrictUndefined

from skillc.services.learning.evidence import format_seeds
from skillc.services.learning.racing import Verdict
from skillc.services.learning.result import DEFAULTS, Learned, Tried
from skillc.services.reporting.files import write_file

PAGE = "learned.html"
WIDTH, HEIGHT, MARGIN = 420, 260, 12
"""The size of a drawing in px."""


@dataclass(frozen=True, slots=True)
class Dot:
    """A candidate in a drawing: its place in px, why it is tried no more, and what is said of it."""

    x: float
    y: float
    verdict: Verdict
    title: str
    is_default: bool
    is_chosen: bool


@dataclass(frozen=True, slots=True)
class CandidatePlot:
    """Candidates by two objectives, with their ranges, and the corners of the front's line in px."""

    across: str
    up: str
    low: tuple[float, float]
    high: tuple[float, float]
    dots: tuple[Dot, ...]
    front: tuple[tuple[float, float], ...]


def write_page(learned: Learned, out: Path) -> None:
    """Write the page of what was learned into its folder. ServiceError if it cannot be written."""
    write_file(out / PAGE, render_page(learned, out))


def render_page(learned: Learned, out: Path) -> str:
    """Return the page, with the runs as links from the folder `out`."""
    environment = Environment(
        loader=PackageLoader("skillc.services.learning", "."),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    known = {each.number: each for each in learned.candidates}
    shown = dict.fromkeys((DEFAULTS, *learned.front, *(() if learned.chosen is None else (learned.chosen,))))
    return environment.get_template("page.html.j2").render(
        learned=learned,
        rows=[known[number] for number in shown if number in known],
        drawings=list(draw_candidates(learned)),
        seeds=format_seeds(learned.seeds),
        fresh_seeds=format_seeds(learned.fresh.seeds) if learned.fresh else "",
        links={what: Path(relpath(folder, out)).as_posix() for what, folder in learned.recordings.items()},
        trials=sum(each.trials for each in learned.candidates),
        default=DEFAULTS,
        width=WIDTH,
        height=HEIGHT,
    )


def draw_candidates(learned: Learned) -> Iterator[CandidatePlot]:
    """Yield a drawing of each pair of objectives; of a single one, over the numbers of the candidates."""
    if len(learned.minimise) == 1:
        yield _draw(learned, -1, 0)
    for across, up in combinations(range(len(learned.minimise)), 2):
        yield _draw(learned, across, up)


def _draw(learned: Learned, across: int, up: int) -> CandidatePlot:
    """Return the candidates by two objectives; the index -1 stands for the number of a candidate."""

    def place(each: Tried) -> tuple[float, float]:
        assert each.objectives is not None
        return (float(each.number) if across < 0 else each.objectives[across], each.objectives[up])

    measured = [each for each in learned.candidates if each.objectives is not None]
    places = [place(each) for each in measured]
    low = min((x for x, _ in places), default=0.0), min((y for _, y in places), default=0.0)
    high = max((x for x, _ in places), default=1.0), max((y for _, y in places), default=1.0)

    def scale(point: tuple[float, float]) -> tuple[float, float]:
        x, y = ((value - a) / ((b - a) or 1.0) for value, a, b in zip(point, low, high, strict=True))
        return (
            round(MARGIN + (WIDTH - 2 * MARGIN) * x, 1),
            round(HEIGHT - MARGIN - (HEIGHT - 2 * MARGIN) * y, 1),
        )

    dots = tuple(
        Dot(
            *scale(place(each)),
            verdict=each.verdict,
            title=_describe(learned, each),
            is_default=each.number == DEFAULTS,
            is_chosen=each.number == learned.chosen,
        )
        for each in measured
    )
    front = sorted(place(learned.candidate(number)) for number in learned.front) if across >= 0 else []
    names = ["candidate" if across < 0 else learned.minimise[across], learned.minimise[up]]
    return CandidatePlot(names[0], names[1], low, high, dots, tuple(map(scale, front)))


def _describe(learned: Learned, each: Tried) -> str:
    values = ", ".join(f"{of.parameter} {value}" for of, value in zip(learned.parameters, each.values, strict=True))
    return f"candidate {each.number}, {each.verdict}: {values}"
