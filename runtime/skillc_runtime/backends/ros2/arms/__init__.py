"""Arms that ROS 2 drives."""
