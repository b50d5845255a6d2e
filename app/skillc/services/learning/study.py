"""The study in a folder: which candidates were asked for, and what their trials gave; one process owns it.

Optuna has it in SQLite. What is recorded is on disk when the call returns, and a trial is recorded under its candidate
and its seed: a process that is killed loses what it had not recorded, and nothing is there twice.
"""

from __future__ import annotations

import logging
import time
import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, BinaryIO

import msgspec

from skillc.contract.learning import SamplerName
from skillc.errors import ServiceError
from skillc.extras import naming_extras, require
from skillc.services.learning.figures import World
from skillc.services.learning.parameters import Learnable
from skillc.services.learning.racing import Verdict
from skillc.services.learning.samplers import make_distribution, make_sampler
from skillc.services.reporting.files import writing_to
from skillc_runtime.platforms.file_locks import try_lock

FILE = "study.db"
LOCK = "study.lock"
FORMAT = 1
NAME = "skillc"
ENDED_S, LOOK_S = 2.0, 0.1
"""How long it may take until the processes of a killed one have ended, and how often that is looked at, in s."""
LEAST_KNOWN = 10
"""From how many candidates on it is said which parameters are important."""


class StudySetup(msgspec.Struct, frozen=True, kw_only=True):
    """What all candidates of a study have in common; with another heading they cannot be compared.

    `parameters` are the names in the request, between commas; empty for all.
    """

    format: int = FORMAT
    task: str
    skillc: str
    library: str
    scene: str
    minimise: str
    subject_to: str
    parameters: str
    trials: int
    seed: int


class Basis(msgspec.Struct, frozen=True, kw_only=True):
    """What the run with the defaults has shown: the parameters that are learned, and the units of the figures."""

    learnable: tuple[Learnable, ...]
    units: dict[str, tuple[str, ...]]


class Candidate(msgspec.Struct, kw_only=True):
    """Values of the parameters (n,) in the units of their authors, its trials by seed, and why it is tried no more."""

    number: int
    values: tuple[float, ...]
    worlds: dict[int, World]
    verdict: Verdict | None = None


class Study:
    """A study on disk; `candidates` are in the order in which they were asked for. Close it at the end."""

    def __init__(self, folder: Path, heading: StudySetup) -> None:
        """Open or create the study of a folder.

        ServiceError if another process uses the folder, or its study has another heading; MissingExtraError without
        Optuna.
        """
        require("skillc learn", "learn")
        self.folder = folder
        with writing_to(folder):
            folder.mkdir(parents=True, exist_ok=True)
            self._lock: BinaryIO = (folder / LOCK).open("a+b")
        try:
            if not _lock_soon(self._lock):
                raise ServiceError(f"another process is learning in {folder}; take another folder")
            self._open(heading)
        except BaseException:
            self._lock.close()
            raise

    def _open(self, heading: StudySetup) -> None:
        self._optuna = _import_optuna()
        with _reporting(self.folder):
            self._storage = self._optuna.storages.RDBStorage(f"sqlite:///{(self.folder / FILE).resolve().as_posix()}")
            names = [each.study_name for each in self._storage.get_all_studies()]
        self._study: Any = None
        self.candidates: dict[int, Candidate] = {}
        self.fresh: dict[int, dict[int, World]] = {}
        self.basis: Basis | None = None
        if NAME in names:
            self._load(heading)
        self._heading = heading

    def _load(self, heading: StudySetup) -> None:
        study = self._optuna.load_study(study_name=NAME, storage=self._storage)
        kept = study.user_attrs
        if "basis" not in kept:  # it was killed while it was made
            self._optuna.delete_study(study_name=NAME, storage=self._storage)
            return
        self._compare(msgspec.json.decode(kept["heading"], type=StudySetup), heading)
        self.basis, self._study = msgspec.json.decode(kept["basis"], type=Basis), study
        for trial in study.get_trials(deepcopy=False):
            self._keep_candidate(trial, kept)
        for key in kept:
            kind, _, place = key.partition(":")
            if kind == "fresh":
                number, _, seed = place.partition(":")
                world = msgspec.json.decode(kept[key], type=World)
                self.fresh.setdefault(int(number), {})[int(seed)] = world

    def _keep_candidate(self, trial: Any, kept: Mapping[str, str]) -> None:
        """Take a candidate over; one that was killed while it was asked for is none."""
        assert self.basis is not None
        names = [each.name for each in self.basis.learnable]
        if trial.state.name in ("FAIL", "WAITING"):
            return
        if not all(name in trial.params for name in names):
            self._study.tell(trial.number, state=self._optuna.trial.TrialState.FAIL)
            return
        worlds = {}
        for key, value in kept.items():
            if key.startswith(f"world:{trial.number}:"):
                world = msgspec.json.decode(value, type=World)
                worlds[world.seed] = world
        self.candidates[trial.number] = Candidate(
            number=trial.number,
            values=self._round(trial.params),
            worlds=worlds,
            verdict=trial.user_attrs["verdict"] if trial.state.name == "COMPLETE" else None,
        )

    def create(self, basis: Basis, objectives: int) -> None:
        """Begin a study of so many objectives; the first candidate has the defaults."""
        with _reporting(self.folder):
            study = self._optuna.create_study(
                study_name=NAME, storage=self._storage, directions=["minimize"] * objectives
            )
            study.set_user_attr("heading", msgspec.json.encode(self._heading).decode())
            study.set_user_attr("basis", msgspec.json.encode(basis).decode())
        self.basis, self._study = basis, study

    def use_sampler(self, sampler: SamplerName, wanted: int, seed: int) -> None:
        """Choose how candidates are asked for from now on; `wanted` is how many there are to be."""
        # What was drawn before is not drawn again by a study that is continued.
        self._study.sampler = make_sampler(self._optuna, sampler, wanted, seed + 1000 * len(self.candidates))

    def ask(self) -> Candidate:
        """Return a new candidate."""
        assert self.basis is not None
        if not any(each.state.name != "FAIL" for each in self._study.get_trials(deepcopy=False)):
            self._study.enqueue_trial({each.name: each.default for each in self.basis.learnable})
        with _reporting(self.folder):
            trial = self._study.ask({each.name: make_distribution(self._optuna, each) for each in self.basis.learnable})
        candidate = Candidate(number=trial.number, values=self._round(trial.params), worlds={})
        self.candidates[trial.number] = candidate
        return candidate

    def record(self, candidate: Candidate, world: World) -> None:
        """Record a trial of a candidate that is still tried."""
        self._write(f"world:{candidate.number}:{world.seed}", world)
        candidate.worlds[world.seed] = world

    def record_fresh(self, number: int, world: World) -> None:
        """Record a trial of a candidate with a seed that was not used to choose it."""
        self._write(f"fresh:{number}:{world.seed}", world)
        self.fresh.setdefault(number, {})[world.seed] = world

    def tell(
        self, candidate: Candidate, verdict: Verdict, values: Sequence[float], violations: Mapping[str, float]
    ) -> None:
        """Record that a candidate is tried no more, with its objectives and by how much constraints are missed."""
        trial = self._optuna.trial.Trial(
            self._study, self._study.get_trials(deepcopy=False)[candidate.number]._trial_id
        )
        with _reporting(self.folder):
            for name, missed in violations.items():
                if name not in trial.constraints:
                    trial.set_constraint(name, missed)
            trial.set_user_attr("verdict", verdict)
            self._study.tell(trial, list(values))
        candidate.verdict = verdict

    def worst_told(self) -> tuple[float, ...] | None:
        """Return the greatest value of each objective (n,) over all finished candidates; None if there is none."""
        told = [each.values for each in self._study.get_trials(deepcopy=False) if each.values is not None]
        return tuple(map(max, zip(*told, strict=True))) if told else None

    def compute_importances(self, objective: int) -> dict[str, float]:
        """Return the share that each parameter has in low values of an objective, by its name, the greatest first.

        PED-ANOVA, Watanabe et al. 2023, over all candidates that are done; empty for less than LEAST_KNOWN.
        """
        if sum(each.verdict is not None for each in self.candidates.values()) < LEAST_KNOWN:
            return {}
        importance = self._optuna.importance
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # it is for low values, as is wanted
            found: dict[str, float] = importance.get_param_importances(
                self._study,
                evaluator=importance.PedAnovaImportanceEvaluator(),
                target=lambda trial: trial.values[objective],
            )
        return found

    def close(self) -> None:
        """Give the folder back."""
        self._storage.remove_session()
        self._storage.engine.dispose()
        self._lock.close()

    def _write(self, key: str, world: World) -> None:
        with _reporting(self.folder):
            self._study.set_user_attr(key, msgspec.json.encode(world).decode())

    def _round(self, params: Mapping[str, float]) -> tuple[float, ...]:
        assert self.basis is not None
        return tuple(each.round(params[each.name]) for each in self.basis.learnable)

    def _compare(self, existing: StudySetup, expected: StudySetup) -> None:
        for field in StudySetup.__struct_fields__:
            before, now = getattr(existing, field), getattr(expected, field)
            if before != now:
                what = field.replace("_", "-")
                raise ServiceError(
                    f"what was learned in {self.folder} is of another {what}: {before}, now it is {now}; "
                    "take another folder, or remove this one"
                )


def _lock_soon(file: BinaryIO) -> bool:
    """Lock a file; the processes of a coordinator that was killed hold it until they have ended, within ENDED_S."""
    end = time.monotonic() + ENDED_S
    while not try_lock(file.fileno()):
        if time.monotonic() > end:
            return False
        time.sleep(LOOK_S)
    return True


def _import_optuna() -> Any:
    with naming_extras():
        import optuna
    logging.getLogger("optuna").setLevel(logging.CRITICAL)  # progress is shown by who asks for it
    return optuna


@contextmanager
def _reporting(folder: Path) -> Iterator[None]:
    """Turn an error of the database into a ServiceError that names the folder."""
    from sqlalchemy.exc import SQLAlchemyError

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    except SQLAlchemyError as error:
        raise ServiceError(f"the study in {folder} cannot be used: {error}") from error
