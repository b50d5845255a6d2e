"""The pictures of the documentation are those that `make pictures` makes, are small, and say what they show."""

from __future__ import annotations

import re

import pytest
from PIL import Image

from docs.gallery_pictures import ALL_BYTES, PICTURES, README_BYTES, README_FILM, SIZE, TASKS, find_task_picture
from docs.pages import ROOT
from skillc.services.tasks.listing import list_tasks

PAGE = (ROOT / "docs/gallery.md").read_text("utf-8")
SHOWN = re.compile(r"!\[([^\]]*)\]\(pictures/([^)]+)\)")


def test_the_gallery_has_each_picture_once_with_a_text_for_who_cannot_see_it() -> None:
    shown = {file: text for text, file in SHOWN.findall(PAGE)}
    assert sorted(file for _, file in SHOWN.findall(PAGE)) == sorted(each.file.name for each in TASKS)
    assert [file for file, text in shown.items() if len(text) < 30] == []


def test_every_task_that_ships_has_a_picture() -> None:
    assert sorted(each.task for each in TASKS) == sorted(each.name for each in list_tasks() if each.origin == "shipped")


@pytest.mark.parametrize("name", [each.task for each in TASKS])
def test_a_picture_of_a_task_is_there_and_its_command_is_on_the_page(name: str) -> None:
    with Image.open(find_task_picture(name).file) as image:
        assert image.size == SIZE
    assert f"skillc run {name} " in PAGE


def test_pictures_are_small() -> None:
    files = [path for path in PICTURES.iterdir() if path.is_file()]
    assert sum(path.stat().st_size for path in files) <= ALL_BYTES
    assert README_FILM.stat().st_size <= README_BYTES


def test_each_picture_of_the_studio_is_shown_with_a_text_for_who_cannot_see_it() -> None:
    pages = [path.read_text("utf-8") for path in (ROOT / "docs").glob("*.md")]
    shown = {file: text for page in pages for text, file in SHOWN.findall(page)}
    files = sorted(path.name for path in PICTURES.iterdir() if path.name.startswith(("studio-", "mistakes-")))
    assert len(files) > 5 and [each for each in files if len(shown.get(each, "")) < 30] == []


def test_readme_opens_with_a_film_that_repeats() -> None:
    before = (ROOT / "README.md").read_text("utf-8").split("\n## ")[0]
    assert "](docs/pictures/skillc.webp)" in before
    with Image.open(README_FILM) as film:
        assert film.is_animated and film.info["loop"] == 0 and film.n_frames > 40
