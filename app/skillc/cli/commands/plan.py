"""Plan for a task or a goal, without running it.

Prints whether the plan is proved optimal, in total work or in makespan.

Exit code 3 if no plan is found.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from skillc.cli.command import Command
from skillc.cli.options import PLANNING, grouped_option, json_option, store_options, task_arguments
from skillc.cli.progress.slow_notice import notice_if_slow
from skillc.cli.run_options import run_options
from skillc.cli.server_access import cell_options, refuse_options
from skillc.cli.server_completions import complete_asked_argument, complete_asked_task
from skillc.cli.server_connection import asks_cell

if TYPE_CHECKING:
    from skillc_runtime.planning.progress import PlanningProgress
    from skillc_runtime.recording.run_spec import RunSpec

DEADLINE_S = 30.0
"""For how long is planned, unless it is said."""

EXAMPLES = """
skillc plan clean_table
skillc plan --scene cell.ttl --goal "lab:Box-A contain lab:Part-A"
skillc plan clean_table --always "not lab:Iiwa-1.deviceState == Fault"
skillc plan wiping:clean_both --minimise makespan --json
skillc plan fill_rack --beside empty_bin
"""


@click.command(cls=Command, examples=EXAMPLES)
@click.argument("task", required=False, shell_complete=complete_asked_task)
@task_arguments(complete_asked_argument)
@store_options
@run_options(only=("goal", "scene", "library", "beside", "always", "minimise", "backend", "geometry", "plan_cache"))
@grouped_option(PLANNING, "--prove", is_flag=True, help="Include more of a large scene until optimality is proved.")
@grouped_option(
    PLANNING,
    "--planner",
    "only",
    type=click.Choice(("fast-downward", "built-in")),
    help="Minimise work with this planner alone; by default the built-in one takes over where Fast Downward gives up.",
)
@grouped_option(
    PLANNING,
    "--write-pddl",
    "pddl",
    metavar="FOLDER",
    type=click.Path(path_type=Path, file_okay=False),
    help="Write the problems as the planner gets them: domain-1.pddl, problem-1.pddl, and so on for larger parts.",
)
@grouped_option(
    PLANNING,
    "--deadline",
    type=click.FloatRange(min=0.1),
    metavar="SECONDS",
    default=DEADLINE_S,
    show_default=True,
    help="The time limit of the planner.",
)
@cell_options
@json_option
def command(
    spec: RunSpec, store: str | None, reset: bool, prove: bool, only: str | None, pddl: Path | None, as_json: bool
) -> int:
    """Plan for TASK, or for --goal in --scene, and print the steps.

    TASK is the name of a task of the project here or of a shipped one, or LIBRARY:NAME; `skillc tasks` lists them. In a
    project, TASK may be left out if the manifest names a default one.

    With --cell or --server, a running cell plans for a task of its library, as its world is now.
    """
    from skillc.cli import cell_questions
    from skillc.cli.console import Terminal, print_text, remark_default
    from skillc.services.planning.plan_text import format_plan, plan_as_json
    from skillc.services.planning.planning import keep_within, plan_goal, prepare_planners
    from skillc.services.scene.stores import StoreChoice
    from skillc.services.space.claims import plan_goal_in_space
    from skillc.services.tasks.loading import check_request, fill_in, load_task, with_measure, with_project_measure
    from skillc_runtime.cancellation import CancelToken
    from skillc_runtime.planning.plan import GaveUp, Unsolvable
    from skillc_runtime.planning.progress import describe_progress

    if asks_cell():
        refuse_options(scene=spec.scene, library=spec.library, always=spec.always, beside=spec.beside)
        refuse_options(store=store, reset=reset, planner=only, write_pddl=pddl)
        return cell_questions.plan(spec, prove, as_json)
    kept = StoreChoice(store, reset)
    wanted = fill_in(spec, kept)
    remark_default(spec.task, wanted.task)
    check_request(wanted, kept, calls=False)
    limit_s = wanted.deadline_s or DEADLINE_S
    with load_task(wanted, Terminal(), kept) as found:
        loaded = with_measure(found, with_project_measure(wanted, found, "plan").minimise)
        progress: list[PlanningProgress] = []
        with notice_if_slow(
            f"planning, for at most {limit_s:g} s ..", lambda: describe_progress(progress[-1]) if progress else ""
        ):
            planners, cancel = prepare_planners(wanted.plan_cache, only, pddl), CancelToken(limit_s)
            if wanted.geometry and not loaded.library.vocabulary.symbolic:
                answer, space = plan_goal_in_space(loaded, planners, cancel, progress.append, prove)
            else:
                answer, space = plan_goal(loaded, planners, cancel, progress.append, prove=prove), None
        answer, space = keep_within(answer, space, loaded)
        if as_json:
            click.echo(plan_as_json(answer, loaded, space))
        else:
            print_text(format_plan(answer, loaded, space))
    return 3 if isinstance(answer, Unsolvable | GaveUp) else 0
