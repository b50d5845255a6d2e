"""The world model from ten to a hundred thousand objects: load, snapshot, conditions, inference, writes, memory.

Run it as `python benchmarks/world_model.py [FOLDER]`; it prints what each size took and how that grows, ratios against
SkiROS2, and draws the growth as `world_model.png` in FOLDER, `out` where none is named.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import TypeAlias

from matplotlib.figure import Figure

SIZES = (10, 100, 1_400, 10_000, 14_000, 140_000)
"""Objects; in the scene of `_worlds.py` 1,400 make 1e4 triples, 14,000 make 1e5 and 140,000 make 1e6."""

Measured: TypeAlias = dict[str, float]

BOUNDS = (
    ("condition `a contain b` us", 140_000, 5.0),
    ("load s", 140_000, 10.0),
    ("open a store from its index s", 140_000, 3.0),
    ("most memory of the process MB", 10_000, 1024.0),
)
"""What must hold, at which size."""

PEER: dict[str, tuple[float, str]] = {
    "infer two parameters us": (44_000.0, "grounding Pick, 1000 objects, 44 ms"),
    "see an element us": (46.0, "fetch one individual, its server's cache, 46 us"),
    "commit: move a part us": (460.0, "set a relation, half of set and unset, .46 ms"),
    "commit: set a weight us": (520.0, "update properties, .52 ms"),
    "commit: a new part us": (930.0, "add an individual, 1000 objects, .93 ms"),
    "load s": (0.225, "load a scene of 1000 objects, .22 s"),
    "save s": (0.12, "save a scene of 1000 objects, .12 s"),
}
"""Lower bounds for SkiROS2 in one process without ROS, measured on another day; three facts an object there."""
PEER_SIZE = 1_400


def main() -> None:
    """Measure every size in a process of its own, print, compare and draw."""
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else "out")
    sizes = {size: _measured(size) for size in SIZES}
    _print_sizes(sizes)
    print()
    for name, size, bound in BOUNDS:
        value = sizes[size][name]
        print(f"{name:44} {value:10.1f} of {bound:g} at {size} objects: {'holds' if value <= bound else 'BROKEN'}")
    print(f"\n{f'SkiROS2 / skillc, {PEER_SIZE} objects':44} {'ratio':>10}")
    for name, (theirs, what) in PEER.items():
        ours = sizes[PEER_SIZE][name]
        print(f"{name:44} {theirs / ours:10.1f}  {what}")
    folder.mkdir(parents=True, exist_ok=True)
    _draw(sizes, folder / "world_model.png")
    print(f"\ndrawn in {folder / 'world_model.png'}", file=sys.stderr)


def _measured(size: int) -> Measured:
    print(f"{size} objects ..", file=sys.stderr)
    command = [sys.executable, str(Path(__file__).with_name("_worlds.py")), str(size)]
    ran = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True)
    found: Measured = json.loads(ran.stdout)
    return found


def _print_sizes(sizes: dict[int, Measured]) -> None:
    """Print a line for each measurement; the last column is how it grew from the second size to the largest."""
    names = list(dict.fromkeys(name for size in SIZES for name in sizes[size]))
    print(f"{'objects':44}" + "".join(f"{size:>10}" for size in SIZES) + f"{'growth':>8}")
    for name in names:
        values = [sizes[size].get(name) for size in SIZES]
        shown = "".join(f"{'-' if value is None else f'{value:.4g}':>10}" for value in values)
        known = [value for value in values[1:] if value is not None]
        print(f"{name:44}{shown}{known[-1] / max(known[0], 1e-9):8.1f}")


def _draw(sizes: dict[int, Measured], path: Path) -> None:
    figure = Figure(figsize=(13, 4.5), layout="constrained")
    units = {"us": "microseconds", " s": "seconds", "MB": "megabytes"}
    for axes, (ending, unit) in zip(figure.subplots(1, 3), units.items(), strict=True):
        for name in (name for name in sizes[SIZES[0]] if name.endswith(ending)):
            points = [(each["triples"], each[name]) for each in sizes.values() if name in each]
            axes.plot(*zip(*points, strict=True), marker="o", label=name.removesuffix(ending).strip())
        axes.set(xscale="log", yscale="log", xlabel="triples", ylabel=unit)
        axes.grid(visible=True, alpha=0.3)
        axes.legend(fontsize="x-small")
    figure.suptitle("The world model as it grows")
    figure.savefig(path, dpi=120)


if __name__ == "__main__":
    main()
