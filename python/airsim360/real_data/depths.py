"""Panoramas of depth: Stanford 2D-3D-S, Deep360, Matterport3D-360 and SphereCraft."""
from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Dict, Set

import numpy as np

from ..pictures import read_exr
from .files import Array, Depths, Options, found, picture, write_labels, write_names

__all__ = ["stanford2d3d", "deep360", "matterport3d360", "spherecraft"]

_LARGEST = 1 << 26  # pixels
_DPT_MAGIC = 202021.25  # as Sintel's depth files begin
_NOTHING_HIT = 65000  # metres: Blender writes 1e10, or 65504 with half floats, where a ray leaves the scene


def stanford2d3d(folder: Path, out: Path, options: Options) -> int:
    """Armeni, Sax, Zamir, Savarese: Joint 2D-3D-Semantic Data for Indoor Scene Understanding, arXiv:1702.01105; github.com/alexsax/2D-3D-Semantics, README.

    Depth is along the ray in 1/512 m; labels are indices of `semantic_labels.json` in 24 bits, red highest.
    """
    depths = Depths(out, options.force)
    sizes = {}
    for path in found(folder, "area_*/pano/depth/*_depth.png"):
        code = picture(path)
        if code.ndim != 2 or code.dtype != np.uint16:
            raise ValueError(f"{path}: must have one channel of 16 bits")
        name = path.name[:-len("_depth.png")]
        sizes[name] = code.shape
        depths.add(path, name, np.where(code == 65535, 0, code / 512.0))
    table = next(iter(sorted(folder.rglob("semantic_labels.json"))), None)
    if table is None:
        raise ValueError(f"{folder}: no semantic_labels.json below it")
    instances = [str(name).split("_")[0] for name in json.loads(table.read_text(encoding="utf-8"))]
    names = sorted(set(instances) - {"<UNK>"})
    ids = np.array([names.index(name) if name in names else 255 for name in instances], np.uint8)
    for path in sorted(folder.rglob("area_*/pano/semantic/*_semantic.png")):
        rgb = picture(path)
        if rgb.ndim != 3 or rgb.dtype != np.uint8:
            raise ValueError(f"{path}: must have three channels of 8 bits")
        name = path.name[:-len("_semantic.png")]
        if sizes.get(name, rgb.shape[:2]) != rgb.shape[:2]:
            raise ValueError(f"{path}: {rgb.shape[1]}x{rgb.shape[0]} pixels, its depth has {sizes[name][1]}x{sizes[name][0]}")
        index = (rgb[..., 0].astype(np.int64) << 16) + (rgb[..., 1].astype(np.int64) << 8) + rgb[..., 2]
        write_labels(out, name, np.where(index < len(ids), ids[np.minimum(index, len(ids) - 1)], 255).astype(np.uint8))
    write_names(out, names)
    return depths.finish()


def deep360(folder: Path, out: Path, options: Options) -> int:
    """Li, Jin, Hu, Xu, Dai: MODE, ECCV 2022; github.com/nju-ee/MODE-2022, dataloader/deep360_loader.py and test_fusion.py.

    Depth is along the ray of camera 1, in metres, in Cassini's projection, twice as high as wide. What is farther than 1000 m is not evaluated there.
    Pictures that are equirectangular already are taken as they are.
    """
    depths = Depths(out, options.force)
    for path in found(folder, "*_depth.npz"):
        with np.load(path, allow_pickle=False) as arrays:
            if "arr_0" not in arrays or arrays["arr_0"].ndim != 2:
                raise ValueError(f"{path}: must hold arr_0 of two dimensions")
            metres = arrays["arr_0"].astype(np.float32)
        height, width = metres.shape
        if height == 2 * width:
            metres = _from_cassini(metres)
        elif width != 2 * height:
            raise ValueError(f"{path}: {width}x{height} is neither Cassini's projection, twice as high as wide, nor a panorama")
        # Episodes number their frames alike.
        depths.add(path, "_".join([*path.relative_to(folder).parts[:-1], path.name[:-len("_depth.npz")]]), metres, beyond=np.nextafter(1000, 1001))
    return depths.finish()


def _from_cassini(cassini: Array) -> Array:
    """The nearest pixels, as an equirectangular picture: depths of two things must not be mixed.

    Cassini's projection of that code is an equirectangular one whose poles are at the left and right: rows are the angle about the axis to the left, from
    behind over the zenith and ahead to the nadir, columns the elevation above the plane of that angle.
    """
    rows, columns = cassini.shape
    lon = 2 * np.pi * ((np.arange(rows) + 0.5) / rows - 0.5)  # of the new columns, to the right
    lat = np.pi * (0.5 - (np.arange(columns)[:, None] + 0.5) / columns)
    left, up, ahead = -np.cos(lat) * np.sin(lon), np.sin(lat) + 0 * lon, np.cos(lat) * np.cos(lon)
    i = np.floor(rows * (0.5 - np.arctan2(up, ahead) / (2 * np.pi))).astype(int) % rows
    j = np.clip(np.floor(columns * (0.5 - np.arcsin(np.clip(left, -1, 1)) / np.pi)).astype(int), 0, columns - 1)
    taken: Array = cassini[i, j]
    return taken


def matterport3d360(folder: Path, out: Path, options: Options) -> int:
    """Rey-Area, Yuan, Richardt: 360MonoDepth, CVPR 2022 (Matterport3D 360 RGBD, University of Bath): `.dpt` as Sintel's, metres along the ray."""
    depths = Depths(out, options.force)
    for path in found(folder, "*.dpt"):
        data = path.read_bytes()
        magic, width, height = struct.unpack("<fii", data[:12]) if len(data) >= 12 else (0.0, 0, 0)
        if magic != _DPT_MAGIC or not (0 < width and 0 < height and width * height <= _LARGEST):
            raise ValueError(f"{path}: is no .dpt file: 'PIEH', width, height, then floats")
        if len(data) != 12 + 4 * width * height:
            raise ValueError(f"{path}: {len(data)} bytes are not those of {width}x{height} floats")
        depths.add(path, path.stem, np.frombuffer(data[12:], "<f4").reshape(height, width))
    return depths.finish()


def spherecraft(folder: Path, out: Path, options: Options) -> int:
    """Gava, Cho, Raue, Palacio, Pagani, Dengel: SphereCraft, WACV 2024; github.com/DFKI/spherecrafthub, README, "Data Organization".

    `SCENE/depthmaps/*.exr`: one channel of 32-bit floats, the distance to the camera's centre. Pictures that `SCENE/*_black_list.txt` names are left out.
    """
    depths = Depths(out, options.force)
    lists: Dict[Path, Set[int]] = {}
    listed = False
    for path in found(folder, "depthmaps/*.exr"):
        scene = path.parent.parent
        if not path.stem.isdigit():
            raise ValueError(f"{path}: the names of depth maps are numbers")
        if scene not in lists:
            lists[scene] = _black_list(scene)
        if int(path.stem) in lists[scene]:
            listed = True
            continue
        depths.add(path, f"{scene.resolve().name}_{path.stem}", _one_channel(path), beyond=_NOTHING_HIT)
    if listed and not (out / "depth").exists():
        raise ValueError(f"{folder}: every depth map is on the black list of its scene")
    return depths.finish()


def _black_list(scene: Path) -> Set[int]:
    numbers = set()
    for path in sorted(scene.glob("*_black_list.txt")):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            stem = Path(line.strip()).stem
            if stem and not stem.isdigit():
                raise ValueError(f"{path}:{number}: '{line.strip()}' names no picture: their names are numbers")
            if stem:
                numbers.add(int(stem))
    return numbers


def _one_channel(path: Path) -> Array:
    try:
        channels = list(read_exr(path).values())
    except ValueError as error:
        if "compression" not in str(error):
            raise
        pixels = picture(path)  # OpenCV knows the other compressions
        channels = [pixels] if pixels.ndim == 2 else [pixels[..., c] for c in range(pixels.shape[2])]
    if len(channels) != 1:
        raise ValueError(f"{path}: {len(channels)} channels, a depth map has one: is it a picture?")
    return channels[0].astype(np.float64)
