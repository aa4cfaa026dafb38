"""Scores of pictures and flights: pure functions of the compiled module.

Pictures are (H, W, 3) uint8 sRGB of the same size, paths (N, 3) metres; anything else is a ValueError.
"""
from typing import Any, Sequence

import numpy as np
import numpy.typing as npt

_Picture = npt.NDArray[np.uint8]
_Path = Sequence[Sequence[float]] | npt.NDArray[Any]

__all__ = ["flip", "ndtw", "path_length", "psnr", "spl", "ssim", "ws_psnr"]

def psnr(a: _Picture, b: _Picture) -> float:
    """Peak signal-to-noise ratio, dB; infinity for equal pictures."""

def ws_psnr(a: _Picture, b: _Picture) -> float:
    """The same for panoramas, every row weighted by its solid angle."""

def ssim(a: _Picture, b: _Picture) -> float:
    """Mean structural similarity of luma, at most 1."""

def flip(reference: _Picture, test: _Picture, pixels_per_degree: float = 67.0206, wrap: bool = False) -> npt.NDArray[np.float32]:
    """FLIP of every pixel, (H, W) float32 in 0 … 1; wrap: the left border goes on at the right one."""

def path_length(path: _Path) -> float:
    """Metres along points (N, 3)."""

def spl(success: bool, shortest: float, flown: float) -> float:
    """Success weighted by path length: success * shortest / max(flown, shortest)."""

def ndtw(path: _Path, reference: _Path, threshold: float) -> float:
    """Normalised dynamic time warping of paths (N, 3), (M, 3), in (0, 1]; threshold: metres that count as success."""
