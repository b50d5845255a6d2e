"""Makes the pictures of docs/gallery.md and the film of README from runs of the shipped tasks: `make pictures`.

Each task runs with seed 0 into out/pictures; a picture is a frame of its film. Names of tasks make some pictures only.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import av
from PIL import Image

from docs.pages import ROOT
from operating.monitors import Monitor
from skillc.services.reporting import SilentReporter
from skillc.services.running import RunOptions, run_task
from skillc.services.task_loading import TaskRequest, load_task
from skillc_runtime.film.film import FILM
from skillc_runtime.film.picture_files import LOOP_EVERY, LoopPictures, few_colours
from skillc_runtime.film.rendering import Picture

PICTURES, RUNS = ROOT / "docs/pictures", ROOT / "out/pictures"
SIZE = 960, 540
README_FILM, README_BYTES = PICTURES / "skillc.webp", 2_000_000
ALL_BYTES = 5_000_000
"""All pictures of the documentation together are not larger."""


@dataclass(frozen=True, slots=True)
class TaskPicture:
    """The picture of a task: the frame at a share of its film."""

    task: str
    share: float

    @property
    def file(self) -> Path:
        """Where it is."""
        return PICTURES / f"{self.task.rpartition(':')[2]}.png"


TASKS = (
    TaskPicture("clean_table", 0.57),
    TaskPicture("contact:press_button", 0.39),
    TaskPicture("contact:insert_peg", 0.5),
    TaskPicture("contact:teach_pose", 0.43),
    TaskPicture("sorting:sort_parts", 0.32),
    TaskPicture("sorting:sort_seen_parts", 0.14),
)

SCENES = (("clean_table", 0.2, 0.72), ("sorting:sort_parts", 0.1, 0.5), ("contact:insert_peg", 0.3, 0.75))
"""The parts of films, from one share to another, that README opens with."""


def find_task_picture(task: str) -> TaskPicture:
    """Return the picture of a task; KeyError if there is none."""
    return {each.task: each for each in TASKS}[task]


def read_film(task: str) -> Sequence[Picture]:
    """Return the pictures of the film of a task, which runs if it has not yet."""
    folder = RUNS / task.replace(":", "_")
    if not (folder / FILM).exists():
        with load_task(TaskRequest(task).with_defaults(), SilentReporter()) as loaded:
            run_task(loaded, RunOptions(folder), Monitor(), SilentReporter())
    with av.open(str(folder / FILM)) as film:
        return [frame.to_ndarray(format="rgb24") for frame in film.decode(video=0)]


def write_task_picture(picture: TaskPicture) -> None:
    """Write the picture of a task, with few colours."""
    frames = read_film(picture.task)
    image = Image.fromarray(frames[round(picture.share * (len(frames) - 1))]).resize(SIZE, Image.Resampling.LANCZOS)
    few_colours(image).save(picture.file, optimize=True)


def write_readme_film() -> None:
    """Write the film that README opens with."""
    loop = LoopPictures()
    for _ in loop.keep(_readme_frames()):
        pass
    loop.write(README_FILM, README_BYTES)


def _readme_frames() -> Iterator[Picture]:
    for task, start, end in SCENES:
        frames = read_film(task)
        first, last = (round(share * len(frames)) for share in (start, end))
        yield from frames[first : last - (last - first) % LOOP_EVERY]


def main(names: Iterable[str]) -> None:
    """Make the pictures of some tasks, or without names those of all and the film of README."""
    PICTURES.mkdir(parents=True, exist_ok=True)
    wanted = [find_task_picture(each) for each in names]
    for picture in wanted or TASKS:
        write_task_picture(picture)
        print(picture.file.relative_to(ROOT), file=sys.stderr)
    if not wanted:
        write_readme_film()


if __name__ == "__main__":
    main(sys.argv[1:])
