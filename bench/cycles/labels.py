"""Agreement of ids, range and normals between a frame of ours and some of Cycles of the same view."""
import sys

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


def compare(ours, cycles, sky_id):
    """`ours`: folder of a dataset of one frame; `cycles`: multilayer EXRs of the same view with other seeds. Returns
    figures by name.

    Cycles' narrowest pixel filter still moves its rays by up to 0.005 pixels. Where its own frames disagree about an id,
    an edge runs through that jitter: `certain` are mismatches where they all agree. Ranges are means over the frames.
    """
    ids = read_entities(f"{ours}/entity/000000.png")
    ranges = read_exr(f"{ours}/range/000000.exr")["Y"].astype(numpy.float64)
    theirs, distances = [], []
    for path in cycles:
        layers = read_exr(path)
        channel = lambda end: next(v for k, v in layers.items() if k.endswith(end))
        theirs.append(numpy.rint(channel("IndexOB.X")).astype(numpy.int64))
        theirs[-1][theirs[-1] == 0] = sky_id
        distances.append(channel("Depth.Z").astype(numpy.float64))
    agreed = numpy.all([t == theirs[0] for t in theirs], axis=0)
    distance = numpy.mean(distances, axis=0)

    edge = near_edges(ids) | near_edges(theirs[0])
    differs = ids != theirs[0]
    both = (ranges > 0) & (numpy.max(distances, axis=0) < 1e9) & ~edge & ~differs & agreed
    error = numpy.abs(ranges - distance)[both] / ranges[both]
    # What the slope of the range makes of the jitter.
    above, below = numpy.vstack([ranges[:1], ranges[:-1]]), numpy.vstack([ranges[1:], ranges[-1:]])
    slope = (numpy.abs(numpy.roll(ranges, 1, 1) - numpy.roll(ranges, -1, 1)) + numpy.abs(above - below)) / 2
    beyond = numpy.maximum(0, error - 0.005 * slope[both] / ranges[both])
    return {
        "pixels": ids.size,
        "id_mismatches": int(differs.sum()),
        "id_mismatch_share": float(differs.mean()),
        "id_mismatches_certain": int((differs & agreed).sum()),
        "id_mismatches_certain_share": float((differs & agreed).mean()),
        "id_mismatches_off_edges": int((differs & ~edge).sum()),
        "range_p50": float(numpy.quantile(error, 0.5)),
        "range_p999": float(numpy.quantile(error, 0.999)),
        "range_p999_beyond_jitter": float(numpy.quantile(beyond, 0.999)),
        "range_max": float(error.max()),
    }


if __name__ == "__main__":
    for name, value in compare(sys.argv[1], sys.argv[3:], int(sys.argv[2])).items():
        print(f"{name:26} {value}")
