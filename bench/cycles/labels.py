"""Agreement of ids, range and normals between a frame of ours and one of Cycles of the same view."""
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
    """`ours`: folder of a dataset of one frame; `cycles`: multilayer EXR of the same view, one sample. Returns figures
    by name.

    Cycles' first sample is not quite in the middle of the pixel. `offset_x` and `offset_y`, pixels, are the shift that
    explains its ranges best by the slope of ours (least squares); `range_p999_centred` is what it leaves. Ranges are
    compared off edges of ids and of range.
    """
    layers = read_exr(cycles)
    channel = lambda end: next(v for k, v in layers.items() if k.endswith(end))
    ids = read_entities(f"{ours}/entity/000000.png")
    ranges = read_exr(f"{ours}/range/000000.exr")["Y"].astype(numpy.float64)
    theirs = numpy.rint(channel("IndexOB.X")).astype(numpy.int64)
    theirs[theirs == 0] = sky_id
    distance = channel("Depth.Z").astype(numpy.float64)

    edge = near_edges(ids) | near_edges(theirs)
    differs = ids != theirs
    left, right = numpy.roll(ranges, 1, 1), numpy.roll(ranges, -1, 1)
    above, below = numpy.vstack([ranges[:1], ranges[:-1]]), numpy.vstack([ranges[1:], ranges[-1:]])
    # Leaves before leaves of one tree are edges too: ranges that do not go on as on a plane.
    bent = numpy.maximum(numpy.abs(left + right - 2 * ranges), numpy.abs(above + below - 2 * ranges)) > 0.01 * ranges
    both = (ranges > 0) & (distance < 1e9) & ~edge & ~differs & ~bent
    error = (distance - ranges)[both] / ranges[both]
    slopes = numpy.stack([((right - left) / 2)[both], ((below - above) / 2)[both]], 1) / ranges[both, None]
    offset = numpy.zeros(2)
    for _ in range(3):  # without outliers
        kept = numpy.abs(error - slopes @ offset) < 3e-5
        offset = numpy.linalg.lstsq(slopes[kept], error[kept], rcond=None)[0]
    magnitude = numpy.abs(error)
    return {
        "pixels": ids.size,
        "id_mismatches": int(differs.sum()),
        "id_mismatch_share": float(differs.mean()),
        "id_mismatches_off_edges": int((differs & ~edge).sum()),
        "range_compared_share": float(both.mean()),
        "range_p50": float(numpy.quantile(magnitude, 0.5)),
        "range_p999": float(numpy.quantile(magnitude, 0.999)),
        "range_max": float(magnitude.max()),
        "offset_x": float(offset[0]),
        "offset_y": float(offset[1]),
        "range_p999_centred": float(numpy.quantile(numpy.abs(error - slopes @ offset), 0.999)),
    }


if __name__ == "__main__":
    for name, value in compare(sys.argv[1], sys.argv[2], int(sys.argv[3])).items():
        print(f"{name:26} {value}")
