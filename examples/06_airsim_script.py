"""Example 6: an AirSim script against our server: only the import is another one.

    PYTHONPATH=build/python /usr/bin/python3 examples/06_airsim_script.py
"""
import os
import pathlib
import subprocess
import sys

import numpy as np

import airsim360.airsim as airsim

# The server, on any free port, as `build/bin/airsim360 serve --world box_room` would be started by hand.
program = os.environ.get("AIRSIM360", str(pathlib.Path(__file__).resolve().parents[1] / "build/bin/airsim360"))
server = subprocess.Popen([program, "serve", "--world", "box_room", "--port", "0"], stdout=subprocess.PIPE, text=True)
try:
    assert server.stdout is not None
    port = int(server.stdout.readline().rsplit(":", 1)[1])

    client = airsim.MultirotorClient(port=port)
    client.confirmConnection()
    client.enableApiControl(True)
    client.armDisarm(True)
    client.takeoffAsync().join()
    client.moveToPositionAsync(1, 1, -2, 2).join()

    # A pinhole depth image, and a panorama, which AirSim could not give.
    client.client.call("simSetPanoramaResolution", "panorama_original", 256, 128, "")
    client.client.call("simTriggerPanoramaCapture", "panorama_original", "")
    depth, panorama = client.simGetImages([
        airsim.ImageRequest("0", airsim.ImageType.DepthPlanar, True, False),
        airsim.ImageRequest("panorama_original", airsim.ImageType.Scene, False, False)])
    bgr = np.frombuffer(panorama.image_data_uint8, np.uint8).reshape(panorama.height, panorama.width, 3)
    position = client.getMultirotorState().kinematics_estimated.position
    print(f"at {position.x_val:.2f} north, {position.y_val:.2f} east, {-position.z_val:.2f} up; "
          f"depth {depth.width}x{depth.height}, panorama {bgr.shape}")
    done = abs(position.x_val - 1) < 0.7 and abs(position.z_val + 2) < 0.7 and bgr.any()
finally:
    server.terminate()
    server.wait()
sys.exit(not done)
