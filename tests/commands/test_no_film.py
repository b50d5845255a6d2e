"""What is wanted of a film that is not to be made is refused before anything is run."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner

import skillc as api
from skillc.cli.main import skillc

WANTED = (
    (("--gif",), "--gif writes a film"),
    (("--film-quality", "fine"), "--film-quality applies to the film"),
    (("--looks", "menagerie"), "--looks menagerie applies to films and stills"),
)


@pytest.mark.parametrize("command", ["run", "report"])
@pytest.mark.parametrize(("options", "said"), WANTED)
def test_a_film_that_is_not_made_has_no_form(command: str, options: tuple[str, ...], said: str, tmp_path: Path) -> None:
    named = "clean_table" if command == "run" else str(tmp_path)
    result = CliRunner().invoke(skillc, [command, named, "--no-film", *options, "--out", str(tmp_path / "out")])
    assert result.exit_code == 2 and said in " ".join(result.stderr.split())
    assert "which --no-film leaves out" in " ".join(result.stderr.split())
    assert not (tmp_path / "out").exists()


def test_python_refuses_it_too(tmp_path: Path) -> None:
    with pytest.raises(api.RequestError, match="which --no-film leaves out"):
        api.start("clean_table", out=tmp_path / "out", film=False, gif=True)
