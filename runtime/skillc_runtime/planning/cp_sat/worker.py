"""A program that makes schedules with CP-SAT: `python -m skillc_runtime.planning.cp_sat.worker`, beside a task.

The facts of a task are timelines: of each fact, the activities that change it follow each other without overlap, and
what needs a value begins after the activity that made it, and ends before the next one that changes it. Activities are
optional intervals (Laborie et al., "IBM ILOG CP optimizer for scheduling", 2018); that causes of facts are chosen among
them is as in Vidal and Geffner, "Branching and pruning", 2006.
"""

from __future__ import annotations

from collections import defaultdict
from itertools import product
from pathlib import Path
from threading import Lock
from typing import NamedTuple

import msgspec
from ortools.sat.python import cp_model

from skillc_runtime.planning.cp_sat.task import (
    ANSWER,
    TASK,
    Activity,
    AllOf,
    AnyOf,
    Need,
    ScheduleAnswer,
    ScheduleTask,
    list_conjuncts,
    list_literals,
)

SEED = 1


class Instance:
    """One time that an activity may be done, with its variables."""

    def __init__(self, model: cp_model.CpModel, number: int, activity: Activity, horizon: int) -> None:
        self.number, self.activity = number, activity
        self.present = model.new_bool_var("")
        self.start = model.new_int_var(0, max(horizon - activity.units, 0), "")
        self.end = self.start + activity.units
        if activity.units > horizon:
            model.add(self.present == 0)
        self.interval = model.new_optional_fixed_size_interval_var(self.start, activity.units, self.present, "")


class _Writer(NamedTuple):
    """An instance that changes a timeline: from a value, None for any, to another one."""

    instance: Instance
    needed: int | None
    made: int


class _Timeline:
    """What has one value after the other: a fact (0 or 1), or a group of facts of which one holds (its number).

    `writers` change it, each `until` a time from which the next one does; the first is for the value at the beginning.
    """

    def __init__(self, model: cp_model.CpModel, initial: int, writers: list[_Writer], horizon: int) -> None:
        self.initial, self.writers = initial, writers
        self.until = [model.new_int_var(0, horizon + 1, "") for _ in range(len(writers) + 1)]
        arcs = [(0, 0, _none_of(model, writers))]
        for index, writer in enumerate(writers, 1):
            arcs += [(index, index, writer.instance.present.negated()), (index, 0, model.new_bool_var(""))]
        for one, other in product(range(len(self.until)), range(1, len(self.until))):
            if one != other and writers[other - 1].needed in (None, self.made(one)):
                arcs.append((one, other, self._follows(model, one, other)))
        model.add_circuit(arcs)

    def made(self, index: int) -> int:
        """Return the value after a writer, 0 for the beginning."""
        return self.writers[index - 1].made if index else self.initial

    def _follows(self, model: cp_model.CpModel, one: int, other: int) -> cp_model.IntVar:
        """Return whether `other` is the next writer after `one`, 0 for the beginning."""
        next_, start = model.new_bool_var(""), self.writers[other - 1].instance.start
        model.add(self.until[one] <= start).only_enforce_if(next_)
        if one:
            model.add(self.writers[one - 1].instance.end <= start).only_enforce_if(next_)
        return next_


def _none_of(model: cp_model.CpModel, writers: list[_Writer]) -> cp_model.IntVar:
    none = model.new_bool_var("")
    for writer in writers:
        model.add_implication(none, writer.instance.present.negated())
    return none


class ScheduleModel:
    """The model of a task."""

    def __init__(self, task: ScheduleTask) -> None:
        self.task, self.model = task, cp_model.CpModel()
        self.makespan = self.model.new_int_var(0, task.horizon, "")
        self.instances = [
            Instance(self.model, number, each, task.horizon)
            for number, each in enumerate(task.activities)
            for _ in range(1 if task.relaxed else each.copies)
        ]
        self._writers: dict[int, list[tuple[Instance, bool]]] = defaultdict(list)
        for instance in self.instances:
            self.model.add(instance.end <= self.makespan).only_enforce_if(instance.present)
            for literal in instance.activity.effects:
                self._writers[abs(literal)].append((instance, literal > 0))
        self._true = frozenset(task.true)
        self._add_devices()
        if task.relaxed:
            self._made: dict[int, tuple[cp_model.IntVar, cp_model.IntVar]] = {}
        else:
            self._add_order_of_copies()
            self._add_timelines()
        for instance in self.instances:
            self._require(instance.activity.need, instance.present, instance)
        self._require(task.goal, None, None)
        self._add_first_schedule()
        self.model.minimize(self.makespan)

    def _add_devices(self) -> None:
        users: dict[int, list[cp_model.IntervalVar]] = defaultdict(list)
        for instance in self.instances:
            for device in instance.activity.devices:
                users[device].append(instance.interval)
        for intervals in users.values():
            self.model.add_no_overlap(intervals)

    def _add_order_of_copies(self) -> None:
        for one, other in zip(self.instances, self.instances[1:], strict=False):
            if one.number == other.number:
                self.model.add_implication(other.present, one.present)
                self.model.add(one.end <= other.start).only_enforce_if(other.present)

    def _add_timelines(self) -> None:
        """Make a timeline for each literal that is needed, with the value that stands for it.

        What shall not hold has one of its own: of its group, it does not matter which other fact holds.
        """
        needs = (self.task.goal, *(activity.need for activity in self.task.activities))
        needed = {literal for need in needs for literal in list_literals(need)}
        self._timelines: dict[int, tuple[_Timeline, int]] = {}
        for group in self.task.groups:
            if needed.intersection(group):
                timeline = self._make_timeline(group)
                self._timelines |= {fact: (timeline, fact) for fact in group}
        for fact, writers in self._writers.items():
            if len(writers) > 1:
                self.model.add_no_overlap([writer.interval for writer, _ in writers])
            missing = [each for each in (fact, -fact) if each in needed and each not in self._timelines]
            if missing:
                timeline = self._make_timeline((fact,))
                self._timelines |= {literal: (timeline, int(literal > 0)) for literal in missing}

    def _make_timeline(self, facts: tuple[int, ...]) -> _Timeline:
        """Return the timeline of a fact, or of a group of facts of which one holds at any time."""
        one_of_many, found = len(facts) > 1, list[_Writer]()
        for instance in self.instances:
            effects = [each for each in instance.activity.effects if abs(each) in facts]
            made = [each for each in effects if each > 0 or not one_of_many]
            if not effects:
                continue
            needed = [each for each in list_conjuncts(instance.activity.need) if abs(each) in facts]
            if one_of_many:
                found.append(_Writer(instance, *(each for each in needed if each > 0), *made))
            else:
                found.append(_Writer(instance, int(needed[0] > 0) if needed else None, int(made[0] > 0)))
        initial = [each for each in facts if each in self._true]
        return _Timeline(self.model, initial[0] if one_of_many else len(initial), found, self.task.horizon)

    def _require(self, need: Need, guard: cp_model.IntVar | None, reader: Instance | None) -> None:
        """Let `need` hold for a reader, None for the goal, if `guard` is true."""
        match need:
            case int():
                self._require_literal(need, guard, reader)
            case AllOf(parts):
                for part in parts:
                    self._require(part, guard, reader)
            case AnyOf(parts):
                chosen = [self.model.new_bool_var("") for _ in parts]
                self._at_least_one(chosen, guard)
                for part, choice in zip(parts, chosen, strict=True):
                    self._require(part, choice, reader)

    def _at_least_one(self, chosen: list[cp_model.IntVar], guard: cp_model.IntVar | None) -> None:
        self.model.add_bool_or(*chosen, *([] if guard is None else [guard.negated()]))

    def _require_literal(self, literal: int, guard: cp_model.IntVar | None, reader: Instance | None) -> None:
        if self.task.relaxed:
            self._require_made(literal, guard, reader)
            return
        if literal not in self._timelines:
            if (abs(literal) in self._true) != (literal > 0):
                self._at_least_one([], guard)
            return
        timeline, value = self._timelines[literal]
        start, end = self._span_of(timeline, reader)
        causes = []
        for index, until in enumerate(timeline.until):
            writer = timeline.writers[index - 1].instance if index else None
            if timeline.made(index) != value or (writer is not None and writer is reader):
                continue
            cause = self.model.new_bool_var("")
            self.model.add(end <= until).only_enforce_if(cause)
            if writer is not None:
                self.model.add_implication(cause, writer.present)
                self.model.add(writer.end <= start).only_enforce_if(cause)
            causes.append(cause)
        self.model.add(sum(causes) == (1 if guard is None else guard))  # the last writer before

    def _span_of(
        self, timeline: _Timeline, reader: Instance | None
    ) -> tuple[cp_model.LinearExprT, cp_model.LinearExprT]:
        """Return from when until when a reader needs a value: for the goal (None) for ever, or until it changes it."""
        if reader is None:
            return self.makespan, self.task.horizon + 1
        changes = any(each.instance is reader for each in timeline.writers)
        return reader.start, reader.start if changes else reader.end

    def _require_made(self, literal: int, guard: cp_model.IntVar | None, reader: Instance | None) -> None:
        """Let a reader begin after somebody has made a literal true, which it stays."""
        if (abs(literal) in self._true) == (literal > 0):
            return
        if literal not in self._made:
            made, time = self.model.new_bool_var(""), self.model.new_int_var(0, self.task.horizon, "")
            causes = []
            for writer, value in self._writers.get(abs(literal), ()):
                if value == (literal > 0):
                    causes.append(cause := self.model.new_bool_var(""))
                    self.model.add_implication(cause, writer.present)
                    self.model.add(time >= writer.end).only_enforce_if(cause)
            self._at_least_one(causes, made)
            self._made[literal] = made, time
        made, time = self._made[literal]
        start = reader.start if reader else self.makespan
        later = self.model.add(start >= time)
        if guard is None:
            self.model.add(made == 1)
        else:
            later.only_enforce_if(guard)
            self.model.add_implication(guard, made)

    def _add_first_schedule(self) -> None:
        left = defaultdict(list)
        for number, start in self.task.first:
            left[number].append(start)
        for instance in self.instances:
            starts = left[instance.number]
            self.model.add_hint(instance.present, bool(starts))
            if starts:
                self.model.add_hint(instance.start, starts.pop(0))


class _Watch(cp_model.CpSolverSolutionCallback):
    """Writes down each schedule that is found, since the program may be ended at any time."""

    def __init__(self, model: ScheduleModel) -> None:
        super().__init__()
        self._model, self._at_least, self._writing = model, 0, Lock()
        self._starts: tuple[tuple[int, int], ...] | None = None

    def on_solution_callback(self) -> None:
        """Take a better schedule."""
        present = [each for each in self._model.instances if self.value(each.present)]
        self._starts = tuple((each.number, self.value(each.start)) for each in present)
        self.write(self.best_objective_bound)

    def write(self, bound: float, ended: bool = False) -> None:
        """Write the answer as it is now known."""
        self._at_least = max(self._at_least, round(bound))
        answer = ScheduleAnswer(None if self._model.task.relaxed else self._starts, self._at_least, ended)
        with self._writing:
            file = Path(f"{ANSWER}.new")
            file.write_bytes(msgspec.json.encode(answer))
            file.replace(ANSWER)


def main() -> None:
    """Solve the task in this folder."""
    task = msgspec.json.decode(Path(TASK).read_bytes(), type=ScheduleTask)
    model = ScheduleModel(task)
    watch, solver = _Watch(model), cp_model.CpSolver()
    solver.parameters.max_time_in_seconds, solver.parameters.random_seed = task.seconds, SEED
    solver.parameters.num_workers = task.workers
    solver.best_bound_callback = watch.write
    status = solver.solve(model.model, watch)
    ended = status in (cp_model.OPTIMAL, cp_model.INFEASIBLE)
    watch.write(0.0 if status == cp_model.INFEASIBLE else solver.best_objective_bound, ended)


if __name__ == "__main__":
    main()
