"""The contents of `skillc.toml`, read with a place for each problem."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any, Literal

import msgspec

from skillc.services.project.toml_places import TomlPlaces
from skillc.services.project.toml_text import load_toml
from skillc_dsl.diagnostics import Diagnostic, Fix, Outcome
from skillc_dsl.editions import EDITIONS, FIRST, NEWEST
from skillc_dsl.source import Source, Span
from skillc_dsl.spelling import did_you_mean
from skillc_runtime.recording.run_spec import RENAMED

NAME = re.compile(r"[a-z][a-z0-9]*(_[a-z0-9]+)*")
_NAMESPACE = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*:[^\s<>\"{}|\\^`]*[#/]")
_SYNTAX = re.compile(r"(?P<what>.*?) \(at (?:line (?P<line>\d+), column (?P<column>\d+)|end of document)\)", re.DOTALL)
_TYPE = re.compile(r"(?P<what>.*?)(?: - at `\$(?P<where>[^`]*)`)?", re.DOTALL)
_WORDS = {
    "`str`": "a text",
    "`int`": "a whole number",
    "`float`": "a number",
    "`bool`": "true or false",
    "`array`": "a list",
    "`object`": "a table",
    "`null`": "nothing",
}


class Settings(msgspec.Struct, frozen=True, forbid_unknown_fields=True, rename="kebab"):
    """Defaults of the options of a command; None leaves an option as it is."""


class RunSettings(Settings, frozen=True):
    """Defaults of the options of `skillc run`; `out` is relative to the project."""

    out: str | None = None
    seed: int | None = None
    backend: str | None = None
    pace: str | None = None
    deadline: float | None = None
    tick_timeout: float | None = None
    looks: str | None = None
    minimise: Literal["work", "makespan", "cost"] | None = None
    strict: bool | None = None


class PlanSettings(Settings, frozen=True):
    """Defaults of the options of `skillc plan`."""

    deadline: float | None = None
    minimise: Literal["work", "makespan", "cost"] | None = None
    prove: bool | None = None


class TrialSettings(Settings, frozen=True):
    """Defaults of the options of `skillc trials`; `out` is relative to the project."""

    number: int | None = None
    seed: int | None = None
    jobs: int | None = None
    deadline: float | None = None
    out: str | None = None


class ToolSettings(Settings, frozen=True):
    """The tables `[tool.run]`, `[tool.plan]` and `[tool.trials]`."""

    run: RunSettings = RunSettings()
    plan: PlanSettings = PlanSettings()
    trials: TrialSettings = TrialSettings()


class Dependency(Settings, frozen=True):
    """Where another library is: in a folder, an installed package, or at an entry point of `skillc.libraries`."""

    path: str | None = None
    package: str | None = None
    entry_point: str | None = None


class NamedGoal(Settings, frozen=True):
    """A task that is a goal or a call of a skill, in a scene (by default that of the project)."""

    goal: str | None = None
    call: str | None = None
    scene: str | None = None


class Manifest(Settings, frozen=True, kw_only=True):
    """The contents of `skillc.toml`. `scene` and `task` are used where none is named.

    `edition` is that of the language in which the library is written.
    `imports` has the files of imported ontologies by their IRIs, relative to the project.
    """

    name: str
    version: str = "0.0.0"
    edition: int = FIRST
    namespace: str | None = None
    scene: str | None = None
    task: str | None = None
    ontology: tuple[str, ...] = ()
    imports: dict[str, str] = {}
    dependencies: dict[str, Dependency] = {}
    tasks: dict[str, NamedGoal] = {}
    tool: ToolSettings = ToolSettings()


def read_manifest(source: Source) -> Outcome[Manifest | None]:
    """Read the text of a `skillc.toml`; None, with diagnostics, if it has errors."""
    try:
        content = load_toml(source.text)
    except ValueError as error:
        return Outcome(None, (_broken(source, str(error)),))
    places = TomlPlaces(source)
    problems = [*_unknown_keys(content, Manifest, (), places), *_wrong_types(content, places)]
    if problems:
        return Outcome(None, tuple(problems))
    manifest = msgspec.convert(content, Manifest)
    problems = list(_wrong_values(manifest, places))
    return Outcome(None if problems else manifest, tuple(problems))


def _broken(source: Source, message: str) -> Diagnostic:
    """Return the diagnostic of a text that is not TOML."""
    match = _SYNTAX.fullmatch(message)
    lines = source.text.split("\n")
    line = int(match["line"]) if match and match["line"] else len(lines)
    column = int(match["column"]) if match and match["column"] else max(len(lines[line - 1]), 1)
    what = match["what"] if match else message
    span = Span(source.path, line, column, line, column + 1)
    return Diagnostic("broken-manifest", span, f"this is not TOML: {what[:1].lower()}{what[1:]}")


def _unknown_keys(
    content: Mapping[str, Any], cls: type[msgspec.Struct], above: tuple[str, ...], places: TomlPlaces
) -> Iterator[Diagnostic]:
    """Yield a diagnostic for each key of a table that its struct does not have, and of the tables in it."""
    known = {field.encode_name: field.type for field in msgspec.structs.fields(cls)}
    for key, value in content.items():
        where = (*above, key)
        if key not in known:
            yield _unknown(key, tuple(known), above, places.find(where))
            continue
        inner = _struct_of(known[key])
        if inner is None or not isinstance(value, Mapping):
            continue
        tables = value.items() if known[key] not in (inner, None) else ((None, value),)
        for name, table in tables:
            if isinstance(table, Mapping):
                yield from _unknown_keys(table, inner, where if name is None else (*where, name), places)


def _struct_of(type_: Any) -> type[msgspec.Struct] | None:
    """Return the struct that a field is, or that a table of names has as values."""
    for each in (type_, *getattr(type_, "__args__", ())):
        if isinstance(each, type) and issubclass(each, msgspec.Struct):
            return each
    return None


def _unknown(key: str, known: tuple[str, ...], above: tuple[str, ...], span: Span) -> Diagnostic:
    inside = f"`[{'.'.join(above)}]`" if above else "`skillc.toml`"
    hint = did_you_mean(key, known)
    near = hint.removeprefix("did you mean `").removesuffix("`?")
    if (renamed := RENAMED.get(key)) in known:
        near, hint = renamed, f"it is called `{renamed}` now"
    fix = Fix(span, near, f"write `{near}`", safe=False) if near in known else None
    return Diagnostic("unknown-key", span, f"there is no key `{key}` in {inside}", hint, fix=fix)


def _wrong_types(content: Mapping[str, Any], places: TomlPlaces) -> Iterator[Diagnostic]:
    """Yield the first value of a wrong type, or key that is missing."""
    known = {field.encode_name for field in msgspec.structs.fields(Manifest)}
    try:
        msgspec.convert({key: value for key, value in content.items() if key in known}, Manifest)
    except msgspec.ValidationError as error:
        match = _TYPE.fullmatch(str(error))
        assert match is not None, error
        if "unknown field" in match["what"]:
            return
        where = (match["where"] or "").replace("[...]", ".*")
        keys = _with_names(tuple(part for part in re.split(r"[.\[\]]+", where) if part), content)
        what = match["what"].replace(" | null`", "`")
        for type_, word in _WORDS.items():
            what = what.replace(type_, word)
        if what.startswith("Object missing required field"):
            what = f"{what.rpartition(' ')[2]} is missing"
        name = f"`{'.'.join(keys)}`: " if keys else ""
        yield Diagnostic("wrong-setting", places.find(keys), f"{name}{what[:1].lower()}{what[1:]}")


def _with_names(keys: tuple[str, ...], content: Mapping[str, Any]) -> tuple[str, ...]:
    """Replace the `*` that stands for any key of a table by the key whose value is wrong."""
    if len(keys) < 2 or keys[1] != "*":
        return keys
    cls = {"dependencies": Dependency, "tasks": NamedGoal}[keys[0]]
    for name, value in content[keys[0]].items():
        try:
            msgspec.convert(value, cls)
        except msgspec.ValidationError:
            return (keys[0], name, *keys[2:])
    return keys[:1]


def _wrong_values(manifest: Manifest, places: TomlPlaces) -> Iterator[Diagnostic]:
    """Yield the values that have the right type, and yet cannot be."""
    if not NAME.fullmatch(manifest.name):
        near = re.sub(r"[^a-z0-9]+", "_", manifest.name.lower()).strip("_0123456789")
        hint = f"write `{near}`" if NAME.fullmatch(near) else ""
        message = f"`{manifest.name}` is not a name: use a-z, 0-9 and `_`, starting with a letter"
        yield Diagnostic("wrong-setting", places.find(("name",)), message, hint)
    if manifest.edition not in EDITIONS:
        known = " and ".join(map(str, EDITIONS))
        message = f"there is no edition {manifest.edition}; there are {known}"
        help_ = f"write `edition = {NEWEST}`" if manifest.edition < NEWEST else "a newer skillc may have it"
        yield Diagnostic("wrong-setting", places.find(("edition",)), message, help_)
    if manifest.namespace is not None and not _NAMESPACE.fullmatch(manifest.namespace):
        message = f"`{manifest.namespace}` is not a namespace: it is an IRI that ends with `#` or `/`"
        yield Diagnostic("wrong-setting", places.find(("namespace",)), message)
    for name, each in manifest.dependencies.items():
        if sum(way is not None for way in (each.path, each.package, each.entry_point)) != 1:
            message = f"the dependency `{name}` needs one of `path`, `package` and `entry-point`"
            yield Diagnostic("wrong-setting", places.find(("dependencies", name)), message)
    for name, goal in manifest.tasks.items():
        if (goal.goal is None) == (goal.call is None):
            message = f"the task `{name}` needs either a `goal` or a `call`"
            yield Diagnostic("wrong-setting", places.find(("tasks", name)), message)
