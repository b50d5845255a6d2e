"""What happened in a run. Start at `events`, the closed set of events, with values of `world.state.labelled`.

`writer` and `reader` write and read them as a file; `history_builder` turns the events of a run into its `history`, and
`question` selects the calls in it that a question is about.
"""
