"""What the files of a library declare: the terms that are theirs, and those of vocabularies that they add to."""
