"""What happened in a run. Start at `events`, the closed set of events, whose values are those of `world.labelled`.

`writer` and `reader` are their file; `history` makes the steps of a run of them, which `question` is asked about.
"""
