"""Cells whose devices are ROS 2 interfaces: `cell` makes them, `facts` reads their names, `link` is the arm's side."""
