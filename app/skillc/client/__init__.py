"""Clients of a server: asynchronous ones, which do the work, and the same for programs that wait.

Start at `connecting`; `async_server` has what can be requested, `feed` the events, `server` the same without asyncio.
"""
