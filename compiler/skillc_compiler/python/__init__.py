"""Reads Python targets from their source text, without importing them. Start with `targets`."""
