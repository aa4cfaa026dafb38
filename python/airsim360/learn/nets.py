"""The networks, small enough for two cores."""
from __future__ import annotations

from typing import Any, Tuple

import torch
from torch import nn
from torch.nn import functional as F

from .sphere import SphereConv

__all__ = ["PictureNet", "SphereNet"]


class _Mixed(nn.Module):  # type: ignore[misc]
    """Half of the channels normalised by picture, half by batch: the first forgets a picture's style, the second keeps what classes
    share (IBN-Net: Pan, Luo, Shi, Tang, ECCV 2018)."""

    def __init__(self, channels: int) -> None:
        super().__init__()
        self.own = nn.InstanceNorm2d(channels // 2, affine=True)
        self.batch = nn.BatchNorm2d(channels - channels // 2)

    def forward(self, x: Any) -> Any:
        n = x.shape[1] // 2
        return torch.cat([self.own(x[:, :n]), self.batch(x[:, n:])], 1)


class _Block(nn.Module):  # type: ignore[misc]
    def __init__(self, inputs: int, outputs: int, stride: int = 1, mixed: bool = False, dilation: int = 1) -> None:
        super().__init__()
        self.first = nn.Conv2d(inputs, outputs, 3, stride, dilation, dilation, bias=False)
        self.norm1 = _Mixed(outputs) if mixed else nn.BatchNorm2d(outputs)
        self.second = nn.Conv2d(outputs, outputs, 3, 1, 1, bias=False)
        self.norm2 = nn.BatchNorm2d(outputs)
        self.skip = None if stride == 1 and inputs == outputs else nn.Sequential(
            nn.AvgPool2d(stride, ceil_mode=True) if stride > 1 else nn.Identity(), nn.Conv2d(inputs, outputs, 1, bias=False), nn.BatchNorm2d(outputs))

    def forward(self, x: Any) -> Any:
        y = self.norm2(self.second(F.relu(self.norm1(self.first(x)))))
        return F.relu(y + (x if self.skip is None else self.skip(x)))


class PictureNet(nn.Module):  # type: ignore[misc]
    """Encoder and decoder with residual blocks for perspective pictures.

    (B, 3, H, W), values 0 to 1 -> (B, outputs, H, W) at a quarter of the resolution, enlarged. H and W are multiples of 32.
    """

    def __init__(self, outputs: int, widths: Tuple[int, ...] = (32, 40, 80, 160, 224)) -> None:
        super().__init__()
        a, b, c, d, e = widths
        self.stem = nn.Sequential(nn.Conv2d(4, a, 5, 2, 2, bias=False), _Mixed(a), nn.ReLU())
        self.stage1 = nn.Sequential(_Block(a, b, 2, mixed=True), _Block(b, b, mixed=True))
        self.stage2 = nn.Sequential(_Block(b, c, 2, mixed=True), _Block(c, c, mixed=True))
        self.stage3 = nn.Sequential(_Block(c, d, 2), _Block(d, d))
        self.stage4 = nn.Sequential(_Block(d, e, 2), _Block(e, e, dilation=2))
        self.whole = nn.Linear(e, 64)
        self.up = nn.ModuleList([nn.Conv2d(n, 64, 1) for n in (b, c, d, e)])
        self.mix = nn.ModuleList([_Block(64, 64) for _ in range(3)])
        self.head = nn.Conv2d(64, outputs, 1)

    def forward(self, x: Any) -> Any:
        size = x.shape[-2:]
        x = (x - 0.45) / 0.25
        rows = torch.linspace(-1, 1, size[0], device=x.device)[None, None, :, None].expand(x.shape[0], 1, *size)
        at = [self.stage1(self.stem(torch.cat([x, rows], 1)))]
        for stage in (self.stage2, self.stage3, self.stage4):
            at.append(stage(at[-1]))
        y = self.up[3](at[3]) + self.whole(at[3].mean((2, 3)))[..., None, None]
        for k in (2, 1, 0):
            y = self.mix[k](self.up[k](at[k]) + F.interpolate(y, size=at[k].shape[-2:], mode="bilinear", align_corners=False))
        return F.interpolate(self.head(y), size=size, mode="bilinear", align_corners=False)


class _SphereBlock(nn.Module):  # type: ignore[misc]
    def __init__(self, inputs: int, outputs: int, height: int, stride: int = 1, mixed: bool = False) -> None:
        super().__init__()
        self.first = SphereConv(inputs, outputs, height, stride)
        self.norm1 = _Mixed(outputs) if mixed else nn.BatchNorm2d(outputs)
        self.second = SphereConv(outputs, outputs, height // stride)
        self.norm2 = nn.BatchNorm2d(outputs)
        self.skip = None if stride == 1 and inputs == outputs else nn.Sequential(
            nn.AvgPool2d(stride) if stride > 1 else nn.Identity(), nn.Conv2d(inputs, outputs, 1, bias=False), nn.BatchNorm2d(outputs))

    def forward(self, x: Any) -> Any:
        y = self.norm2(self.second(F.relu(self.norm1(self.first(x)))))
        return F.relu(y + (x if self.skip is None else self.skip(x)))


class SphereNet(nn.Module):  # type: ignore[misc]
    """Encoder and decoder on the sphere for panoramas of `height` x 2 `height`, a multiple of 16.

    (B, 3, H, 2 H), values 0 to 1 -> (B, outputs, H / 2, H), or with `coarse` a quarter, (B, outputs, H / 4, H / 2), for less than half the
    work; distortion-aware convolutions throughout, no input tells the latitude unless `level`: then the rows of the panorama are known to
    be level.
    """

    def __init__(self, outputs: int, height: int, widths: Tuple[int, ...] = (16, 32, 64, 96), level: bool = False, coarse: bool = False) -> None:
        super().__init__()
        a, b, c, d = widths
        self.level, self.height, h = level, height, height
        self.levels = (2, 1) if coarse else (2, 1, 0)  # of the decoder
        self.stem, self.norm = SphereConv(4 if level else 3, a, h, 2), _Mixed(a)
        self.stage1 = _SphereBlock(a, b, h // 2, 2, mixed=True)
        self.stage2 = _SphereBlock(b, c, h // 4, 2)
        self.stage3 = nn.Sequential(_SphereBlock(c, d, h // 8, 2), _SphereBlock(d, d, h // 16))
        self.whole = nn.Linear(d, 32)
        self.up = nn.ModuleList([nn.Conv2d(n, 32, 1) for n in (a, b, c, d)])  # the first is not used with `coarse`
        self.mix = nn.ModuleList([SphereConv(32, 32, h // (2 << k)) for k in reversed(self.levels)])
        self.norms = nn.ModuleList([nn.BatchNorm2d(32) for _ in self.levels])
        self.head = nn.Conv2d(32, outputs, 1)

    def forward(self, x: Any) -> Any:
        x = (x - 0.45) / 0.25
        if self.level:
            rows = torch.linspace(1, -1, x.shape[2], device=x.device)[None, None, :, None].expand(x.shape[0], 1, *x.shape[2:])
            x = torch.cat([x, rows], 1)
        at = [F.relu(self.norm(self.stem(x)))]
        for stage in (self.stage1, self.stage2, self.stage3):
            at.append(stage(at[-1]))
        weight = torch.cos((torch.arange(at[3].shape[2], device=x.device) + 0.5 - at[3].shape[2] / 2) * (torch.pi / at[3].shape[2]))
        mean = (at[3] * (weight / weight.mean())[:, None]).mean((2, 3))
        y = self.up[3](at[3]) + self.whole(mean)[..., None, None]
        for k in self.levels:
            y = F.interpolate(y, scale_factor=2, mode="bilinear", align_corners=False) + self.up[k](at[k])
            y = F.relu(self.norms[k - self.levels[-1]](self.mix[k - self.levels[-1]](F.relu(y))))
        return self.head(y)
