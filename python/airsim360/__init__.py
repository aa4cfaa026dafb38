"""AirSim360: a 360 degree simulator for drones."""
