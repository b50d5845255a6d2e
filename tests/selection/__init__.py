"""Tests of the choice of implementations."""
