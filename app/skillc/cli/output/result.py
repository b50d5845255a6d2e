"""The result of a task as text for the terminal: how it ended, its steps, and its numbers."""

from __future__ import annotations

from collections.abc import Iterator

from skillc.cli.layout import Row, Style, TableCell, TerminalPage
from skillc_runtime.evaluation.report.result import StepResult, TaskResult
from skillc_runtime.evaluation.report.table import (
    format_choice_reason,
    format_step,
    list_failure_details,
    list_table_rows,
)
from skillc_runtime.recording.known_facts import (
    FALSE_SUCCESS,
    format_false_claim,
    format_status,
    format_unverified,
    unverified_facts,
)
from skillc_runtime.world.state.labels.labelled_text import format_value

END_STYLES: dict[str, Style] = {"succeeded": "good", "failed": "bad", "refused": "bad", FALSE_SUCCESS: "bad"}
STEP_STYLES: dict[str, Style] = {"success": "good", "failure": "bad", "halted": "warning"}


def format_result(result: TaskResult, page: TerminalPage, verbose: bool = False) -> str:
    """Return how a task ended and why, the steps of its plan, and its numbers.

    Why implementations were chosen is shown for a step that failed. If `verbose`, it is shown for each step, and a
    failure has its causes and the calls that led to it.
    """
    sections = [list(_list_ending(result, page, verbose)), list(_list_steps(result, page, verbose))]
    if result.sim_time_s:
        sections.append(page.columns([(TableCell(name, "dim"), value) for name, value in list_table_rows(result)]))
    return "\n\n".join("\n".join(lines) for lines in sections if lines)


def format_ending(result: TaskResult, page: TerminalPage) -> str:
    """Return how a task ended, and why if it did not succeed."""
    return "\n".join(_list_ending(result, page, verbose=False))


def _list_ending(result: TaskResult, page: TerminalPage, verbose: bool) -> Iterator[str]:
    words = format_status(result.status, result.verified, result.false_claims)
    style = "warning" if result.dry else END_STYLES.get(words, "warning")
    shown = f"dry: nothing was sent; simulated: {words}" if result.dry else words
    yield f"{page.paint(result.task, 'strong')}  {page.paint(shown, style)}"
    for claim in result.false_claims:
        yield from page.wrap(format_false_claim(claim), "bad", hanging="  ")
    for fact in unverified_facts(result.facts):
        yield from page.wrap(format_unverified(fact), "warning", hanging="  ")
    if result.failure:
        yield from page.wrap(result.failure, "bad", hanging="  ")
    for line in list_failure_details(result) if verbose else ():
        text = line.lstrip()
        margin = " " * (2 + len(line) - len(text))
        yield from page.wrap(text, "dim", margin, f"{margin}  ")


def _list_steps(result: TaskResult, page: TerminalPage, verbose: bool) -> list[str]:
    rows = [row for step in result.plan for row in _step_rows(step, verbose)]
    choices = result.choices if verbose else ()
    rows += [("", each.skill, "", f"{each.implementation}: {format_choice_reason(each)}") for each in choices]
    return page.columns(rows)


def _step_rows(step: StepResult, verbose: bool) -> Iterator[Row]:
    """Yield the row of a step with its implementation, and one with its arguments."""
    how = format_step(step)
    if step.implementation and (verbose or step.status == "failure"):
        how = f"{how}; {step.implementation} is {format_choice_reason(step)}"
    yield f"{step.number:>2}", step.skill, TableCell(step.status, STEP_STYLES.get(step.status, "")), how
    arguments = ", ".join(f"{name}: {format_value(value)}" for name, value in step.arguments.items())
    if arguments:
        yield "", "", "", TableCell(arguments, "dim")
