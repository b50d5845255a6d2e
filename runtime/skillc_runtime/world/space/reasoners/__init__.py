"""What tells from geometry whether a relation holds: a file each, which vocabularies name by `skillc:computedBy`."""
