"""Commands of a task run that may be impossible: edits of the world, answers, and decisions after a failure."""

from __future__ import annotations

from collections.abc import Sequence

from skillc_runtime.devices.prompts import find_prompt
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, PreparedTask
from skillc_runtime.execution.attempt import AttemptResult, RunContext
from skillc_runtime.execution.conclusion import continue_plan, skip_failed_step
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.execution.world_edit import edit_world
from skillc_runtime.planning.validation import PlanError
from skillc_runtime.recording import commands


def try_command(
    command: commands.Command,
    assignment: Assignment,
    attempts: Sequence[AttemptResult],
    context: RunContext,
    tree: TreeRun | None,
) -> PreparedTask | None:
    """Do the part of a command that may be impossible; return how the task goes on, if the command decides that.

    PlanError, StoreError or ValueError if it is impossible, and then nothing has changed.
    """
    world, library = context.backend.cell.world, context.library
    match command:
        case commands.EditWorld():
            edit_world(world, command)
        case commands.Skip(who=who, why=why):
            return skip_failed_step(attempts[-1], library, world, f"{who}: {why}")
        case commands.RetryStep():
            prepared = continue_plan(attempts[-1], library, world.snapshot())
            context.failures.forget(attempts[-1].steps_with_status("failure"))
            return prepared
        case commands.AnswerPrompt(choice=choice, prompt=number):
            prompt = find_prompt(tree.active.prompts if tree else (), number, choice)
            assert tree is not None, "a skill that runs asks"
            tree.answer(prompt.id, choice)
        case commands.Replan() if not isinstance(assignment.objective, AchieveGoal):
            raise PlanError("only a goal can be planned for again")
        case _:
            pass
    return None
