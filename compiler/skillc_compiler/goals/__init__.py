"""Goals and calls given at run time, in the words of a library and of a scene. Start reading at `parsing`."""
