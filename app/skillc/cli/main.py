"""The `skillc` command: finds its commands in their folder and imports only the one that runs."""

from __future__ import annotations

import ast
import gc
import importlib
import os
import signal
import sys
from pathlib import Path
from typing import Any

import click

from skillc.cli import streams
from skillc.cli.command import Group
from skillc.cli.console import print_error
from skillc.cli.interrupts import Interrupted, raising_on_signals
from skillc.cli.options import WITH_ONTOLOGY, add_ontology_option
from skillc.errors import DiagnosticsError, OutputError, ServiceError
from skillc.services.project.loading import find_project
from skillc.services.reporting import crash_reports
from skillc_runtime.platforms.python_modules import defer_import


def print_click_error(error: click.ClickException) -> None:
    """Print an error to stderr; one in the options of a command with the usage of that."""
    context = getattr(error, "ctx", None)
    if context is None:
        print_error(_format_message(error))
        return
    with context.scope(cleanup=False):
        print_error(_format_message(error))
    click.echo(f"\n{context.get_usage()}\nFor more information, try `{context.command_path} --help`.", err=True)


def _format_message(error: click.ClickException) -> str:
    """Return the message of an error without capital letter and full stop, as all messages of skillc are written."""
    if isinstance(error, click.NoSuchOption):
        renamed = _find_renamed(error)
        near = f"did you mean `{error.possibilities[0]}`?" if error.possibilities else ""
        hint = f"it is called `{renamed}` now" if renamed else near
        return f"there is no option `{error.option_name}`{hint and f'; {hint}'}"
    text = error.format_message().removesuffix(".")
    return text[:1].lower() + text[1:] if text[1:2].islower() else text


def _find_renamed(error: click.NoSuchOption) -> str | None:
    """Return how an option of earlier versions is called now, if the command has it."""
    from skillc_runtime.recording.run_spec import RENAMED

    word = RENAMED.get(error.option_name.lstrip("-").replace("-", "_"), "").replace("_", "-")
    known = error.ctx.command.get_params(error.ctx) if error.ctx is not None else []
    return next((option for each in known for option in each.opts if word and option == f"--{word}"), None)


WITH_DEFAULTS = ("run", "plan", "trials")
"""The commands that have a table of defaults."""


def read_defaults(command: str) -> dict[str, Any]:
    """Return the defaults of a command's options by parameter; exit with 1 if the manifest has errors.

    What a task says comes before what its project says: the back end, what is minimised, and the deadline of
    a run, are none of them.
    """
    try:
        project = find_project(Path())
    except DiagnosticsError as error:
        from skillc.cli.console import Terminal

        Terminal().show(error.diagnostics, error.texts)
        sys.exit(error.exit_code)
    except ServiceError as error:
        raise click.UsageError(str(error)) from error
    if project is None:
        return {}
    import msgspec

    settings = msgspec.structs.asdict(getattr(project.manifest.tool, command))
    of_task = {"backend", "minimise", *(("deadline",) if command == "run" else ())}
    set_ones = {name: value for name, value in settings.items() if value is not None and name not in of_task}
    return {name: str(project.root / value) if name == "out" else value for name, value in set_ones.items()}


COMMANDS = Path(__file__).parent / "commands"
GARBAGE = 50_000
"""How many objects more than were deleted are made before new garbage is looked for."""
INTERNAL = 70
"""EX_SOFTWARE of sysexits.h."""
VARIABLE = "_SKILLC_COMPLETE"
"""The variable of the environment in which a shell says what it wants to complete."""
BROKEN_PIPE = 141
"""The exit code that shells give to a process ended by SIGPIPE."""

SECTIONS = {
    "Projects": ("new", "add", "import", "tasks", "lock"),
    "Skills": ("check", "test", "fix", "fmt", "explain", "graph", "doc", "compile", "shapes", "ontology"),
    "Tasks": ("plan", "run", "why", "diff", "replay", "report", "trials", "learn", "demo"),
    "Scenes": ("world", "scene", "look", "connect"),
    "Servers": (
        "studio",
        "serve",
        "ps",
        "start",
        "orders",
        "queue",
        "rehearse",
        "jobs",
        "attach",
        "logs",
        "pace",
        "cell",
        "lease",
        "answer",
        "acknowledge",
        "token",
        "state",
    ),
    "Operations of a server": (
        "wait",
        "pause",
        "resume",
        "step",
        "stop",
        "breakpoints",
        "approve",
        "retry",
        "skip",
        "replan",
    ),
    "Tools": ("doctor", "schema", "completion", "lsp"),
}
"""The sections of the help, with their commands in the order in which they are listed."""


class Commands(Group):
    """A group whose commands are the modules of `commands`; each has a click command named `command`."""

    def main(self, *args: Any, **kwargs: Any) -> Any:
        """Run the command line and exit; end it if the standard output cannot be written to."""
        if VARIABLE in os.environ:
            from skillc.cli.bash_completion import use_completion

            use_completion()
        try:
            with streams.guard_streams():
                sys.exit(self._run(*args, **kwargs))
        except OutputError as error:
            if isinstance(error.reason, BrokenPipeError):
                sys.exit(BROKEN_PIPE)
            print_error(str(error))
            sys.exit(1)

    def _run(self, *args: Any, **kwargs: Any) -> Any:
        """Run the command line; return the exit code."""
        try:
            return super().main(*args, **{**kwargs, "standalone_mode": False})
        except click.ClickException as error:
            print_click_error(error)
            return error.exit_code

    def invoke(self, ctx: click.Context) -> Any:
        """Run the command; an internal error becomes one message and a crash report."""
        try:
            with raising_on_signals():
                return super().invoke(ctx)
        except (click.ClickException, click.exceptions.Exit, click.Abort, OutputError):
            raise
        except KeyboardInterrupt as error:
            interrupted = error if isinstance(error, Interrupted) else Interrupted(signal.SIGINT)
            click.echo(interrupted, err=True)
            sys.exit(interrupted.exit_code)
        except Exception as error:  # noqa: BLE001 - the boundary of the process
            click.echo(crash_reports.write_report(error, sys.argv[1:]), err=True)
            sys.exit(INTERNAL)

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names of all commands, without importing them."""
        return sorted(file.stem for file in COMMANDS.glob("[!_]*.py"))

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Import one command; None for an unknown name. MuJoCo imports what opens windows, which no command does."""
        if cmd_name not in self.list_commands(ctx):
            return None
        defer_import("glfw")
        command: click.Command = importlib.import_module(f"skillc.cli.commands.{cmd_name}").command
        return add_ontology_option(command) if cmd_name in WITH_ONTOLOGY else command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command, with the defaults that the project here sets for it."""
        found = super().resolve_command(ctx, args)
        if args[0] in WITH_DEFAULTS:
            ctx.default_map = {args[0]: read_defaults(args[0])}
        return found

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """List the commands in sections, with the first line of each module, read without importing it."""
        left = [name for name in self.list_commands(ctx) if not any(name in names for names in SECTIONS.values())]
        widest = max(map(len, self.list_commands(ctx)))
        for title, names in {**SECTIONS, "Other commands": tuple(left)}.items():
            if names:
                with formatter.section(title):
                    rows = [(f"{name:{widest}}", _first_line(COMMANDS / f"{name}.py")) for name in names]
                    formatter.write_dl(rows)


def _first_line(path: Path) -> str:
    docstring = ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or ""
    return docstring.partition("\n")[0]


@click.command(cls=Commands, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(package_name="skillc", message="skillc %(version)s")
def skillc() -> None:
    """A compiler and runtime for robot skills.

    `skillc new NAME` creates a project, `skillc COMMAND --help` describes a command.

    Exit codes: 0 success, 1 errors in the input, 2 wrong command line, 3 task failed or no plan, 70 internal error,
    130 interrupted (143 by SIGTERM, 129 by SIGHUP), 141 output closed.
    """


def main(arguments: list[str] | None = None) -> Any:
    """Run the command line; garbage is looked for seldom, since most of what a command makes stays until its end."""
    gc.set_threshold(GARBAGE)
    return skillc(arguments)
