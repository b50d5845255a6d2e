"""Results of tests as JUnit XML, which servers of continuous integration show."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from skillc.services.testing.suite import TestResult
from skillc_dsl.diagnostics import Diagnostic


def format_junit(results: Sequence[TestResult]) -> str:
    """Return the results as JUnit XML, a suite for each library."""
    root = Element("testsuites", _totals(results) | {"name": "skillc"})
    for library, of_library in groupby(results, key=lambda each: each.library):
        members = list(of_library)
        suite = SubElement(root, "testsuite", {"name": library} | _totals(members))
        for each in members:
            suite.append(_case(each))
    indent(root)
    return tostring(root, encoding="unicode", xml_declaration=True) + "\n"


def _totals(results: Sequence[TestResult]) -> dict[str, str]:
    failed = sum(each.status == "failed" for each in results)
    seconds = sum(each.wall_s for each in results)
    return {"tests": str(len(results)), "failures": str(failed), "errors": "0", "time": f"{seconds:.3f}"}


def _case(result: TestResult) -> Element:
    case = Element(
        "testcase",
        {
            "classname": result.library,
            "name": result.name,
            "file": result.file,
            "line": str(result.line),
            "time": f"{result.wall_s:.3f}",
        },
    )
    for problem in result.problems:
        failure = SubElement(case, "failure", {"type": problem.name, "message": problem.message})
        failure.text = describe_problem(problem)
    return case


def describe_problem(problem: Diagnostic) -> str:
    """Return a problem as lines of text: where it is, what it is, and the path that led there."""
    span = problem.span
    lines = [f"{span.path}:{span.line}: {problem.message}", *([problem.help] if problem.help else [])]
    lines += (f"  {each.span.path}:{each.span.line}: {each.message}" for each in problem.labels)
    return "\n".join(lines)
