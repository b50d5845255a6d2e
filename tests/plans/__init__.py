"""Tests of following plans."""
