"""Agreement of ids and range between a frame of ours and one of Cycles of the same view."""
import json
import subprocess

import numpy
from exr import read_exr
from PIL import Image


def read_entities(path):
    rgb = numpy.asarray(Image.open(path).convert("RGB")).astype(numpy.int64)
    return rgb[..., 0] + 256 * rgb[..., 1] + 65536 * rgb[..., 2]


def near_edges(ids, radius=1):
    """Pixels within `radius` of another id; columns wrap."""
    edge = numpy.zeros(ids.shape, bool)
    for dy in range(-radius, radius + 1):
        rows = numpy.clip(numpy.arange(ids.shape[0]) + dy, 0, ids.shape[0] - 1)
        for dx in range(-radius, radius + 1):
            edge |= numpy.roll(ids[rows], dx, axis=1) != ids
    return edge


def bent(ranges):
    """Leaves before leaves of one tree are edges too: ranges that do not go on as on a plane."""
    left, right = numpy.roll(ranges, 1, 1), numpy.roll(ranges, -1, 1)
    above, below = numpy.vstack([ranges[:1], ranges[:-1]]), numpy.vstack([ranges[1:], ranges[-1:]])
    return numpy.maximum(numpy.abs(left + right - 2 * ranges), numpy.abs(above + below - 2 * ranges)) > 0.01 * ranges


def pixel_centres(width, height, q_wxyz):
    """Directions in W through the middle of an equirectangular image's pixels."""
    w, x, y, z = q_wxyz
    R = numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
    theta = 2 * numpy.pi * ((numpy.arange(width) + 0.5) / width - 0.5)[None, :]
    phi = numpy.pi * (0.5 - (numpy.arange(height) + 0.5) / height)[:, None]
    in_camera = numpy.stack(numpy.broadcast_arrays(numpy.cos(phi) * numpy.sin(theta), -numpy.sin(phi), numpy.cos(phi) * numpy.cos(theta)), -1)
    return in_camera @ R.T


def cast(program, world, origin, directions, folder):
    """Entity, exact distance and Embree's distance along directions from `origin`, each of the directions' shape."""
    rays = numpy.concatenate([numpy.broadcast_to(origin, directions.shape), directions], -1)
    rays.astype("<f8").tofile(folder / "rays")
    subprocess.run([program, world, folder / "rays", folder / "answers"], check=True, stderr=subprocess.DEVNULL)
    answers = numpy.fromfile(folder / "answers", "<f8").reshape(*directions.shape[:-1], 3)
    return answers[..., 0].astype(numpy.int64), answers[..., 1], answers[..., 2]


def compare(ours, cycles, program, folder):
    """`ours`: folder of a dataset of one frame; `cycles`: multilayer EXR of the same view, one sample, with position;
    `program`: ray_check. Returns figures by name; ranges are compared off edges of ids and of range.

    range_*      Cycles' against ours, pixel by pixel
    same_ray_*   Cycles' against the exact distance to our scene along Cycles' own ray, which is the direction of the
                 position it wrote: what its float32 directions do to ranges of grazed surfaces is out of it
    own_*        ours against the exact distance along the ray through the middle of the pixel, on the same entity
    """
    frame = json.loads((ours / "frames.jsonl").read_text().splitlines()[0])
    origin = numpy.array(frame["X_WC"]["p"])
    names = json.loads((ours / "entities.json").read_text())
    sky = next((int(key) for key, value in names.items() if value["category_path"] == "sky"), 0)
    layers = read_exr(cycles)
    channel = lambda end: next(v for k, v in layers.items() if k.endswith(end))
    ids = read_entities(ours / "entity/000000.png")
    ranges = read_exr(ours / "range/000000.exr")["Y"].astype(numpy.float64)
    theirs = numpy.rint(channel("IndexOB.X")).astype(numpy.int64)
    theirs[theirs == 0] = sky
    distance = channel("Depth.Z").astype(numpy.float64)
    edge = near_edges(ids) | near_edges(theirs)
    differs = ids != theirs
    both = (ranges > 0) & (distance < 1e9) & ~edge & ~differs & ~bent(ranges)

    position = numpy.stack([channel("Position." + c).astype(numpy.float64) for c in "XYZ"], -1)
    hit = distance < 1e9
    to_position = numpy.where(hit[..., None], position - origin, [0, 0, 1])
    cast_ids, exact, _ = cast(program, frame["world"], origin, to_position, folder)
    same_ray = both & (cast_ids == ids)
    own_ids, own_exact, _ = cast(program, frame["world"], origin, pixel_centres(*ids.shape[::-1], frame["X_WC"]["q_wxyz"]), folder)
    own = (ranges > 0) & (own_ids == ids) & ~edge & ~bent(ranges)

    def spread(name, a, b, where):
        error = numpy.abs(a[where] / b[where] - 1)
        return {f"{name}_p50": float(numpy.quantile(error, 0.5)), f"{name}_p999": float(numpy.quantile(error, 0.999)),
                f"{name}_max": float(error.max())}
    return {
        "pixels": ids.size,
        "id_mismatches": int(differs.sum()),
        "id_mismatch_share": float(differs.mean()),
        "id_mismatches_off_edges": int((differs & ~edge).sum()),
        "range_compared_share": float(both.mean()),
        **spread("range", distance, ranges, both),
        **spread("same_ray", distance, exact, same_ray),
        **spread("own", ranges, own_exact, own),
    }
