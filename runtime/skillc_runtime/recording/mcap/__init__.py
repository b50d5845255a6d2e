"""A run as one MCAP file: events, signals of each control period, and what the run was made of.

`recording_file` writes one while the run goes on, `reader` reads it; `signal_tap` samples the signals of a cell,
`sample_layout` says what they mean, and `signal_block` is how they are stored.
"""
