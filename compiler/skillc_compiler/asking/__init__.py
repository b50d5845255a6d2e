"""Understanding what is asked of a running system: goals and calls in the words of a library and of a scene."""
