"""The completion scripts, in real shells: commands, options, tasks with what they do, diagnostics."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from waiting import LONG_S

BASH = """
eval "$(skillc completion bash)"
COMP_LINE="{words}"; COMP_POINT=${{#COMP_LINE}}
_skillc_completion skillc
printf '%s\\n' "${{COMPREPLY[@]}}"
"""
FISH = "skillc completion fish | source; complete -C '{words}'"
ZSH = """
compdef() {{ }}
compadd() {{ print -l -- ${{(P)argv[-1]}} }}
_describe() {{ print -l -- ${{(P)3}} }}
eval "$(skillc completion zsh)"
words=({words}); CURRENT=$#words
_skillc_completion
"""
SHELLS = {"bash": BASH, "zsh": ZSH, "fish": FISH}


def complete(shell: str, words: str, folder: Path) -> list[str]:
    """Return what a shell offers for the last of some words, with the help that it shows beside it."""
    if shutil.which(shell) is None:
        pytest.skip(f"{shell} is not installed")
    call = (shell, "-c", f"PATH={Path(sys.executable).parent}:$PATH\n" + SHELLS[shell].format(words=words))
    if shell == "fish":
        call = (shell, "-c", f"set -x PATH {Path(sys.executable).parent} $PATH; " + FISH.format(words=words))
    done = subprocess.run(call, cwd=folder, capture_output=True, text=True, check=False, timeout=LONG_S)
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


@pytest.mark.parametrize("shell", SHELLS)
def test_a_shell_completes_commands_tasks_and_diagnostics(shell: str, tmp_path: Path) -> None:
    assert any(each.startswith("trials") for each in complete(shell, "skillc tri", tmp_path))
    tasks = complete(shell, "skillc run clean_t", tmp_path)
    assert [each.replace(":", "\t").split("\t")[0] for each in tasks] == ["clean_table"]
    assert "--breakpoints" in "\n".join(complete(shell, "skillc run --break", tmp_path))
    assert complete(shell, "skillc explain unknown-cl", tmp_path)[0].startswith("unknown-class")


def test_a_project_that_cannot_be_read_offers_no_tasks(tmp_path: Path) -> None:
    (tmp_path / "skillc.toml").write_text("name =", "utf-8")
    assert complete("bash", "skillc run clean_t", tmp_path) == [""]
