"""Makes a project of a domain and a problem in PDDL."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from skillc.errors import DiagnosticsError, RequestError, ServiceError
from skillc.services.library.files import find_library
from skillc.services.library.libraries import load_vocabulary
from skillc.services.pddl_import.conditions import Writer
from skillc.services.pddl_import.declarations import TOTAL_COST, Domain, Problem, Typed
from skillc.services.pddl_import.expressions import BrokenPddl, Findings, Missing
from skillc.services.pddl_import.library_text import header, write_derived, write_skills, write_task, write_vocabulary
from skillc.services.pddl_import.names import to_individual, to_variable
from skillc.services.pddl_import.ranges import find_ranges
from skillc.services.pddl_import.reading import read_domain, read_problem
from skillc.services.pddl_import.scene_text import SceneWriter
from skillc.services.pddl_import.skills import ActionWriter
from skillc.services.pddl_import.terms import PREFIX, Defined, Form, Property, Terms, find_changed
from skillc.services.project.manifest import NAME
from skillc.services.reporting.files import inspect_path
from skillc.services.scaffolding.new_library import write_folder
from skillc_compiler import pipeline
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.editions import NEWEST
from skillc_dsl.encoding import decode
from skillc_dsl.formatting.formatter import format_source
from skillc_dsl.source import Source

SCENE = "cell.ttl"
TASKS = "tasks.skill"


@dataclass(frozen=True, slots=True)
class Imported:
    """What was written, and warnings about what the language cannot say, with the texts that they point into."""

    files: tuple[Path, ...]
    warnings: tuple[Diagnostic, ...]
    texts: dict[str, Source]


def import_pddl(domain_file: Path, problem_file: Path | None, folder: Path | None) -> Imported:
    """Write a project into a new folder, by default one that is called as the domain.

    DiagnosticsError for errors of the files; RequestError if one cannot be read or the folder exists.
    """
    sources = [_read(each) for each in (domain_file, problem_file) if each is not None]
    texts = {each.path: each for each in sources}
    findings = Findings()
    try:
        domain = read_domain(sources[0], findings)
        problem = read_problem(sources[1], domain, findings) if problem_file is not None else None
        name = _library_name(domain, folder)
        made = (
            {}
            if findings.is_broken
            else _texts(name, domain, problem, findings, [each.name for each in map(Path, texts)])
        )
    except BrokenPddl as error:
        findings.add_error(error)
    if findings.is_broken:
        raise DiagnosticsError(findings.sorted(), texts)
    _try_out(name, made)
    return Imported(_write(made, folder or Path(name)), findings.sorted(), texts)


def _write(texts: dict[str, str], folder: Path) -> tuple[Path, ...]:
    found = inspect_path(folder)
    if found.kind != "missing":
        raise RequestError(
            f"{folder} {found.is_what if found.kind == 'unusable' else 'already exists'}; choose another with --out"
        )
    try:
        return write_folder(texts, folder)
    except OSError as error:
        raise ServiceError(f"cannot create {folder}: {error.strerror}; nothing was written") from error


def _read(path: Path) -> Source:
    found = inspect_path(path)
    if found.kind != "file":
        raise RequestError(f"{path} {found.is_what}")
    try:
        return decode(str(path), path.read_bytes())
    except OSError as error:
        raise RequestError(f"{path} cannot be read: {error.strerror}") from error


def _library_name(domain: Domain, folder: Path | None) -> str:
    """Return the name of the library: that of its folder, else of the domain."""
    written = domain.name.written if folder is None else folder.resolve().name
    name = re.sub(r"[^a-z0-9]+", "_", written.lower()).strip("_")
    name = name if NAME.fullmatch(name) else f"domain_{name}".rstrip("_")
    return f"{name}_domain" if name in {*load_vocabulary().prefixes, PREFIX, "std"} else name


def _texts(name: str, domain: Domain, problem: Problem | None, findings: Findings, files: list[str]) -> dict[str, str]:
    """Return the files of the project, formatted, by relative path."""
    objects = _objects(domain, problem)
    domain.cost = _find_cost(domain, problem)
    terms = Terms(domain, find_changed(domain.actions))
    terms.declare_all()
    terms.individuals = {key: terms.name_individual(to_individual(each.written)) for key, each in objects.items()}
    if any(_needs_world(form) for form in (*terms.forms.values(), *terms.functions.values())):
        terms.world()
    writer = Writer(terms, objects)
    actions = ActionWriter(writer, findings)
    iri, title = f"http://example.org/{name}#", f"Made of {' and '.join(files)} by `skillc import pddl`."
    skills = write_skills(domain, actions, terms.names)
    derived = write_derived(domain, writer, findings)
    task = to_variable(problem.name.written) if problem is not None else ""
    scene = SceneWriter(writer, findings, name).write(problem, title, iri, f"https://w3id.org/skillc/library/{name}#")
    measure = _find_measure(problem, domain, findings) if problem is not None else ""
    goal = write_task(problem, task, SCENE, measure, writer, findings) if problem is not None else ""
    ranges = find_ranges(domain, problem) if problem is not None else {}
    vocabulary = write_vocabulary(terms, ranges)
    texts = {
        "skillc.toml": _manifest(name, task if goal else "", title),
        f"{name}.skill": _format(
            "\n".join(filter(None, (_head(title, iri, skills + derived), vocabulary, derived, skills)))
        ),
    }
    if goal:
        texts[TASKS] = _format(f'{_head(title, iri, goal)}import "{name}.skill"\n\n{goal}')
    return texts | {SCENE: scene}


def _needs_world(form: Form) -> bool:
    """Whether something is said that is about no thing, or about fewer than a relation has sides."""
    sides = 2 if isinstance(form, Defined) else 1
    return isinstance(form, Property | Defined) and len(form.symbol.parameters) < sides


def _head(title: str, iri: str, text: str) -> str:
    """Return how a file begins, with the prefix of individuals if it names any."""
    return header(title, iri) if f"{PREFIX}:" in text else f"# {title}\n"


def _objects(domain: Domain, problem: Problem | None) -> dict[str, Typed]:
    found = {each.name: each for each in domain.constants}
    for each in problem.objects if problem is not None else ():
        found.setdefault(each.name, each)
    return found


def _find_cost(domain: Domain, problem: Problem | None) -> str:
    """Return the function that only says what actions cost: one that is minimised, only increases, and is not read."""
    metric = problem.metric if problem is not None else None
    if problem is None or metric is None or metric.items[1].word != "minimize":
        return TOTAL_COST
    what = metric.items[2]
    name = what.word or what.head
    if name not in domain.functions or domain.functions[name].parameters:
        return TOTAL_COST
    increased = f"(increase {what} "
    texts = [each for action in domain.actions for each in (action.condition, action.effect, action.duration)]
    texts += [problem.goal, *(each.condition for each in domain.derived)]
    read = sum(str(each).count(f"({name})") for each in texts if each is not None)
    return name if read == sum(str(each).count(increased) for each in texts if each is not None) else TOTAL_COST


def _find_measure(problem: Problem, domain: Domain, findings: Findings) -> str:
    """Return what the metric minimises, `cost` or `makespan`; one that is neither is noted, and is an empty text."""
    if problem.metric is None:
        return ""
    what = problem.metric.items[2]
    measure = {domain.cost: "cost", "total-time": "makespan"}.get(what.word or what.head, "")
    if measure and problem.metric.items[1].word == "minimize":
        return measure
    instead = "it minimises durations, costs or the time until its last step ends"
    findings.add_missing(Missing(problem.metric, f"a plan cannot minimise or maximise `{what}`: {instead}"))
    return ""


def _manifest(name: str, task: str, title: str) -> str:
    lines = (
        f'# {title}\nname = "{name}"\nversion = "0.1.0"\nedition = {NEWEST}\nscene = "{SCENE}"\n',
        f'task = "{task}"\n' if task else "",
        '\n[tool.run]\nbackend = "symbolic"\n',
    )
    return "".join(lines)


def _format(text: str) -> str:
    return format_source(Source("made.skill", text)).value


def _try_out(name: str, texts: dict[str, str]) -> None:
    """Compile what was made; ServiceError if that has an error."""
    sources = [Source(path, text) for path, text in texts.items() if path.endswith(".skill")]
    outcome = pipeline.compile(sources, load_vocabulary(), find_library(Path("std")).importable, name)
    errors = [each for each in outcome.diagnostics if each.severity == "error"]
    if errors:
        raise ServiceError(f"the library that was made of it has an error, nothing was written: {errors[0]}")
