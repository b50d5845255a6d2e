"""What was learned, as text for the terminal: the front, the comparison with fresh seeds, the change of the text."""

from __future__ import annotations

from collections.abc import Iterator

from skillc.cli.layout import Style, TerminalPage
from skillc.services.learning.evidence import format_seeds
from skillc.services.learning.result import DEFAULTS, Learned, Tried


def format_learned(learned: Learned, page: TerminalPage) -> str:
    """Return what was tried, the front with the defaults, what is important, the fresh trials, and the diff."""
    sections = (
        list(_list_headline(learned, page)),
        _list_front(learned, page),
        list(_list_importances(learned, page)),
        list(_list_fresh(learned, page)),
        learned.diff.rstrip("\n").split("\n") if learned.diff else [],
        list(_list_recordings(learned, page)),
    )
    return "\n\n".join("\n".join(lines) for lines in sections if lines)


def _list_headline(learned: Learned, page: TerminalPage) -> Iterator[str]:
    counts = dict.fromkeys(("measured", "infeasible", "dominated"), 0)
    for each in learned.candidates:
        counts[each.verdict] += 1
    done = f"{len(learned.candidates)} of {learned.wanted} candidates tried"
    yield f"{page.paint(learned.task, 'strong')}  {done} in {sum(each.trials for each in learned.candidates)} trials"
    text = (
        f"{counts['measured']} met all constraints in {len(learned.seeds)} trials each, "
        f"{counts['infeasible']} did not, {counts['dominated']} were given up as worse than another one"
    )
    yield from page.wrap(text, hanging="  ")
    if learned.chosen is None:
        yield from page.wrap("nothing better than the defaults was found", "warning", hanging="  ")


def _list_front(learned: Learned, page: TerminalPage) -> list[str]:
    shown = dict.fromkeys((DEFAULTS, *learned.front, *(() if learned.chosen is None else (learned.chosen,))))
    known = {each.number: each for each in learned.candidates}
    rows = [_make_row(learned, known[number]) for number in shown if number in known]
    header = ("", *learned.minimise, *(each.parameter for each in learned.parameters), "")
    return page.table(header, rows, right=range(1, len(learned.minimise) + 1)) if rows else []


def _make_row(learned: Learned, each: Tried) -> tuple[str, ...]:
    objectives = each.objectives or (None,) * len(learned.minimise)
    if each.number == learned.chosen:
        remark = "proposed"
    elif each.number == DEFAULTS:
        remark = "the defaults" + (", which break a constraint" if each.verdict == "infeasible" else "")
    else:
        remark = ""
    figures = ("-" if value is None else f"{value:.3g}" for value in objectives)
    return (str(each.number), *figures, *each.values, remark)


def _list_importances(learned: Learned, page: TerminalPage) -> Iterator[str]:
    for objective, shares in learned.importances.items():
        if shares:
            text = ", ".join(f"{name.rpartition('.')[2]} {share:.0%}" for name, share in shares.items())
            yield from page.wrap(f"{objective} depends on: {text}", hanging="  ")


def _list_fresh(learned: Learned, page: TerminalPage) -> Iterator[str]:
    fresh = learned.fresh
    if fresh is None or learned.chosen is None:
        return
    count = len(fresh.seeds)
    met = f"{fresh.learned_met} of {count} trials met all constraints, with the defaults {fresh.defaults_met}"
    style: Style = "" if learned.is_confirmed else "bad"
    yield from page.wrap(f"with the fresh seeds {format_seeds(fresh.seeds)}, {met}", style, hanging="  ")
    header = ("", "defaults", "learned", "difference, 95% CI")
    rows = []
    for each in fresh.objectives:
        interval = each.interval
        change = "" if interval is None else f"{interval.low:+.3g} to {interval.high:+.3g}"
        rows.append((each.objective, f"{each.defaults:.3g}", f"{each.learned:.3g}", change))
    yield from page.table(header, rows, right=(1, 2)) if rows else ()


def _list_recordings(learned: Learned, page: TerminalPage) -> Iterator[str]:
    for what, folder in learned.recordings.items():
        yield from page.wrap(f"recorded run, {what}: {folder}", "dim", hanging="  ")
