"""Show the jobs of a server: plans, rehearsals, trials, reports and learning, whoever has begun them.

A job that a restart of the server has interrupted, that failed or was cancelled can be begun again.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from datetime import UTC, datetime
from typing import TYPE_CHECKING, assert_never

import click
import msgspec

from skillc.cli.command import Command, Group
from skillc.cli.console import page_of, print_json, print_lines, print_remark, print_result, print_text
from skillc.cli.options import json_option
from skillc.cli.server_access import cell_option
from skillc.cli.server_completions import complete_job
from skillc.cli.server_connection import connect_server, server_options

if TYPE_CHECKING:
    from skillc.cli.layout import Row
    from skillc.client.server import Server
    from skillc.contract.job import Job, JobEvent, JobOutcome
    from skillc.contract.learning import LearnResult

JOB = click.argument("job", shell_complete=complete_job)


@click.group(cls=Group)
def command() -> None:
    """Show the jobs of a server: plans, rehearsals, trials, reports and learning, whoever has begun them.

    A restart of the server interrupts those that go on or wait; `restart` begins one again.
    """


@command.command("list", cls=Command, examples="skillc jobs list --cell iiwa_table")
@cell_option
@json_option
@server_options
def list_jobs(cell: str | None, as_json: bool) -> None:
    """List the jobs of all cells, or of one: id, kind, cell, who began it, its state, and how much is done."""
    with connect_server() as server:
        found = server.jobs(cell)
    if as_json:
        print_json(found)
    else:
        print_lines(page_of(sys.stdout).columns([_row(each) for each in found]))


@command.command(cls=Command)
@JOB
@json_option
@server_options
def show(job: str, as_json: bool) -> None:
    """Show how far JOB is, and what came of it."""
    from skillc.contract.job import ONGOING

    with connect_server() as server:
        found = server.job(job)
        has_result = found.state == "ended" or (found.request.__struct_config__.tag == "trials" and found.done)
        outcome = server.job_result(job).outcome if has_result else None
    if as_json:
        print_json({"job": msgspec.to_builtins(found), "outcome": msgspec.to_builtins(outcome)})
        return
    print_lines(page_of(sys.stdout).columns([_row(found)]))
    if outcome is not None:
        _print_outcome(outcome)
    elif found.state not in ONGOING:
        print_remark(f"`skillc jobs restart {job}` begins it again")


@command.command(cls=Command)
@JOB
@click.option("-f", "--follow", is_flag=True, help="Print what comes, too, until the job goes on no more.")
@server_options
def log(job: str, follow: bool) -> None:
    """Print the log of JOB."""
    from skillc.contract.job import ONGOING

    after = 0
    with connect_server() as server:
        while events := server.job_events(job, after, 20.0 if follow and after else 0.0):
            for each in events:
                print_text(_describe(each))
            after = events[-1].sequence
            if not follow and events[-1].state not in ONGOING:
                return


def _add_command(name: str, act: Callable[[Server, str], Job], help: str) -> None:
    @command.command(name, cls=Command, help=help)
    @JOB
    @server_options
    def change(job: str) -> None:
        with connect_server() as server:
            found = act(server, job)
        print_remark(f"{found.id}: {found.state}")


_add_command("cancel", lambda server, job: server.cancel_job(job), "End JOB; what is done of it is kept.")
_add_command(
    "restart",
    lambda server, job: server.restart_job(job),
    "Begin JOB again, as its cell is now; trials go on with those that are missing.",
)


@command.command(cls=Command)
@JOB
@server_options
def remove(job: str) -> None:
    """End JOB, and forget it with its log, its result and its files."""
    with connect_server() as server:
        server.remove_job(job)
    print_remark(f"{job}: removed")


def _row(job: Job) -> Row:
    kind = str(job.request.__struct_config__.tag)
    failed = f", {job.failed} failed" if job.failed else ""
    return job.id, kind, job.cell, job.owner, job.state, f"{job.done} of {job.wanted}{failed}", job.reason


def _describe(event: JobEvent) -> str:
    when = datetime.fromtimestamp(event.wall_time_ns / 1e9, UTC)
    return f"{when:%Y-%m-%d %H:%M:%SZ}  {event.message}"


def _print_outcome(outcome: JobOutcome) -> None:
    from skillc.cli.console import is_unicode
    from skillc.cli.output.result import format_result
    from skillc.cli.output.trials import format_series
    from skillc.contract.job import PlanResult, RunResult, TrialsResult
    from skillc.contract.learning import LearnResult

    match outcome:
        case PlanResult(plan):
            print_text(plan.text)
        case RunResult(run):
            print_result(format_result(run, page_of(sys.stdout)))
        case TrialsResult(series):
            print_result(format_series(series, page_of(sys.stdout), is_unicode(sys.stdout)))
        case LearnResult():
            print_text(_describe_learned(outcome))
        case _:
            assert_never(outcome)


def _describe_learned(learned: LearnResult) -> str:
    """Return what was learned, as text: the values, the objectives with the defaults and with these, the change."""
    if not learned.values:
        return f"{learned.candidates} candidates tried: nothing is better than the defaults"
    values = ", ".join(f"{name} = {value}" for name, value in learned.values.items())
    means = [f"{name}: {before:.4g} -> {after:.4g}" for name, (before, after) in learned.objectives.items()]
    confirmed = "confirmed by fresh trials" if learned.confirmed else "not confirmed by fresh trials"
    return "\n".join(
        (f"{learned.candidates} candidates tried: {values}, {confirmed}", *means, "", learned.diff.rstrip())
    )
