"""Runs the test above which a lens stands, for editors that have no terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from pygls.exceptions import JsonRpcInvalidParams

from skillc.errors import DiagnosticsError, RequestError
from skillc.extras import naming_extras
from skillc.lsp.session import Session
from skillc.services.library.files import LibraryFiles, find_library
from skillc_dsl.diagnostics import Diagnostic

if TYPE_CHECKING:
    from skillc.services.testing.suite import TestResult

METHOD = "skillc/runTest"


class RunTestParams(Protocol):
    """The parameters of the request: `name` is that of a test in the file `textDocument`."""

    @property
    def textDocument(self) -> TextDocument:  # noqa: N802 - as it is called in the protocol
        """The file."""
        ...

    @property
    def name(self) -> str:
        """The name of the test."""
        ...


class TextDocument(Protocol):
    """A file, as the editor names it."""

    @property
    def uri(self) -> str:
        """The address of the file."""
        ...


def run_test(session: Session, params: RunTestParams) -> dict[str, object]:
    """Run a test of the texts that are open in the editor: whether it passed, and a sentence on each problem.

    JsonRpcInvalidParams if there is no such test, the library has errors, or an extra is missing that tests need.
    """
    file = session.libraries.file(params.textDocument.uri)
    try:
        with naming_extras():
            from skillc.services.testing.suite import SuiteRunner, read_suite
        suite = read_suite(_with_open_texts(session, find_library(file.parent)), file)
    except DiagnosticsError as error:
        first = error.diagnostics[0]
        raise JsonRpcInvalidParams(f"the library has errors; the first is in {_describe(first)}") from error
    except RequestError as error:
        raise JsonRpcInvalidParams(str(error)) from error
    test = next((each for each in suite.tests if each.name == params.name), None)
    if test is None:
        raise JsonRpcInvalidParams(f"there is no test `{params.name}`")
    result = SuiteRunner(suite, suite.new_coverage()).run(test)
    return {"passed": result.status == "passed", "said": _summarise(result)}


def _with_open_texts(session: Session, files: LibraryFiles) -> LibraryFiles:
    """Return a library with the texts of the editor in place of those on disk."""
    opened = session.libraries.buffers
    texts = ((each, opened.get(files.places[each.path])) for each in files.sources)
    sources = (each if text is None else each._replace(text=text) for each, text in texts)
    return files._replace(sources=tuple(sources))


def _summarise(result: TestResult) -> str:
    """Return how long a test took in its cell, or what is not as it expects."""
    problems = [_describe(each) for each in result.problems if each.severity == "error"]
    return "; ".join(problems) or f"{result.cell_s:.1f} s in its cell"


def _describe(problem: Diagnostic) -> str:
    return f"line {problem.span.line}: {problem.message}"
