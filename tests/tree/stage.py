"""A cell without hardware and primitives that do what a script says, for tests of the tree engine."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from skillc_runtime.control.supervision.watchdog import HeartbeatWatchdog
from skillc_runtime.primitives.primitive import Primitive, SkillFailure, SpaceLacking, Status
from skillc_runtime.world.state.model import WorldModel
from tree.library import world

PERIOD_S = 0.1

Ending = Literal["success", "fail", "crash", "refuse", "crash at start", "exit", "cramped"]


@dataclass(frozen=True)
class Script:
    """What one run of a primitive does: so many ticks, the last of which ends it."""

    ending: Ending = "success"
    ticks: int = 1


@dataclass
class Stage:
    """A cell whose clock the test moves; `log` is what primitives were told, `scripts` what they shall do in turn.

    `away` are the primitives that do not come into contact when they approach.
    """

    world: WorldModel
    scripts: dict[str, list[Script]] = field(default_factory=dict)
    now: float = 0.0
    log: list[tuple[float, str, str]] = field(default_factory=list)
    starts: dict[str, int] = field(default_factory=dict)
    away: set[str] = field(default_factory=set)
    watchdog: HeartbeatWatchdog = field(default_factory=HeartbeatWatchdog)

    def camera(self) -> Stage:
        """Return what scripted primitives look at: the stage itself, of which a run shows them only the devices."""
        return self

    def next_script(self, name: str) -> Script:
        """Return what the next run under this name does; the scripts repeat, without any it succeeds at once."""
        scripts = self.scripts.get(name) or [Script()]
        number = self.starts.get(name, 0)
        self.starts[name] = number + 1
        return scripts[number % len(scripts)]

    def tell(self, what: str, name: str) -> None:
        """Note what a primitive was told."""
        self.log.append((self.now, what, name))

    def said(self, *kinds: str) -> list[str]:
        """Return the log without times, of these kinds only when some are given."""
        return [f"{what} {name}" for _, what, name in self.log if not kinds or what in kinds]


class Scripted(Primitive):
    """Does what the stage's script for its name says."""

    def __init__(self, cell: Stage, *, name: str, **rest: object) -> None:
        super().__init__(cell)  # type: ignore[arg-type]
        self.stage = cell.camera()
        self.name = name
        self.script = self.stage.next_script(name)
        self.left = self.script.ticks

    def start(self) -> None:
        self.stage.tell("start", self.name)
        if self.script.ending == "refuse":
            raise SkillFailure(f"{self.name} refuses")
        if self.script.ending == "crash at start":
            raise RuntimeError(f"{self.name} broke")

    def tick(self) -> Status:
        self.stage.tell("tick", self.name)
        self.left -= 1
        if self.left > 0:
            return Status.RUNNING
        if self.script.ending == "fail":
            raise SkillFailure(f"{self.name} failed")
        if self.script.ending == "cramped":
            raise SpaceLacking(f"{self.name} has no room")
        if self.script.ending == "exit":
            raise SystemExit(0)
        if self.script.ending == "crash":
            raise RuntimeError(f"{self.name} broke")
        return Status.SUCCESS

    def halt(self, reason: str) -> None:
        self.stage.tell("halt", self.name)

    def pause(self) -> None:
        self.stage.tell("pause", self.name)

    def withdraw(self) -> None:
        self.stage.tell("withdraw", self.name)

    def approach(self) -> bool:
        self.stage.tell("approach", self.name)
        return self.name not in self.stage.away

    def resume(self) -> None:
        self.stage.tell("resume", self.name)

    def release(self) -> None:
        self.stage.tell("release", self.name)


def stage(**scripts: Script) -> Stage:
    """Return a stage on which each name does the same at every start."""
    return Stage(world(), {name: [script] for name, script in scripts.items()})
