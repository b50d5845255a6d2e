"""How reality differs from the world model: places, people, measurements, disturbances."""
