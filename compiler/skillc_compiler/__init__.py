"""The compiler: from skill sources to a checked library and its artifacts. It uses no clock and no network.

`program` is the resolved program; `resolve` makes it, `analysis` and `checks` examine it, `lower` turns it into the
library, `emit` writes artifacts. Start with `pipeline`.
"""
