#!/usr/bin/env python3
"""Writes python/airsim360/airsim/client.pyi, the types of the methods that client.py makes of its tables.

    tools/write_airsim_stub.py            # writes it; with --check: exit 1 where the file is another

Reads the source alone, so it needs neither NumPy nor msgpack.
"""
import ast
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parents[1] / "python/airsim360/airsim"

# Types of parameters by name; all others are float.
TYPES = {
    "str": "vehicle_name light_name object_name material_name texture_path start_datetime preset_lens_settings preset_filmback_settings "
           "command name_regex level_name asset_name mesh_name message message_param param_name imu_name barometer_name magnetometer_name "
           "gps_name distance_sensor_name lidar_name of vehicle_type pawn_path",
    "bool": "is_enabled arm is_paused is_start_datetime_dst move_sun enable external ignore_collision teleport physics_enabled is_blueprint "
            "is_name_regex is_persistent",
    "int": "frames tex_id component_id material_id object_id severity param image_type drivetrain width height",
    "str | int": "camera_name",
    "str | list[str]": "tags",
    "Pose": "pose",
    "Sequence[Pose]": "poses",
    "Vector3r": "scale_vector position wind",
    "Sequence[Vector3r]": "points points_start points_end positions path",
    "Sequence[str]": "strings names",
    "Sequence[float]": "color_rgba text_color_rgba",
    "GeoPoint": "point point1 point2",
    "KinematicsState": "state",
    "CarControls": "controls",
    "YawMode": "yaw_mode",
    "ImageRequest": "request",
    "Sequence[ImageRequest]": "requests",
    "dict[str, float]": "distortion_params",
    "AngleRateControllerGains | None": "angle_rate_gains",
    "AngleLevelControllerGains | None": "angle_level_gains",
    "VelocityControllerGains | None": "velocity_gains",
    "PositionControllerGains | None": "position_gains",
    "RCData | None": "rcdata",
}
TYPE_OF = {name: kind for kind, names in TYPES.items() for name in names.split()}
TYPE_IN = {("simSpawnObject", "scale"): "Vector3r", ("__init__", "ip"): "str", ("__init__", "port"): "int"}  # method, parameter

# Results that are no structure; all others are None.
RESULTS = {
    "bool": "ping isApiControlEnabled armDisarm simSetLightIntensity simSetObjectMaterial simSetObjectMaterialFromTexture simIsPause "
            "simTestLineOfSightToPoint simTestLineOfSightBetweenPoints simRunConsoleCommand simSetObjectPose simSetObjectScale "
            "simLoadLevel simDestroyObject simSetSegmentationObjectID isRecording simCreateVoxelGrid simAddVehicle",
    "int": "getServerVersion getMinRequiredClientVersion getClientVersion getMinRequiredServerVersion simGetSegmentationObjectID",
    "float": "simSetFilmbackSettings simGetFocalLength simGetFocusDistance simGetFocusAperture simGetCurrentFieldOfView",
    "str": "simGetLensSettings simGetFilmbackSettings simSpawnObject getSettingsString",
    "list[str]": "simSwapTextures simGetPresetLensSettings simGetPresetFilmbackSettings simListSceneObjects simListAssets listVehicles",
    "list[float]": "simGetDistortionParams",
    "bytes | None": "simGetImage",
    "list[ImageResponse]": "simGetImages",
    "list[int]": "simGetLidarSegmentation",
}
RESULT_OF = {name: kind for kind, names in RESULTS.items() for name in names.split()}


def parameters(text):
    """Of a table's signature: (name, default or None)."""
    arguments = ast.parse(f"def f({text.replace(' -', ' ').replace('(-', '(')}): pass").body[0].args
    defaults = [None] * (len(arguments.args) - len(arguments.defaults)) + arguments.defaults
    return [(a.arg, d and ast.unparse(d)) for a, d in zip(arguments.args, defaults)]


def stub_of(name, pairs, result, meaning):
    """The lines of one method."""
    listed = ["self"]
    for parameter, default in pairs:
        kind = TYPE_IN.get((name, parameter)) or TYPE_OF.get(parameter, "float")
        shown = {"_FOREVER": "3e38", "_RED": "[1.0, 0.0, 0.0, 1.0]"}.get(default, default)
        shown = "..." if shown and shown.startswith(("YawMode", "DrivetrainType")) else shown
        listed.append(f"{parameter}: {kind}" + (f" = {shown}" if shown else ""))
    head = f"    def {name}("
    lines = [head]
    for i, part in enumerate(listed):
        part += ", " if i + 1 < len(listed) else f") -> {result}:"
        if len(lines[-1]) + len(part.rstrip()) > 120:
            lines[-1] = lines[-1].rstrip()
            lines.append(" " * len(head))
        lines[-1] += part
    return lines + [f'        """{meaning}"""' if meaning else "        ..."]


def method_of(function):
    """The lines of a method written out in client.py."""
    arguments = function.args.args[1:]
    defaults = [None] * (len(arguments) - len(function.args.defaults)) + function.args.defaults
    pairs = [(a.arg, d and ast.unparse(d)) for a, d in zip(arguments, defaults)]
    result = "Future" if function.name.endswith("Async") else RESULT_OF.get(function.name, "None")
    return stub_of(function.name, pairs, result, (ast.get_docstring(function) or "").replace("\n", "\n        "))


def main():
    module = ast.parse((FOLDER / "client.py").read_text())
    structures = sorted({n.name for n in ast.parse((FOLDER / "types.py").read_text()).body if isinstance(n, ast.ClassDef)})
    tables = {n.targets[0].id: n.value.value for n in module.body if isinstance(n, ast.Assign) and isinstance(n.value, ast.Constant)}
    classes = {n.name: n for n in module.body if isinstance(n, ast.ClassDef)}
    lines = {name: [] for name in classes}
    for name, node in classes.items():
        for part in node.body:
            if isinstance(part, ast.FunctionDef) and (part.name == "__init__" or not part.name.startswith("_")):
                lines[name] += method_of(part)
                if part.name == "__init__":
                    lines[name] = ["    client: Client", *lines[name]]
    for node in module.body:
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Call):  # _define(class, table, suffix, body)
            owner, table, suffix, _ = node.value.args
            text = tables[table.id] if isinstance(table, ast.Name) else table.value
            for line in text.strip().splitlines():
                call, _, meaning = line.partition("  # ")
                signature, _, result = call.partition(" -> ")
                name, _, rest = signature.partition("(")
                kind = f"list[{result[1:-1]}]" if result.startswith("[") else result or RESULT_OF.get(name, "None")
                lines[owner.id] += stub_of(name + suffix.value, parameters(rest[:-1]), "Future" if suffix.value else kind, meaning)
    body = []
    for name, node in classes.items():
        base = f"({node.bases[0].id})" if node.bases else ""
        words = ast.get_docstring(node).replace("\n", "\n    ").replace("    \n", "\n")
        body += ["", f"class {name}{base}:", f'    """{words}' + ('\n    """' if "\n" in words else '"""'), "", *lines[name]]
    text = "\n".join(body)
    used = [name for name in structures if any(mark + name in text for mark in (": ", "[", "> "))]
    head = ["# Made by tools/write_airsim_stub.py of the tables of client.py; do not edit.", "from typing import Sequence", "",
            "from msgpackrpc import Client, Future", "", f"from .types import {', '.join(used)}"]
    if len(head[-1]) > 120:
        head[-1] = "from .types import (" + ", ".join(used) + ")"
        wrapped, start = [], " " * 20
        for word in head.pop().split(", "):
            if wrapped and len(wrapped[-1]) + len(word) + 2 <= 118:
                wrapped[-1] += f", {word}"
            else:
                wrapped = [*(w + ("" if w.endswith(",") else ",") for w in wrapped), (start if wrapped else "") + word]
        head += wrapped
    text = "\n".join(head) + "\n" + text + "\n"
    file = FOLDER / "client.pyi"
    if "--check" in sys.argv:
        same = file.exists() and file.read_text() == text
        print("" if same else f"{file}: not what tools/write_airsim_stub.py writes")
        return 0 if same else 1
    file.write_text(text)
    return 0


sys.exit(main())
