"""The node of ROS 2 that shows the cells of a server and takes orders for them: a client of the server.

Start at `process`, which the server starts; `cell_bridge` connects a cell with its topics and services.
"""
