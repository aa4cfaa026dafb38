"""Labels of panoramas of streets: DensePASS and WildPASS."""
from __future__ import annotations

from pathlib import Path

import numpy as np

from .files import Options, found, label_ids, write_labels, write_names

__all__ = ["densepass", "wildpass"]

_CITYSCAPES = ("road", "sidewalk", "building", "wall", "fence", "pole", "traffic light", "traffic sign", "vegetation", "terrain", "sky", "person",
               "rider", "car", "truck", "bus", "train", "motorcycle", "bicycle")
# The evaluator's classes in its order, with their ids among its 25 classes of Mapillary Vistas.
_WILDPASS = {"Car": 4, "Truck": 5, "Bus": 8, "Road": 11, "Sidewalk": 12, "Person": 17, "Curb": 13, "Crosswalk": 24}
_MAPILLARY = 26  # of which the last has no class


def densepass(folder: Path, out: Path, options: Options) -> int:
    """Ma, Zhang, Yang, Roitberg, Stiefelhagen: DensePASS, ITSC 2021; github.com/chma1024/DensePASS, S_R/datasets.py: `gtFine/val/*/*_labelTrainIds.png`."""
    paths = found(folder, "*labelTrainIds.png")
    for path in paths:
        ids = label_ids(path)
        wrong = np.setdiff1d(ids, [*range(len(_CITYSCAPES)), 255])
        if wrong.size:
            raise ValueError(f"{path}: the id {wrong[-1]} is none of 0 to {len(_CITYSCAPES) - 1} and 255: looks like Cityscapes' labelIds (26 is car), not trainIds")
        write_labels(out, path.name[:-len("labelTrainIds.png")].rstrip("_"), ids)
    write_names(out, _CITYSCAPES)
    return len(paths)


def wildpass(folder: Path, out: Path, options: Options) -> int:
    """Yang, Zhang, Reiss, Hu, Stiefelhagen: Capturing Omni-Range Context for Omnidirectional Segmentation, CVPR 2021.

    github.com/elnino9ykl/WildPASS: labels are `gtFine/val/cs/NAME.png` beside pictures `leftImg8bit/val/cs/NAME.png` (segment/eval_color_fusion.py), their
    ids those of 25 classes of Mapillary Vistas (segment/dataset_loader.py), of which eight are evaluated; truths of the others are left out. Predictions in
    these ids are converted by the same function. Where the labels hold 255, that evaluator counts predictions as wrong, `eval semantic` leaves them out.
    """
    paths = [path for path in found(folder, "*.png") if "leftImg8bit" not in path.relative_to(folder).parts]
    if not paths:
        raise ValueError(f"{folder}: no gtFine/*.png below it")
    table = np.full(256, 255, np.uint8)
    table[list(_WILDPASS.values())] = np.arange(len(_WILDPASS))
    roads = False
    for path in paths:
        ids = label_ids(path)
        wrong = np.setdiff1d(ids, [*range(_MAPILLARY), 255])
        if wrong.size:
            raise ValueError(f"{path}: the id {wrong[-1]} is none of 0 to {_MAPILLARY - 1} and 255: looks like another set's ids")
        roads = roads or bool((ids == _WILDPASS["Road"]).any())
        write_labels(out, path.stem, table[ids])
    if not roads and not options.force:
        raise ValueError(f"{folder}: no picture has a road (id {_WILDPASS['Road']}): are these ids 0 to 7 already, as `dataset export --format wildpass` writes them?")
    write_names(out, list(_WILDPASS))
    return len(paths)
