"""The state folder of a server: its database, its lock, and a folder for each cell."""

from __future__ import annotations

FORMAT = 1
LOCK, DATABASE, ADMIN_TOKEN, CELLS = "lock", "server.sqlite", "admin.token", "cells"
