"""The back end without bodies."""
