"""The back end for arms of Universal Robots, through the Real-Time Data Exchange of their controllers."""
