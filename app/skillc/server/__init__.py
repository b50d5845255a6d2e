"""The server: it starts and watches cells, and serves the API; needs the extra `server`.

Start at `serve`; `supervisor` keeps one cell going, `endpoints` has the routes, `access` says who may do what.
"""
