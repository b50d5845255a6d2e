"""What is to be done and how: all that a run is given, from any front door to the engine and its recording.

Options of commands, keyword arguments, JSON Schema and forms are made from these fields: each is documented once, here.
"""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

import msgspec

from skillc_runtime.recording.documented import documented

NO_OPTION, PLANNING, EXECUTION, OUTPUT = "", "Planning", "Execution", "Output"
"""The sections of a help in which the options are; commands have arguments for what is none."""
ATTENDED_ELSEWHERE = ("approve", "ask_after_failure", "priority")
"""The fields that only cells of a server take: others may operate them than who starts a run."""
RENAMED = {"pause_at": "breakpoints", "skill": "call", "ask": "ask_after_failure"}
"""Former names of fields, each with its present name; using a former one is an error that names the present one."""
Seconds: TypeAlias = Annotated[float, msgspec.Meta(gt=0.0)]


class TaskRequest(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True, forbid_unknown_fields=True):
    """What is to be done: a `task`, a `goal`, or a `call` of a skill."""

    task: Annotated[str | None, documented("The name of a task.", NO_OPTION)] = None
    arguments: Annotated[
        dict[str, str],
        documented("The values of the task's parameters, as in a call, such as `lab:Tray-1` or `8 N`.", NO_OPTION),
    ] = {}
    goal: Annotated[
        str | None, documented("Instead of a task: plan for this goal, a condition, PDDL or JSON.", metavar="CONDITION")
    ] = None
    call: Annotated[
        str | None, documented("Instead of a task: call a skill, as in `Wipe(surface: lab:Table-1)`.", metavar="CALL")
    ] = None


class RunRequest(TaskRequest, frozen=True, kw_only=True):
    """What is to be done, and how, in a cell that may go on from run to run."""

    geometry: Annotated[
        bool, documented("Look whether the arms can carry out a plan, before anything moves.", PLANNING)
    ] = True
    approve: Annotated[bool, documented("Let each plan, also a new one, wait for approval.", EXECUTION)] = False
    ask_after_failure: Annotated[
        bool, documented("Let a failed step wait for a decision instead of another plan.", EXECUTION)
    ] = False
    deadline_s: Annotated[
        Seconds | None,
        documented(
            "Let the task fail if it has not ended after these seconds of the cell's time; also limits planning.",
            EXECUTION,
        ),
    ] = None
    step_deadline_s: Annotated[
        Seconds | None,
        documented(
            "Let a primitive or a wait fail if it has not ended after these seconds of the cell's time, without those "
            "that it was paused.",
            EXECUTION,
        ),
    ] = None
    step: Annotated[bool, documented("Pause before the first call, and go on step by step.", EXECUTION)] = False
    breakpoints: Annotated[
        tuple[str, ...],
        documented(
            "Pause before each call of a skill, or before the calls in a line.", EXECUTION, metavar="SKILL|FILE:LINE"
        ),
    ] = ()
    confirm_steps: Annotated[
        bool, documented("Pause before each step, with the arms held, until somebody lets the task go on.", EXECUTION)
    ] = False
    speed: Annotated[
        Annotated[float, msgspec.Meta(gt=0.0, le=1.0)],
        documented(
            "Move arms and bases with this share of their speeds, above 0 to 1; forces stay as they are.",
            EXECUTION,
            metavar="SHARE",
        ),
    ] = 1.0
    priority: Annotated[
        Annotated[int, msgspec.Meta(ge=-100, le=100)],
        documented(
            "Of those that wait for planners or devices, the higher comes first; nothing that runs gives way.",
            EXECUTION,
            metavar="N",
        ),
    ] = 0


class RunSpec(RunRequest, frozen=True, kw_only=True):
    """All that a run is given: what is to be done, how, in which cell, and what is written of it."""

    scene: Annotated[str | None, documented("The scene of a goal or a call.", metavar="PATH")] = None
    library: Annotated[
        str | None, documented("The library of a goal or a call; by default that here, or `wiping`.", metavar="PATH")
    ] = None
    beside: Annotated[
        tuple[str, ...],
        documented(
            "Another task of the same library and scene, to plan and run as one with TASK, which has precedence.",
            PLANNING,
            metavar="TASK",
        ),
    ] = ()
    always: Annotated[
        tuple[str, ...],
        documented(
            "Let neither the plan nor the run break this condition, besides what the task says holds always.",
            PLANNING,
            metavar="CONDITION",
        ),
    ] = ()
    minimise: Annotated[
        Literal["work", "makespan", "cost"] | None,
        documented(
            "Minimise the total duration of all steps (`work`), the time until the last one ends, or the total cost. "
            "By default as the task or else its project says, and `work` if none does.",
            PLANNING,
        ),
    ] = None
    plan_cache: Annotated[bool, documented("Reuse plans that were found for the same problem.", PLANNING)] = True
    seed: Annotated[
        Annotated[int, msgspec.Meta(ge=0)],
        documented("The seed of what differs from the world model.", EXECUTION, metavar="N"),
    ] = 0
    reality: Annotated[
        str | None,
        documented(
            "How far simulated arms and tools are from what they should be: `ideal`, `typical` or `wide`, all "
            "imperfections that their sheets state, or only some of them: `wide:jointFriction,forceBias`. By default "
            "as the scene says, ideal if it says nothing.",
            EXECUTION,
            metavar="LEVEL",
        ),
    ] = None
    backend: Annotated[
        str | None,
        documented(
            "Simulate with physics (`mujoco`), with ideal motion and contact (`kinematic`): faster, but contact is not "
            "verified then; or with facts alone (`symbolic`). Others run on robots. By default as the task or else its "
            "project says, and `mujoco` if none does.",
            EXECUTION,
        ),
    ] = None
    dry: Annotated[
        bool,
        documented(
            "Move nothing: look where the devices are, begin there in simulation, and record what would be sent.",
            EXECUTION,
        ),
    ] = False
    pace: Annotated[
        float | str,
        documented(
            "Let simulated time pass as fast as it computes, or at most N times as fast as real time.",
            EXECUTION,
            metavar="fast|real|N",
        ),
    ] = "fast"
    out: Annotated[
        str | None,
        documented(
            "Write report.html, result.json, events.jsonl, figures, the film and stills to this folder.",
            OUTPUT,
            metavar="FOLDER",
        ),
    ] = None
    signals: Annotated[
        Literal["csv", "parquet"] | None,
        documented(
            "Record forces, poses, joints and references, 100 samples a second, to the folder of the report.", OUTPUT
        ),
    ] = None
    film: Annotated[
        bool, documented("Write a film and stills with the report; another process makes them.", OUTPUT)
    ] = True
    film_quality: Annotated[
        Literal["draft", "standard", "fine"],
        documented(
            "The quality of the film: small and without shadows, 960 x 540 pixels, or 1280 x 720, which takes longer.",
            OUTPUT,
        ),
    ] = "standard"
    gif: Annotated[bool, documented("Write film.gif as well, a film of at most 4 MB that repeats.", OUTPUT)] = False
    looks: Annotated[
        str,
        documented(
            "The appearance of devices in films: `primitive` shapes, or `menagerie` meshes (downloaded once).",
            OUTPUT,
            metavar="NAME",
        ),
    ] = "primitive"


AS_USUAL = RunSpec()
"""A run with the default of every setting."""


def specify(request: RunRequest, scene: str, seed: int, backend: str) -> RunSpec:
    """Return the settings of a run that was requested of a cell, which was built from these."""
    given = {each: getattr(request, each) for each in RunRequest.__struct_fields__}
    return RunSpec(**given, scene=scene or None, seed=seed, backend=backend)
