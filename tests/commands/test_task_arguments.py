"""Whoever runs a task gives values to its parameters; they are checked like the arguments of a call."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner, Result

import skillc as api
from running_cells.yard import write_yard
from skillc.cli.main import skillc


@pytest.fixture(scope="module")
def yard(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("yard")
    write_yard(folder)
    return folder


def invoke(*arguments: str) -> Result:
    return CliRunner().invoke(skillc, arguments)


def test_a_task_is_planned_and_run_with_its_arguments(yard: Path) -> None:
    task = (f"{yard}:carry", "crate=lab:crate-2", "to=lab:Goal")
    planned = invoke("plan", *task)
    assert planned.exit_code == 0, planned.output
    assert "crate: lab:crate-2, to: lab:Goal" in planned.stdout and "2 steps" in planned.stdout
    ran = invoke("run", *task, "--backend", "kinematic", "--json")
    assert ran.exit_code == 0 and '"task": "carry(crate: lab:crate-2, to: lab:Goal)"' in ran.stdout, ran.output


def test_python_plans_and_runs_a_task_with_arguments(yard: Path) -> None:
    task, arguments = f"{yard}:carry", {"crate": "lab:crate-2", "to": "lab:Goal"}
    steps = api.plan(task, arguments=arguments).steps
    assert [step.arguments["crate"] for step in steps] == ["lab:crate-2"] * 2
    run = api.run(task, arguments=arguments, backend="kinematic")
    assert run.result.task == "carry(crate: lab:crate-2, to: lab:Goal)" and run.status == "succeeded"


def test_python_repeats_a_task_with_arguments(yard: Path) -> None:
    series = api.trials(f"{yard}:carry", 1, arguments={"crate": "lab:crate-2", "to": "lab:Goal"}, jobs=1).series
    assert (series.passed, series.wanted) == (1, 1)


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        ("carry crate=lab:crate-2", 1, "`carry` needs `to`"),
        ("carry crate=lab:crate-2 to=lab:crate-3", 1, "this is a Product, where a Location is expected"),
        ("carry crate=lab:crate-2 to=lab:Goul", 1, "there is no `lab:Goul` in the scene"),
        ("carry crate=lab:crate-2 to=lab:Goal from=lab:Start", 1, "has no parameter `from`"),
        ("carry crate=lab:crate-2 to=lab:Goal to=lab:Start", 2, "the argument `to` is given twice"),
        ("carry lab:crate-2", 2, "`lab:crate-2` is no argument of a task; write NAME=VALUE"),
        ("carry", 1, "`carry` needs `crate` and `to`"),
        ("carry_all crate=lab:crate-2", 2, "the task `carry_all` takes no arguments"),
    ],
)
def test_wrong_arguments_are_refused_with_a_sentence(yard: Path, arguments: str, code: int, message: str) -> None:
    task, *values = arguments.split()
    refused = invoke("plan", f"{yard}:{task}", *values)
    assert (refused.exit_code, message in refused.output) == (code, True), refused.output
