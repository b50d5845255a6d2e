"""Runs Schemathesis against a server, and reads its report."""

from __future__ import annotations

import os
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import msgspec

from server.running import RunningServer

CHECKS = Path(__file__).parent / "checks.toml"
LIMITED = ("got `429 Too Many Requests`", "Got 429 when missing required 'Authorization' header")
"""How the checks say that requests without a token came too fast, which they do not know."""


@dataclass(frozen=True, slots=True)
class Answers:
    """How often each status was answered, to how many operations of the document; what was wrong, each once."""

    statuses: Counter[int]
    operations: int
    faults: tuple[str, ...]


def send_requests(server: RunningServer, folder: Path, examples: int, seed: int) -> Answers:
    """Send systematic requests, and up to a number of random ones for each operation of the document."""
    report = folder / "requests.ndjson"
    command = (
        *(sys.executable, "-m", "schemathesis.cli", "--config-file", str(CHECKS)),
        *("run", f"{server.url}/openapi.json", "--header", f"Authorization: Bearer {server.token}"),
        *("--phases", "coverage,fuzzing", "--max-examples", str(examples), "--seed", str(seed)),
        *("--continue-on-failure", "--no-shrink", "--suppress-health-check", "all", "--warnings", "off"),
        *("--report", "ndjson", "--report-ndjson-path", str(report)),
    )
    environment = {
        **os.environ,
        "SCHEMATHESIS_HOOKS": "random_requests.hooks",
        "SKILLC_TEST_LIBRARY": server.folder.name,
        "SKILLC_TEST_OPERATION": server.submit(task="carry_all", step=True)["id"],
        "PYTHONPATH": os.pathsep.join(filter(None, sys.path)),
    }
    ended = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)
    assert ended.returncode in (0, 1), ended.stdout + ended.stderr
    return _read_report(report)


def _read_report(report: Path) -> Answers:
    statuses, operations, faults = Counter[int](), set[str](), dict[str, None]()
    for scenario in _read_scenarios(report):
        operations.add(scenario["label"])
        for each in scenario["interactions"].values():
            statuses[each["response"]["status_code"] if each["response"] else 0] += 1
        faults |= dict.fromkeys(_find_faults(scenario))
    return Answers(statuses, len(operations), tuple(faults))


def _read_scenarios(report: Path) -> Iterator[dict[str, Any]]:
    with report.open("rb") as lines:
        for line in lines:
            event = msgspec.json.decode(line)
            if "ScenarioFinished" in event:
                yield event["ScenarioFinished"]["recorder"]
            elif "FatalError" in event or ("NonFatalError" in event and not _is_misread(event["NonFatalError"])):
                raise AssertionError(line.decode())


def _is_misread(error: dict[str, Any]) -> bool:
    """Whether Schemathesis cannot read a schema of an answer: it takes arrays with `prefixItems` for invalid ones.

    That they are valid is tested without it.
    """
    return bool(error["value"]["type"] == "InvalidSchema")


def _find_faults(scenario: dict[str, Any]) -> Iterator[str]:
    """Yield the checks that do not hold. Requests without a valid token are limited, which is no fault."""
    for checks in scenario["checks"].values():
        for each in checks:
            if each["status"] == "failure":
                failure = each["failure_info"]["failure"]
                if not any(limited in failure["message"] for limited in LIMITED):
                    yield f"{scenario['label']}: {failure['title']}: {failure['message']}"
