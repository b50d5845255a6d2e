"""Makes the pictures of docs/gallery.md, the film of README, terminals and the studio from runs: `make pictures`.

Each task runs with seed 0 into out/pictures; a picture is a frame of its film. Names of tasks make some pictures only,
from runs that are there already.
"""

from __future__ import annotations

import shutil
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import chain
from pathlib import Path

import av
from PIL import Image

from docs.pages import ROOT
from operating.monitors import Monitor
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.run.running import RunOptions, run_task
from skillc.services.tasks.loading import load_task
from skillc_runtime.film.footage import FILM
from skillc_runtime.film.picture_files import LOOP_EVERY, LoopPictures
from skillc_runtime.film.rendering import Picture
from skillc_runtime.recording.run_spec import RunSpec

PICTURES, RUNS = ROOT / "docs/pictures", ROOT / "out/pictures"
SIZE, QUALITY = (960, 540), 88
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
        return PICTURES / f"{self.task.rpartition(':')[2]}.webp"


TASKS = (
    TaskPicture("clean_table", 0.57),
    TaskPicture("clean_whiteboard", 0.66),
    TaskPicture("clean_around", 0.6),
    TaskPicture("clean_desk", 0.5),
    TaskPicture("clean_watched", 0.52),
    TaskPicture("clean_by_wrist_camera", 0.468),
    TaskPicture("clean_both", 0.5),
    TaskPicture("share_eraser", 0.375),
    TaskPicture("contact:press_button", 0.37),
    TaskPicture("contact:press_button_panda", 0.43),
    TaskPicture("contact:polish_sheet", 0.54),
    TaskPicture("contact:polish_sheet_ur5e", 0.5),
    TaskPicture("contact:insert_peg", 0.5),
    TaskPicture("contact:insert_peg_iiwa", 0.5),
    TaskPicture("contact:teach_pose", 0.43),
    TaskPicture("contact:teach_pose_panda", 0.33),
    TaskPicture("sorting:sort_parts", 0.32),
    TaskPicture("sorting:sort_seen_parts", 0.14),
    TaskPicture("sorting:sort_shapes", 0.54),
    TaskPicture("sorting:sort_inspected", 0.3),
    TaskPicture("sorting:sort_by_wrist_camera", 0.04),
)
ROBOTS = (
    ("clean_whiteboard", 0.66, 0.53),
    ("contact:teach_pose", 0.43, 0.5),
    ("contact:teach_pose_panda", 0.1, 0.545),
)
"""The films, where in them, and about which share of their width the robots that ship are cut."""
ROBOTS_PICTURE = PICTURES / "robots.webp"

SCENES = (("clean_table", 0.2, 0.72), ("sorting:sort_parts", 0.1, 0.5), ("contact:insert_peg", 0.3, 0.75))
"""The parts of films, from one share to another, that README opens with."""


def find_task_picture(task: str) -> TaskPicture:
    """Return the picture of a task; KeyError if there is none."""
    return {each.task: each for each in TASKS}[task]


def read_film(task: str) -> Sequence[Picture]:
    """Return the pictures of the film of a task, which runs if it has not yet."""
    folder = RUNS / task.replace(":", "_")
    if not (folder / FILM).exists():
        with load_task(RunSpec(task=task), SilentReporter()) as loaded:
            run_task(loaded, RunOptions(RunSpec(out=str(folder), film_quality="fine")), Monitor(), SilentReporter())
    with av.open(str(folder / FILM)) as film:
        return [frame.to_ndarray(format="rgb24") for frame in film.decode(video=0)]


def read_frame(task: str, share: float) -> Image.Image:
    """Return the frame at a share of the film of a task."""
    frames = read_film(task)
    return Image.fromarray(frames[round(share * (len(frames) - 1))])


def write_task_picture(picture: TaskPicture) -> None:
    """Write the picture of a task."""
    image = read_frame(picture.task, picture.share).resize(SIZE, Image.Resampling.LANCZOS)
    image.save(picture.file, quality=QUALITY, method=6)


def write_robots_picture() -> None:
    """Write the picture of the robots that ship, side by side, each cut from a film without its caption."""
    width, height = SIZE[0] // len(ROBOTS), SIZE[0] // 2
    both = Image.new("RGB", (*SIZE[:1], height))
    for place, (task, share, middle) in enumerate(ROBOTS):
        frame = read_frame(task, share)
        above = round(0.85 * frame.height)
        across = round(above * width / height)
        left = round(middle * frame.width) - across // 2
        cut = frame.crop((left, 0, left + across, above)).resize((width, height), Image.Resampling.LANCZOS)
        both.paste(cut, (place * width, 0))
    both.save(ROBOTS_PICTURE, quality=QUALITY, method=6)


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
    """Make the pictures of some tasks, or without names all pictures."""
    PICTURES.mkdir(parents=True, exist_ok=True)
    wanted = [find_task_picture(each) for each in names]
    if not wanted:
        shutil.rmtree(RUNS, ignore_errors=True)
    for picture in wanted or TASKS:
        write_task_picture(picture)
        print(picture.file.relative_to(ROOT), file=sys.stderr)
    if not wanted:
        # These need a pseudo terminal, which Windows does not have, and Chromium.
        from docs.mistake_pictures import write_mistake_picture
        from docs.studio_pictures import write_studio_pictures
        from docs.terminal_pictures import write_terminal_pictures

        write_robots_picture()
        for file in chain(write_terminal_pictures(), write_studio_pictures(), (write_mistake_picture(),)):
            print(file.relative_to(ROOT), file=sys.stderr)
        write_readme_film()


if __name__ == "__main__":
    main(sys.argv[1:])
