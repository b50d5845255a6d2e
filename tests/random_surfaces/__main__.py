"""`python -m random_surfaces`: judges surfaces and prints a table; those in the journal are not judged again."""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Iterable
from pathlib import Path

import msgspec

from random_surfaces.drawing import ARM_NAMES
from random_surfaces.judging import Verdict, judge

LEAST = {"yes": 0.99, "no": 0.98}
"""The least share of what is said that has to be so."""


def main() -> int:
    """Judge the surfaces and print how much of what was said is so; return 1 if too little is."""
    parser = argparse.ArgumentParser(prog="random_surfaces", description=__doc__)
    parser.add_argument("--surfaces", type=int, default=200, help="how many surfaces for each arm")
    parser.add_argument("--seed", type=int, default=0, help="the seed of the first surface")
    parser.add_argument("--out", type=Path, default=Path("out/soak/surfaces"), help="where scenes and results are kept")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    journal = options.out / "verdicts.jsonl"
    lines = journal.read_bytes().splitlines() if journal.exists() else ()
    known = {(each.seed, each.arm): each for each in (msgspec.json.decode(line, type=Verdict) for line in lines)}
    wanted = [(options.seed + number, arm) for number in range(options.surfaces) for arm in ARM_NAMES]
    for seed, arm in wanted:
        if (seed, arm) not in known:
            known[seed, arm] = verdict = judge(seed, arm, options.out)
            with journal.open("ab") as file:
                file.write(msgspec.json.encode(verdict) + b"\n")
            print(f"{seed} {arm}: {verdict.said}, {verdict.is_so}: {verdict.why}", file=sys.stderr, flush=True)
    found = [known[each] for each in wanted]
    print(format_table(found))
    return int(any(share_that_is_so(found, said) < least for said, least in LEAST.items()))


def share_that_is_so(verdicts: Iterable[Verdict], said: str) -> float:
    """Return the share of what was said that is so; 1 if it was never said."""
    judged = [each.is_so for each in verdicts if each.said == said]
    return sum(map(bool, judged)) / len(judged) if judged else 1.0


def format_table(verdicts: Iterable[Verdict]) -> str:
    """Return how often what was said of each arm, and how often it is so."""
    found = Counter((each.arm, each.said, each.is_so) for each in verdicts)
    rows = [f"{'arm':8} {'said':22} {'times':>6} {'is so':>6}"]
    for arm, said in sorted({(arm, said) for arm, said, _ in found}):
        times = sum(count for (a, s, _), count in found.items() if (a, s) == (arm, said))
        shown = found[arm, said, True] if not found[arm, said, None] else "-"
        rows.append(f"{arm:8} {said:22} {times:6} {shown:>6}")
    return "\n".join(rows)


if __name__ == "__main__":
    sys.exit(main())
