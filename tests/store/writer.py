"""A process that writes to a store and says on stdout, line by line, which transactions it was told are kept.

`python writer.py STORE SEED COUNT NAME`; NAME marks its transactions.
"""

import sys
from pathlib import Path
from random import Random

sys.path.insert(0, str(Path(__file__).parents[1]))

from skillc_runtime.world.model import WorldError, WorldModel
from skillc_runtime.world.store.contents import world_of
from skillc_runtime.world.store.opening import open_store
from store.worlds import facts_of, random_write
from world.lab import VOCABULARY


def main(place: str, seed: int, count: int, name: str) -> None:
    """Write so many transactions, whatever others do meanwhile, and tell the digest of the last version."""
    store = open_store(place)
    kept = store.read()
    model = WorldModel(world_of(kept.triples, VOCABULARY, place), store, kept.sequence)
    chance, made = Random(seed), 0
    while made < count:
        try:
            model.commit(random_write(chance), f"{name} {made}")
        except WorldError:
            continue
        made += 1
        print(f"{name} {made - 1}", flush=True)
    model.follow()
    print("end", len(facts_of(model.snapshot())), flush=True)


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), sys.argv[4])
