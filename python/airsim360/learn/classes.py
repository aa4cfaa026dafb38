"""What the reference programs tell apart: seven classes of outdoor pictures, and the rest."""
from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Dict, List, Mapping, Tuple

import numpy as np
import numpy.typing as npt

__all__ = ["CLASSES", "IGNORED", "PALETTE", "WORLDS", "class_of", "class_table", "legend", "write_legend"]

CLASSES: Tuple[str, ...] = ("other", "sky", "building", "road", "sidewalk", "vegetation", "car", "person")
"""Names by id; 0 is what is none of the seven."""

WORLDS: Tuple[str, ...] = ("downtown_west", "new_york_city", "sf_city", "city_park", "rome", "lisbon_downtown", "downtown_city", "map_town",
                           "rural_cabins", "roof")
"""Worlds that frames are drawn of unless others are named."""

PALETTE: Tuple[Tuple[int, int, int], ...] = ((0, 0, 0), (70, 130, 180), (70, 70, 70), (128, 64, 128), (244, 35, 232), (107, 142, 35),
                                             (0, 0, 142), (220, 20, 60))
"""RGB of each class, those of Cityscapes; black is the rest."""

IGNORED = 127
"""In training frames: no class is learnt here (what has no label, and the drone itself)."""

# The longest prefix of a category's path counts.
_PREFIXES: Dict[str, str] = {
    "sky": "sky",
    "construction": "building", "construction/fountain": "other", "construction/statue": "other", "construction/phone_booth": "other",
    "construction/mast": "other", "construction/scaffolding": "other", "construction/stairs": "other", "construction/well": "other",
    "signage/shop_sign": "building", "signage/billboard": "building", "furniture/painting": "building",
    "ground/road": "road", "ground/crosswalk": "road", "ground/lane_marking": "road", "ground/manhole": "road", "ground/bike_lane": "road",
    "ground/parking": "road", "ground/rail": "road",
    "ground/sidewalk": "sidewalk", "ground/pavement": "sidewalk", "ground/kerb": "sidewalk", "ground/path": "sidewalk",
    "ground/grass": "vegetation", "ground/terrain": "vegetation", "nature/hill": "vegetation", "nature/terrain": "vegetation",
    "vegetation": "vegetation",
    "vehicle": "car", "vehicle/bicycle": "other", "vehicle/motorcycle": "other", "vehicle/boat": "other", "vehicle/airplane": "other",
    "vehicle/helicopter": "other", "vehicle/train": "other",
    "human": "person",
    "object": "other", "uav": "ignored",
}


def class_of(path: str) -> int:
    """Class of a category's path; IGNORED for what has no label."""
    if not path:
        return IGNORED
    while path not in _PREFIXES and "/" in path:
        path = path.rsplit("/", 1)[0]
    name = _PREFIXES.get(path, "other")
    return IGNORED if name == "ignored" else CLASSES.index(name)


def class_table(categories: Mapping[int, Any]) -> npt.NDArray[np.uint8]:
    """Category id -> class, for airsim360's `categories` (id -> path, or a dictionary with one). Id 0 is ignored."""
    table = np.full(max([0, *categories]) + 1, IGNORED, np.uint8)
    for number, category in categories.items():
        table[number] = class_of(category if isinstance(category, str) else category["path"])
    return table


def legend() -> List[Dict[str, Any]]:
    """Id, name and colour of every class."""
    return [{"id": i, "name": name, "color": list(PALETTE[i])} for i, name in enumerate(CLASSES)]


def write_legend(path: Path) -> None:
    """legend.json beside label pictures."""
    path.write_text(json.dumps({"classes": legend()}, indent=1) + "\n", encoding="utf-8")
