"""The keyword arguments with which programs run something, made from its specification; do not edit.

`python tests/accept.py` writes this file.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from datetime import datetime
from typing import Any, Literal, TypedDict

from skillc.values.arguments import AnyPath


class WorkKeywords(TypedDict, total=False):
    """How something is run, and what is written of it."""

    geometry: bool
    """Look whether the arms can carry out a plan, before anything moves."""
    deadline_s: float | None
    """Let the task fail if it has not ended after these seconds of the cell's time; also limits planning."""
    step_deadline_s: float | None
    """Let a primitive or a wait fail if it has not ended after these seconds of the cell's time, without those that
    it was paused."""
    speed: float
    """Move arms and bases with this share of their speeds, above 0 to 1; forces stay as they are."""
    beside: Sequence[str]
    """Another task of the same library and scene, to plan and run as one with TASK, which has precedence."""
    always: Sequence[str]
    """Let neither the plan nor the run break this condition, besides what the task says holds always."""
    minimise: Literal["cost", "makespan", "work"] | None
    """Minimise the total duration of all steps (`work`), the time until the last one ends, or the total cost. By
    default as the task or else its project says, and `work` if none does."""
    plan_cache: bool
    """Reuse plans that were found for the same problem."""
    seed: int
    """The seed of what differs from the world model."""
    reality: str | None
    """How far simulated arms and tools are from what they should be: `ideal`, `typical` or `wide`, all
    imperfections that their sheets state, or only some of them: `wide:jointFriction,forceBias`. By default as the
    scene says, ideal if it says nothing."""
    backend: str | None
    """Simulate with physics (`mujoco`), with ideal motion and contact (`kinematic`): faster, but contact is not
    verified then; or with facts alone (`symbolic`). Others run on robots. By default as the task or else its
    project says, and `mujoco` if none does."""
    dry: bool
    """Move nothing: look where the devices are, begin there in simulation, and record what would be sent."""
    out: AnyPath | None
    """Write report.html, result.json, events.jsonl, figures, the film and stills to this folder."""
    signals: Literal["csv", "parquet"] | None
    """Record forces, poses, joints and references, 100 samples a second, to the folder of the report."""
    film: bool
    """Write a film and stills with the report; another process makes them."""
    film_quality: Literal["draft", "fine", "standard"]
    """The quality of the film: small and without shadows, 960 x 540 pixels, or 1280 x 720, which takes longer."""
    gif: bool
    """Write film.gif as well, a film of at most 4 MB that repeats."""
    looks: str
    """The appearance of devices in films: `primitive` shapes, or `menagerie` meshes (downloaded once)."""


class AttendedKeywords(TypedDict, total=False):
    """How who runs something attends to it."""

    step: bool
    """Pause before the first call, and go on step by step."""
    breakpoints: Sequence[str]
    """Pause before each call of a skill, or before the calls in a line."""
    confirm_steps: bool
    """Pause before each step, with the arms held, until somebody lets the task go on."""
    pace: float | str
    """Let simulated time pass as fast as it computes, or at most N times as fast as real time."""


class RunKeywords(WorkKeywords, total=False):
    """What is run, and how."""

    arguments: Mapping[str, Any] | None
    """The values of the task's parameters, as in a call, such as `lab:Tray-1` or `8 N`."""
    goal: str | None
    """Instead of a task: plan for this goal, a condition, PDDL or JSON."""
    call: str | None
    """Instead of a task: call a skill, as in `Wipe(surface: lab:Table-1)`."""
    scene: AnyPath | None
    """The scene of a goal or a call."""
    library: AnyPath | None
    """The library of a goal or a call; by default that here, or `wiping`."""


class StartKeywords(RunKeywords, AttendedKeywords, total=False):
    """What is started, and how."""


class SceneRunKeywords(WorkKeywords, total=False):
    """What is run in a scene, and how."""

    call: str | None
    """Instead of a task: call a skill, as in `Wipe(surface: lab:Table-1)`."""


class SceneStartKeywords(SceneRunKeywords, AttendedKeywords, total=False):
    """What is started in a scene, and how."""


class SubmitKeywords(TypedDict, total=False):
    """What a cell of a server is given."""

    arguments: Mapping[str, Any] | None
    """The values of the task's parameters, as in a call, such as `lab:Tray-1` or `8 N`."""
    goal: str | None
    """Instead of a task: plan for this goal, a condition, PDDL or JSON."""
    call: str | None
    """Instead of a task: call a skill, as in `Wipe(surface: lab:Table-1)`."""
    geometry: bool
    """Look whether the arms can carry out a plan, before anything moves."""
    approve: bool
    """Let each plan, also a new one, wait for approval."""
    ask_after_failure: bool
    """Let a failed step wait for a decision instead of another plan."""
    deadline_s: float | None
    """Let the task fail if it has not ended after these seconds of the cell's time; also limits planning."""
    step_deadline_s: float | None
    """Let a primitive or a wait fail if it has not ended after these seconds of the cell's time, without those that
    it was paused."""
    speed: float
    """Move arms and bases with this share of their speeds, above 0 to 1; forces stay as they are."""
    priority: int
    """Of those that wait for planners or devices, the higher comes first; nothing that runs gives way."""


class OperationKeywords(SubmitKeywords, total=False):
    """What is started in a cell."""

    step: bool
    """Pause before the first call, and go on step by step."""
    breakpoints: Sequence[str]
    """Pause before each call of a skill, or before the calls in a line."""
    confirm_steps: bool
    """Pause before each step, with the arms held, until somebody lets the task go on."""


class LearnKeywords(TypedDict, total=False):
    """What is learned, and from how many trials."""

    minimise: str | None
    """The objectives: figures of trials or expressions over them, between commas."""
    subject_to: str | None
    """What every trial has to meet, besides its success: comparisons of figures, between commas, such as `coverage
    == 100 %, impact <= 2`."""
    parameters: str | None
    """The parameters that are learned, between commas; by default all with a range, in the library of the task,
    whose defaults the task uses."""
    candidates: int
    """How many candidates are tried, the defaults included."""
    trials: int
    """The trials of a candidate, each in another world, the same ones for all."""
    fresh: int
    """Further worlds, in which the best candidate is compared with the defaults."""
    seed: int
    """The seed of the first world."""
    sampler: Literal["gp", "nsga2", "random", "tpe"]
    """How candidates are chosen: by tree-structured Parzen estimators, NSGA-II, Gaussian processes (needs torch and
    scipy), or at random."""
    reality: str | None
    """How far simulated arms and tools are from what they should be: `ideal`, `typical` or `wide`, all
    imperfections that their sheets state, or only some of them: `wide:jointFriction,forceBias`."""
    take: int | None
    """Propose this candidate of the front, instead of the one that is chosen."""
    apply: bool
    """Write the learned values into the files of the library."""
    deadline_s: float
    """The time limit of one trial, in wall time."""


class OrderKeywords(SubmitKeywords, total=False):
    """What is started in a cell at a time, and when again; `missed` is what becomes of one that was not possible."""

    every_s: float | None
    until: datetime | None
    count: int | None
    missed: Literal["run-once", "skip"]
