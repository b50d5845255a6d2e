"""Finds waits in Python source that may never end: calls, locks and polling loops without a time limit.

A wait that ends for another reason has a comment on its line, or on the line above, that says so: `# wait ends: ..`.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass

MARK = re.compile(r"# wait ends: (\w.{10,})$")
LOCK = re.compile(r"(^|[._])lock(\(\))?$", re.IGNORECASE)
CLOCKS = ("remaining_s", "reason", "monotonic", "perf_counter")
"""What a polling loop that ends in time asks, in its condition or in its body."""


@dataclass(frozen=True, slots=True)
class Call:
    """A call: its text, the number of its arguments, whether it has a timeout, and what its file imports."""

    text: str
    count: int
    timed: bool
    imported: frozenset[str]

    def lacks(self, *texts: str) -> bool:
        """Whether none of the texts is in the call."""
        return not any(each in self.text for each in texts)


def _is_endless(_: Call) -> bool:
    return True


def _has_no_arguments(call: Call) -> bool:
    return call.count == 0 and not call.timed


def _has_no_timeout(call: Call) -> bool:
    return not call.timed and call.count < 2 and call.lacks("blocking=False")


RULES: dict[str, Callable[[Call], bool]] = {
    **dict.fromkeys(("accept", "recv", "recv_bytes", "recv_into", "serve_forever", "start_io", "waitid"), _is_endless),
    **dict.fromkeys(("join", "wait"), _has_no_arguments),
    "get": lambda call: _has_no_arguments(call) and "contextvars" not in call.imported,
    **dict.fromkeys(("HTTPConnection", "HTTPSConnection", "acquire", "communicate", "urlopen"), _has_no_timeout),
    **dict.fromkeys(("check_call", "check_output", "create_connection"), lambda call: not call.timed),
    **dict.fromkeys(("run", "call"), lambda call: call.text.startswith("subprocess.") and not call.timed),
    **dict.fromkeys(("flock", "lockf"), lambda call: call.lacks("LOCK_NB", "LOCK_UN")),
    **dict.fromkeys(("pause", "sigwait"), lambda call: call.text.startswith("signal.")),
    **dict.fromkeys(("read", "readline", "readlines"), lambda call: not call.lacks("stdin")),
    "input": lambda call: call.text.startswith("input("),
    "poll": lambda call: "select" in call.imported and _has_no_arguments(call) and not call.lacks("poller"),
    "put": lambda call: "queue" in call.imported and not call.timed and call.lacks("block=False"),
    "result": lambda call: "concurrent" in call.imported and _has_no_arguments(call),
    "select": lambda call: call.text.startswith("select.select(") and call.count < 4,
    "waitpid": lambda call: call.lacks("WNOHANG"),
    "watch": lambda call: "watchfiles" in call.imported,
}
"""Whether a call of a function or method of this name may wait for ever."""


def find_endless_waits(source: str) -> list[tuple[int, str]]:
    """Return the line and the text of each wait without a time limit, and without a comment that says why it ends."""
    lines = source.splitlines()
    return [(line, text) for line, text in _find_waits(ast.parse(source)) if not _explains(lines, line)]


def find_unneeded_marks(source: str) -> list[int]:
    """Return the lines of comments that explain a wait where there is none."""
    waits = {line for line, _ in _find_waits(ast.parse(source))}
    marks = (number for number, line in enumerate(source.splitlines(), 1) if "# wait ends" in line)
    return [mark for mark in marks if not {mark, mark + 1} & waits]


def _explains(lines: list[str], line: int) -> bool:
    return any(MARK.search(each) for each in lines[max(line - 2, 0) : line])


def _find_waits(tree: ast.Module) -> Iterator[tuple[int, str]]:
    imported = frozenset(_imported(tree))
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and _name(node) in RULES:
            timed = any(each.arg == "timeout" for each in node.keywords)
            call = Call(ast.unparse(node), len(node.args), timed, imported)
            if RULES[_name(node)](call):
                yield node.lineno, call.text
        elif isinstance(node, ast.With | ast.AsyncWith):
            texts = [(each.context_expr.lineno, ast.unparse(each.context_expr)) for each in node.items]
            yield from ((line, f"with {text}") for line, text in texts if LOCK.search(text))
        elif isinstance(node, ast.While) and _polls_for_ever(node):
            yield node.lineno, f"while {ast.unparse(node.test)}"


def _imported(tree: ast.Module) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (each.name.split(".")[0] for each in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield (node.module or "").split(".")[0]


def _name(call: ast.Call) -> str:
    match call.func:
        case ast.Attribute(attr=name) | ast.Name(id=name):
            return name
        case _:
            return ""


def _polls_for_ever(loop: ast.While) -> bool:
    """Whether a loop sleeps and never asks how much time is left."""
    text = ast.unparse(loop)
    return "sleep(" in text and not any(clock in text for clock in CLOCKS)
