"""One slip anywhere in a shipped file is one error at its place, and leaves the rest understood.

`SKILLC_MUTATIONS=5000` tries so many slips.
"""

import os
from pathlib import Path

from mutations import is_grammatical, mutation

from skillc_dsl.parsing.parser import parse
from skillc_dsl.source import Source

ROOT = Path(__file__).parents[2]
TEXTS = [path.read_text(encoding="utf-8") for path in sorted((ROOT / "skills_src").rglob("*.skill"))]
COUNT = int(os.environ.get("SKILLC_MUTATIONS", "80"))
FIVE_FAULTS = """\
use skiros, rparts skillc
import "motion.skill"

## Come near.
skill Near {
    in   arm ArmDevice
    opt  pace:  Number = 0.5
    opt  speed: Speed  = 0.1 metres
    pre  arm hasA
    uses arm
    noplan
}

impl slowly of Near {
    do seq {
        TakePosture(arm
        wait 200 ms
    }
}

skill Far {
    in   arm: ArmDevice
    noplan
}
"""


def test_a_slip_is_one_error_at_its_place() -> None:
    broken, alone, strayed = 0, 0, []
    for seed in range(COUNT):
        slip = mutation(TEXTS[seed % len(TEXTS)], seed)
        errors = [problem for problem in parse(Source("", slip.text)).diagnostics if problem.severity == "error"]
        if is_grammatical(slip.text):
            continue
        broken += 1
        alone += len(errors) == 1
        if not any(abs(error.span.line - line) <= 1 for error in errors for line in slip.lines):
            strayed.append((seed, slip.told, [(error.span.line, error.message) for error in errors]))
    assert strayed == []
    assert broken > COUNT // 2
    assert alone >= 0.97 * broken


def test_most_declarations_survive_a_slip() -> None:
    whole = {text: len(parse(Source("", text)).value.declarations) for text in TEXTS}
    lost = [
        whole[text] - len(parse(Source("", mutation(text, seed).text)).value.declarations)
        for seed, text in enumerate((COUNT // 5 // len(TEXTS) + 1) * TEXTS)
    ]
    assert len(lost) >= COUNT // 5
    assert max(lost) <= 2
    assert sum(lost) <= 0.25 * len(lost)


def test_five_faults_are_five_errors_and_the_rest_is_understood() -> None:
    outcome = parse(Source("", FIVE_FAULTS))
    assert [(d.span.line, d.name) for d in outcome.diagnostics] == [
        (1, "syntax"),
        (6, "syntax"),
        (8, "unknown-unit"),
        (9, "syntax"),
        (16, "syntax"),
    ]
    assert [declaration.name.text for declaration in outcome.value.declarations] == ["Near", "slowly", "Far"]
