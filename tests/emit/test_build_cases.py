"""Each folder of `cases/build` compiles to exactly the bytes it expects; `python tests/accept.py` rewrites them."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from accept import built, cases, expected
from emit.reading_back import read_back_artifact
from skillc_compiler.emit.headers import MARK
from skillc_model.codec import loads
from waiting import LONG_S


@pytest.mark.parametrize("case", cases(), ids=lambda case: case.name)
def test_a_library_compiles_to_the_expected_bytes(case: Path) -> None:
    assert built(case) == expected(case)


def test_there_are_cases_and_each_kind_of_artifact_is_among_them() -> None:
    paths = {path for case in cases() for path in expected(case)}
    assert {path.split("/")[0] for path in paths} == {
        "docs",
        "domain.pddl",
        "domain.temporal.pddl",
        "library.json",
        "skills.ttl",
        "trees",
    }


@pytest.mark.parametrize("case", cases(), ids=lambda case: case.name)
def test_another_parser_reads_the_domain(case: Path) -> None:
    artifacts = built(case)
    read_back_artifact(loads(artifacts["library.json"].encode(), case.name), artifacts["domain.pddl"])


@pytest.mark.parametrize("case", cases(), ids=lambda case: case.name)
def test_every_artifact_names_its_library_and_the_hash_of_its_sources(case: Path) -> None:
    artifacts = built(case)
    library = loads(artifacts["library.json"].encode(), case.name)
    others = {path: text for path, text in artifacts.items() if not path.endswith(".json")}
    assert others
    for path, text in others.items():
        head = " ".join(text.splitlines()[:2])
        assert MARK in head, path
        assert library.name in head and library.hash in head, path


def test_the_bytes_do_not_depend_on_the_order_of_hashes() -> None:
    code = "from accept import *; print([built(case) for case in cases()])"
    seed = "2" if os.environ.get("PYTHONHASHSEED") == "1" else "1"
    elsewhere = subprocess.run(
        [sys.executable, "-c", code],
        env={
            **os.environ,
            "PYTHONHASHSEED": seed,
            "PYTHONPATH": os.pathsep.join((str(Path(__file__).parents[1]), *sys.path)),
        },
        capture_output=True,
        check=True,
        timeout=LONG_S,
        text=True,
    )
    assert elsewhere.stdout == f"{[built(case) for case in cases()]}\n"
