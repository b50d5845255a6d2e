"""The skill libraries that ship with skillc."""
