"""Skillc with a decorator and a flag more: each is a few lines in as many files, which are edited as they are imported.

`python additions.py FOLDER` runs commands on the library in a folder, and prints as JSON what they print and write.
"""

from __future__ import annotations

import importlib.abc
import importlib.util
import json
import sys
from collections.abc import Mapping, Sequence
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from pathlib import Path
from types import CodeType, ModuleType

Edits = Mapping[str, Sequence[tuple[str, str]]]
"""The lines that are put before a text of a module, by its name."""

ROW = """\
    Decorator(
        Word("linger"),
        "linger 2 s { .. }",
        "after a success goes on for a time",
        Ticks("the child", "the child, then whether the time is over", "", "as the child"),
        Picture("time", "…"),
        tree_cpp_doc="Stays running for a time after its child has succeeded.",
        slots=(Slot("time", "seconds", "msec"),),
    ),
"""
STRUCT = '''\
class Linger(msgspec.Struct, frozen=True, tag="linger"):
    """Runs the child, and goes on for `seconds` after it has succeeded."""

    seconds: Expression
    child: Node
    source: Position


'''
RULE = """\
def _explore_linger(run, node, states, context):
    ends = _explore_results(run, node, node.written, states, context)
    later = {havoc_concurrent(run, state, context): path for state, path in ends.success.items()}
    return EndStates(later, ends.failure, ends.broken)


"""
TICK = """\
class LingerNode(TimeoutNode):
    kind = "linger"

    def on_start(self):
        self._deadline = None
        return self.on_child_ended(self.child.start())

    def active_leaf(self):
        return self.child.active_leaf() if self._deadline is None else self

    def tick(self):
        return self.succeed() if self.context.now > self._deadline else RUNNING

    def on_child_ended(self, status):
        if status is not SUCCESS:
            return RUNNING if status is RUNNING else self.fail(self.child.failure)
        self._deadline = self.context.now + evaluate_seconds(self.node.seconds, self.context, self.frame)
        self.context.expect(self._deadline + EPSILON_S)
        return RUNNING


"""
DECORATOR: Edits = {
    "skillc_dsl.descriptions.nodes": (('    Decorator(\n        Word("timeout"),', ROW),),
    "skillc_model.tree": (("class Wait(", STRUCT), ("Retry | Repeat |", "Linger | ")),
    "skillc_compiler.analysis.decorators": (
        ("Rule: TypeAlias", RULE),
        ('    "once": _explore_once', '    "linger": _explore_linger,\n'),
        ("from skillc_compiler.analysis.loops", "from skillc_compiler.analysis.exploration import havoc_concurrent\n"),
    ),
    "skillc_runtime.execution.tree.nodes.decorators": (
        ("DECORATORS: Mapping", TICK),
        ("    tree.Try: TryNode", "    tree.Linger: LingerNode,\n"),
    ),
}
"""What is edited for a decorator, besides its test."""

FLAG: Edits = {
    "skillc_dsl.descriptions.members": (
        (
            '    Flag(\n        "endless"',
            '    Flag("gentle", "the skill does not hurt", "Does not hurt.", "gentle"),\n',
        ),
    ),
    "skillc_model.skills": (("    endless: bool", "    gentle: bool = False\n"),),
}
"""What is edited for a flag, besides what reads it and its test."""


class EditedFile(SourceFileLoader):
    """Loads a module with lines more, and leaves no trace of it."""

    def __init__(self, name: str, path: str, edits: Sequence[tuple[str, str]]) -> None:
        super().__init__(name, path)
        self.edits = edits

    def get_code(self, fullname: str) -> CodeType:
        """Return the code of the text with the lines."""
        text = Path(self.path).read_text("utf-8")
        for before, lines in self.edits:
            assert text.count(before) == 1, (fullname, before)
            text = text.replace(before, lines + before)
        return compile(text, self.path, "exec")


class Edited(importlib.abc.MetaPathFinder):
    """Finds the modules that are edited."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return how an edited module is loaded, None for others."""
        edits = (DECORATOR | FLAG).get(fullname)  # type: ignore[operator]
        found = PathFinder.find_spec(fullname, path) if edits else None
        if edits is None or found is None or found.origin is None:
            return None
        return importlib.util.spec_from_loader(fullname, EditedFile(fullname, found.origin, edits))


def main(folder: Path) -> None:
    """Run the commands, and print what comes of them."""
    sys.meta_path.insert(0, Edited())
    from click.testing import CliRunner

    from skillc.cli.main import skillc
    from skillc_dsl.highlighting import SkillLexer

    told = {}
    for command in ("fmt --check .", "check .", "compile . -o build", "graph . Stay --format text", "test ."):
        done = CliRunner().invoke(skillc, command.split(), catch_exceptions=False)
        told[command.split()[0]] = {"code": done.exit_code, "out": done.stdout, "err": done.stderr}
    text = (folder / "stay.skill").read_text("utf-8")
    coloured = [(token, str(kind)) for _, kind, token in SkillLexer().get_tokens_unprocessed(text)]
    sys.stdout.write(json.dumps({"commands": told, "colours": dict(coloured)}))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
