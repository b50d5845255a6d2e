"""The control process of an arm, with a robot in a process of its own on the other side."""
