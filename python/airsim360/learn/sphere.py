"""Geometry of panoramas for networks: perspective crops, turned panoramas, tangent patches, and a convolution on the sphere.

Directions are of the camera frame C: +X right, +Y down, +Z forward; panoramas are equirectangular (docs/reference/frames.md).
"""
from __future__ import annotations

from typing import Any, List, Tuple

import cv2
import numpy as np
import numpy.typing as npt
import torch
from torch import nn
from torch.nn import functional as F

__all__ = ["SphereConv", "crop_rays", "directions", "in_panorama", "rotation", "sample", "solid_angles", "tangent_patches"]

_Array = npt.NDArray[Any]


def rotation(yaw: float, pitch: float, roll: float) -> _Array:
    """R_C_crop (3, 3) of a view in a camera: yaw to the right, pitch upwards, roll clockwise, radians, in this order from outside."""
    cy, sy, cp, sp, cr, sr = np.cos(yaw), np.sin(yaw), np.cos(pitch), np.sin(pitch), np.cos(roll), np.sin(roll)
    about_y = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    about_x = np.array([[1, 0, 0], [0, cp, -sp], [0, sp, cp]])
    about_z = np.array([[cr, -sr, 0], [sr, cr, 0], [0, 0, 1]])
    turned: _Array = about_y @ about_x @ about_z
    return turned


def directions(height: int) -> npt.NDArray[np.float32]:
    """Unit vectors (H, 2 H, 3) of the pixels of a panorama."""
    theta = 2 * np.pi * ((np.arange(2 * height) + 0.5) / (2 * height) - 0.5)
    phi = np.pi * (0.5 - (np.arange(height) + 0.5) / height)
    c = np.cos(phi)[:, None]
    rays = [c * np.sin(theta), np.broadcast_to(-np.sin(phi)[:, None], (height, 2 * height)), c * np.cos(theta)]
    return np.asarray(np.stack(rays, -1), np.float32)


def solid_angles(height: int) -> npt.NDArray[np.float32]:
    """Steradians (H,) of a pixel in each row of a panorama of H rows; they sum to 4 π over H x 2 H pixels."""
    edges = np.sin(np.pi * (0.5 - np.arange(height + 1) / height))
    return np.asarray((edges[:-1] - edges[1:]) * np.pi / height, np.float32)


def crop_rays(width: int, height: int, fov: float, aspect: float = 1.0, centre: Tuple[float, float] = (0, 0)) -> _Array:
    """Rays (H, W, 3), not normalised, of a pinhole with the horizontal field of view (radians). `aspect` stretches its pixels upwards,
    `centre` moves its axis, in half widths and heights."""
    tan = np.tan(fov / 2)
    x = ((np.arange(width) + 0.5) / width * 2 - 1 - centre[0]) * tan
    y = ((np.arange(height) + 0.5) / height * 2 - 1 - centre[1]) * tan * height / width * aspect
    return np.stack([*np.meshgrid(x, y), np.ones((height, width))], -1)


def in_panorama(rays: _Array, height: int) -> Tuple[npt.NDArray[np.float32], npt.NDArray[np.float32]]:
    """Where rays (…, 3) meet a panorama of H rows: x and y as cv2.remap counts them, 0 at the middle of the first pixel."""
    x, y, z = rays[..., 0], rays[..., 1], rays[..., 2]
    theta = np.arctan2(x, z)
    phi = np.arctan2(-y, np.hypot(x, z))
    return (((theta / (2 * np.pi) + 0.5) * 2 * height - 0.5).astype(np.float32), ((0.5 - phi / np.pi) * height - 0.5).astype(np.float32))


def sample(panorama: _Array, rays: _Array, nearest: bool = False) -> _Array:
    """The panorama (H, 2 H) or (H, 2 H, C) along rays."""
    height = panorama.shape[0]
    x, y = in_panorama(rays, height)
    wide = cv2.copyMakeBorder(panorama, 1, 1, 2, 2, cv2.BORDER_WRAP)
    wide[0], wide[-1] = wide[1], wide[-2]
    seen: _Array = cv2.remap(wide, x + 2, y + 1, cv2.INTER_NEAREST if nearest else cv2.INTER_LINEAR)
    return seen


def tangent_patches() -> List[_Array]:
    """R_C_patch of 26 overlapping views that cover the sphere: eight around the horizon, eight 45 degrees above and below, the poles.

    Tangent images: Eder, Shvets, Lim, Frahm, "Tangent Images for Mitigating Spherical Distortion", CVPR 2020.
    """
    views = [rotation(k * np.pi / 4, pitch, 0) for pitch in (0, np.pi / 4, -np.pi / 4) for k in range(8)]
    return [*views, rotation(0, np.pi / 2, 0), rotation(0, -np.pi / 2, 0)]


def _taps(height: int, width: int, stride: int) -> npt.NDArray[np.float32]:
    # Rows and columns of the 3 x 3 taps around each output pixel: its tangent plane, one input pixel of the equator apart.
    step = np.pi / height
    phi = np.pi * (0.5 - (np.arange(height // stride) + 0.5) * stride / height)[:, None, None]
    kx, ky = np.meshgrid([-1.0, 0.0, 1.0], [-1.0, 0.0, 1.0])
    x = np.tan(step) * kx
    y = -np.tan(step) * ky * np.where(kx == 0, 1, 1 / np.cos(step))  # upwards
    rho = np.hypot(x, y)
    nu = np.arctan(rho)
    ratio = np.where(rho > 0, np.sin(nu) / np.where(rho > 0, rho, 1), 1)
    tap_phi = np.arcsin(np.clip(np.cos(nu) * np.sin(phi) + y * ratio * np.cos(phi), -1, 1))
    tap_theta = np.arctan2(x * ratio, np.cos(phi) * np.cos(nu) - y * ratio * np.sin(phi))
    rows = (0.5 - tap_phi / np.pi) * height - 0.5                                     # (Ho, 3, 3)
    centres = (np.arange(width // stride) + 0.5) * stride - 0.5                       # of columns
    columns = centres[None, None, None] + tap_theta[..., None] / (2 * np.pi) * width  # (Ho, 3, 3, Wo)
    grid = np.stack([columns, np.broadcast_to(rows[..., None], columns.shape)], -1)
    return np.asarray(grid.transpose(0, 1, 3, 2, 4).reshape(3 * (height // stride), 3 * (width // stride), 2), np.float32)


class SphereConv(nn.Module):  # type: ignore[misc]
    """A 3 x 3 convolution whose taps are on the tangent plane of the sphere at every pixel, so that it sees the same at every latitude.

    Coors, Condurache, Geiger, "SphereNet: Learning Spherical Representations for Detection and Classification in Omnidirectional
    Images", ECCV 2018. (B, C, H, W) -> (B, C', H / stride, W / stride); left and right border join.
    """

    def __init__(self, inputs: int, outputs: int, height: int, stride: int = 1) -> None:
        super().__init__()
        width = 2 * height
        self.conv = nn.Conv2d(inputs, outputs, 3, stride=3, bias=False)
        self.half = width // 2
        grid = torch.from_numpy(_taps(height, width, stride))
        scale = torch.tensor([2 * width, height], dtype=torch.float32)
        self.register_buffer("grid", ((grid + torch.tensor([float(self.half), 0.0]) + 0.5) * 2 / scale - 1)[None], persistent=False)

    def forward(self, x: Any) -> Any:
        wide = torch.cat([x[..., -self.half:], x, x[..., :self.half]], -1)
        grid = self.grid.expand(x.shape[0], -1, -1, -1)
        return self.conv(F.grid_sample(wide, grid, mode="bilinear", padding_mode="border", align_corners=False))
