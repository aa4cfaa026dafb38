"""A client for AirSim-compatible servers with the names of AirSim's own Python client.

Needs only NumPy and msgpack. `import airsim360.airsim as airsim` is all that an existing script has to change. Unlike
the original it raises what went wrong in `Async` calls at `.join()` only if asked to (`.get()`), as the original does,
and takes float images as bytes, so that `image_data_float` is a NumPy array at once.
"""
from .client import CarClient, MultirotorClient, VehicleClient
from .types import *  # noqa: F401,F403  (the names of AirSim's client)
from .utils import *  # noqa: F401,F403

__version__ = "1.8.1"
