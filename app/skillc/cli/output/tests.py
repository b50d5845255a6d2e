"""Runs tests, and prints how they went."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from time import perf_counter
from typing import NoReturn

import click
import msgspec

from skillc.cli.console import Terminal, has_colours, page_of, page_width, print_json, print_lines, print_remark
from skillc.cli.layout import TableCell
from skillc.errors import DiagnosticsError, RequestError
from skillc.services.check.watching import list_folders, watch_folders
from skillc.services.reporting.files import writing_to
from skillc.services.reporting.reporter import find_texts, format_count
from skillc.services.testing.coverage_report import CoverageReport, format_lines, report_coverage
from skillc.services.testing.junit import format_junit
from skillc.services.testing.suite import TestResult, TestSuite, find_suites, run_suite
from skillc_dsl.rendering.full import render
from skillc_dsl.rendering.json import to_data


def run_and_print(wanted: Sequence[str], with_coverage: bool, junit: Path | None, as_json: bool) -> int:
    """Run the tests that are wanted, and print how each went; return the exit code."""
    return _run(find_suites(wanted), with_coverage, junit, as_json)


def watch_and_print(wanted: Sequence[str], with_coverage: bool, junit: Path | None) -> NoReturn:
    """Run the tests that are wanted after each change of a file, for ever."""

    def again() -> tuple[Path, ...]:
        try:
            suites = find_suites(wanted)
        except DiagnosticsError as error:
            Terminal().show(error.diagnostics, error.texts)
            return ()
        except RequestError as error:
            Terminal().say(f"error: {error}")
            return ()
        _run(suites, with_coverage, junit, as_json=False)
        return list_folders([each.files for each in suites])

    first = list_folders([each.files for each in find_suites(wanted)])
    watch_folders(first, again, Terminal())


def _run(suites: Sequence[TestSuite], with_coverage: bool, junit: Path | None, as_json: bool) -> int:
    began, results, reports = perf_counter(), list[TestResult](), list[CoverageReport]()
    longest = max(len(test.name) for suite in suites for test in suite.tests)
    for suite in suites:
        coverage = suite.new_coverage()
        results += run_suite(suite, coverage, lambda each: None if as_json else _print_result(each, longest))
        reports.append(report_coverage(suite, coverage))
    if junit is not None:
        with writing_to(junit):
            junit.write_text(format_junit(results), encoding="utf-8")
    failed = sum(each.status == "failed" for each in results)
    if as_json:
        print_json(_to_data(results, reports))
    elif with_coverage:
        for report in reports:
            _print_coverage(report)
    count, seconds = format_count(len(results), "test"), perf_counter() - began
    print_remark(f"{count}, {f'{failed} failed' if failed else 'all passed'}, in {seconds:.2f} s")
    return 1 if failed else 0


def _print_result(result: TestResult, longest: int) -> None:
    page, passed = page_of(sys.stdout), result.status == "passed"
    status = page.paint(result.status, "good" if passed else "bad")
    print_lines([f"{status}  {result.name:{longest}}  {result.cell_s:.1f} s"])
    if result.problems:
        texts = find_texts(result.problems, {})
        text = render(result.problems, texts, colour=has_colours(sys.stdout), width=page_width(sys.stdout))
        click.echo(text, nl=False, color=True)


def _print_coverage(report: CoverageReport) -> None:
    page = page_of(sys.stdout)
    counts = ", ".join(f"{name} {each.covered} of {each.total}" for name, each in report.counts.items())
    print_lines(["", f"{page.paint(report.library, 'strong')}: {counts}"])
    rows = [(TableCell(file, "name"), f"not run: {format_lines(lines)}") for file, lines in report.uncovered.items()]
    rows += [(TableCell(file, "name"), f"one way only: {format_lines(lines)}") for file, lines in report.half.items()]
    print_lines(page.columns(rows) if rows else ["everything is covered"])


def _to_data(results: Sequence[TestResult], reports: Sequence[CoverageReport]) -> dict[str, object]:
    failed = sum(each.status == "failed" for each in results)
    tests = [
        {**msgspec.structs.asdict(each), "problems": [to_data(problem) for problem in each.problems]}
        for each in results
    ]
    return {
        "passed": len(results) - failed,
        "failed": failed,
        "tests": tests,
        "coverage": [msgspec.to_builtins(each) for each in reports],
    }
