"""Try ontologies of others as they are published, from a local checkout, and print a table of what becomes of them."""

from __future__ import annotations

import argparse
import sys
import tempfile
import tomllib
from pathlib import Path

from originals.case import Row, run_case

HEAD = "| ontology | triples | CPU, s | warnings | used | scenes loaded | round trips |\n|---|---|---|---|---|---|---|"


def main() -> int:
    """Return 1 if something failed, 2 if no ontology is there."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, help="the folder with the ontologies, in any folders below it")
    parser.add_argument("--only", default="", help="a part of the names of the cases to try")
    chosen = parser.parse_args()
    cases = tomllib.loads((Path(__file__).parent / "cases.toml").read_text("utf-8"))["case"]
    rows: list[Row] = []
    print(HEAD, flush=True)
    for case in cases:
        if chosen.only.lower() not in case["name"].lower():
            continue
        with tempfile.TemporaryDirectory() as work:
            row = run_case(case, chosen.folder.resolve(), Path(work).resolve())
        if row is None:
            print(f"| {case['name']} | not in {chosen.folder} | | | | | |", flush=True)
            continue
        rows.append(row)
        print(_line(row), flush=True)
    for row in rows:
        for failure in row.failures:
            print(f"\n{row.name}: {failure}")
    return 2 if not rows else int(any(row.failures for row in rows))


def _line(row: Row) -> str:
    scenes = f"{row.loaded} of {row.scenes}" if row.scenes else ""
    return (
        f"| {row.name} | {row.triples} | {row.seconds:.1f} | {row.warnings} | {row.used} | {scenes} | {row.unharmed} |"
    )


if __name__ == "__main__":
    sys.exit(main())
