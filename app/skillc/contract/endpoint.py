"""Endpoints as data."""

PREFIX = "/api/v1"
