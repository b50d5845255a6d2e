"""Replays recorded runs, and checks them. Start at `check`."""
