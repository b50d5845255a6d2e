"""What was learned as one self-contained HTML page: front, importances, fresh trials, the change, the runs."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from os.path import relpath
from pathlib import Path

from skillc.services.learning.evidence import format_seeds
from skillc.services.learning.result import DEFAULTS, Learned, Tried
from skillc.services.reporting.files import write_file
from skillc_runtime.evaluation.pages.dots import Dot, DotPlot, fit_scale
from skillc_runtime.evaluation.pages.page import make_page

PAGE = "learned.html"
WIDTH, HEIGHT = 420, 260
"""The size of a plot in px."""


def write_page(learned: Learned, out: Path) -> None:
    """Write the page of what was learned into its folder. ServiceError if it cannot be written."""
    write_file(out / PAGE, render_page(learned, out))


def render_page(learned: Learned, out: Path) -> str:
    """Return the page, with the runs as links from the folder `out`."""
    known = {each.number: each for each in learned.candidates}
    shown = dict.fromkeys((DEFAULTS, *learned.front, *(() if learned.chosen is None else (learned.chosen,))))
    return make_page(
        Path(__file__).parent / "page.html.j2",
        learned=learned,
        rows=[known[number] for number in shown if number in known],
        plots=list(_plot_candidates(learned)),
        seeds=format_seeds(learned.seeds),
        fresh_seeds=format_seeds(learned.fresh.seeds) if learned.fresh else "",
        links={what: Path(relpath(folder, out)).as_posix() for what, folder in learned.recordings.items()},
        trials=sum(each.trials for each in learned.candidates),
        default=DEFAULTS,
    )


def _plot_candidates(learned: Learned) -> Iterator[DotPlot]:
    """Yield a plot of each pair of objectives; of a single one, over the numbers of the candidates."""
    if len(learned.minimise) == 1:
        yield _plot(learned, -1, 0)
    for across, up in combinations(range(len(learned.minimise)), 2):
        yield _plot(learned, across, up)


def _plot(learned: Learned, across: int, up: int) -> DotPlot:
    """Return the candidates by two objectives; the index -1 stands for the number of a candidate."""

    def place(each: Tried) -> tuple[float, float]:
        assert each.objectives is not None
        return (float(each.number) if across < 0 else each.objectives[across], each.objectives[up])

    measured = [each for each in learned.candidates if each.objectives is not None]
    x = fit_scale([place(each)[0] for each in measured], WIDTH)
    y = fit_scale([place(each)[1] for each in measured], HEIGHT, is_upwards=True)
    front = sorted(place(learned.candidate(number)) for number in learned.front) if across >= 0 else []
    of, over = learned.minimise[up], "candidate" if across < 0 else learned.minimise[across]
    return DotPlot(
        f"{of} over {over}",
        WIDTH,
        HEIGHT,
        x,
        tuple(_make_dot(learned, each, x.place(place(each)[0]), y.place(place(each)[1])) for each in measured),
        path=tuple((x.place(each), y.place(value)) for each, value in front),
        across=over,
        up=f"{of} {y.low:.3g} to {y.high:.3g}",
    )


def _make_dot(learned: Learned, each: Tried, x: float, y: float) -> Dot:
    """Return a candidate as a dot: its verdict, and whether it has the defaults or is proposed."""
    marks = [*(["default"] if each.number == DEFAULTS else []), *(["chosen"] if each.number == learned.chosen else [])]
    values = ", ".join(f"{of.parameter} {value}" for of, value in zip(learned.parameters, each.values, strict=True))
    title = f"candidate {each.number}, {each.verdict}: {values}"
    return Dot(x, y, " ".join([each.verdict, *marks]), title, 5.0 if marks else 3.5)
