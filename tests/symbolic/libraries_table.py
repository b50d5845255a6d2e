"""The table of the twelve libraries in their README: `PYTHONPATH=tests python -m symbolic.libraries_table` writes it.

Sizes and forms are read from the texts. Times are CPU time of the commands in one process, without its start, with
empty caches, planners included.
"""

from __future__ import annotations

import os
import re
import resource
import tempfile
from pathlib import Path

from click.testing import CliRunner

FOLDER = Path(__file__).parent.parent / "cases" / "libraries"
README = FOLDER / "README.md"
LIBRARIES = sorted(each.parent.name for each in FOLDER.glob("*/skillc.toml"))
BY_HAND = {
    "assays": "spin_by_hand",
    "bakehouse": "bake_by_hand",
    "disassembly": "open_by_hand",
    "lending": "return_one",
    "lifts": "ride_by_hand",
    "luggage": "process_one",
    "orchard": "treat_two",
    "parking": "relocate_by_hand",
    "sterilisation": "reprocess_one",
    "swapping": "tour_by_hand",
    "tending": "machine_one",
    "wards": "meals_by_hand",
}
"""The task with a body of each."""
FORMS = {
    "enum": r"^enum ",
    "defined relation": r"^relation .* =",
    "effects on many": r"^    post .*forall ",
    "changed numbers": r"^    post .*( -= | \+= | := )",
    "counts and sums": r"\b(count|sum|min|max|mean)\(",
    "loop over a set": r"\bfor \w+: \w+ where ",
    "loop over a list": r"\bfor \w+ in ",
    "outcomes": r"^    outcome ",
    "hold": r"^    hold ",
    "with": r"\bwith \w+\(",
    "par": r"\bpar \w+ \{",
    "retry": r"\bretry ",
    "timeout": r"\btimeout ",
    "on failure": r"\} on failure ",
    "finally": r"\} finally ",
    "texts with values": r'\bfail ".*\{',
    "verify": r"^    verify ",
}
"""Forms, and where a text has one."""
HEAD = "| library | field | lines | forms | check, ms | plan, ms | run, ms |"


def describe(name: str) -> str:
    """Return the first cells of the row of a library: its name, field, lines and forms."""
    text = (FOLDER / name / f"{name}.skill").read_text("utf-8")
    field = text.splitlines()[0].removeprefix("# ").partition(":")[0]
    forms = [form for form, pattern in FORMS.items() if re.search(pattern, text, re.MULTILINE)]
    return f"| [{name}]({name}/{name}.skill) | {field} | {text.count(chr(10))} | {', '.join(forms)} |"


def main() -> None:
    """Measure all libraries, and write the table into the README."""
    _measure(LIBRARIES[-1])
    rows = ["".join((describe(each), *(f" {ms} |" for ms in _measure(each)))) for each in LIBRARIES]
    before, _, rest = README.read_text("utf-8").partition(HEAD)
    after = rest[rest.index("\n\n") :] if "\n\n" in rest else "\n"
    README.write_text("\n".join((f"{before}{HEAD}", "|---|---|---|---|---|---|---|", *rows)) + after, "utf-8")


def _measure(name: str) -> list[int]:
    """Return the CPU time in ms of a check, of planning the task with a goal, and of running the one with a body."""
    os.chdir(FOLDER / name)
    commands = (("check", "."), ("plan", "--no-plan-cache", "--deadline", "300"), ("run", BY_HAND[name], "--seed", "1"))
    with tempfile.TemporaryDirectory() as cache:
        os.environ["SKILLC_CACHE"] = cache
        return [_take(each) for each in commands]


def _take(command: tuple[str, ...]) -> int:
    from skillc.cli.main import skillc

    begun = _spent_s()
    result = CliRunner().invoke(skillc, command)
    assert result.exit_code == 0, result.output
    return round(1000 * (_spent_s() - begun))


def _spent_s() -> float:
    kinds = (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    return sum(used.ru_utime + used.ru_stime for used in map(resource.getrusage, kinds))


if __name__ == "__main__":
    main()
