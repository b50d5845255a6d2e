"""How well a run went: `measures` of each kind of work, the `report` of one run, `trials` of many."""
