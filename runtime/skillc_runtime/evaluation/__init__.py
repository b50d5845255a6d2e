"""How well a run went. Start at `report.summary` for one run and at `trials.experiment` for many.

`metrics` computes numbers from recordings, `report` makes results and pages, `measures` judges each kind of work.
"""
