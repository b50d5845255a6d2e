"""Scenes as files and stores: how they are opened, edited and written."""
