"""Domain randomisation: what cameras and weather do to pictures, drawn for every sample. Each kind can be switched off."""
from __future__ import annotations

from typing import Any, FrozenSet

import cv2
import numpy as np
import numpy.typing as npt

from .classes import CLASSES

__all__ = ["KINDS", "augment", "kinds_of", "resurface"]

KINDS = ("color", "tone", "blur", "noise", "jpeg", "light", "surface")
"""color: white balance, saturation, hue, grey; tone: exposure, contrast, gamma; blur: defocus, resampling, sharpening; noise: of
sensors; jpeg: blocks; light: vignette, veils, shadows, burnt skies, sky and ground lit apart; surface: each class
brighter or darker than it is, trees in autumn and winter (segment alone)."""

_Array = npt.NDArray[Any]


def kinds_of(text: str) -> FrozenSet[str]:
    """Kinds of "all", "none" or a list "color,blur"; ValueError names the nearest."""
    from .._words import did_you_mean
    if text in ("all", "none"):
        return frozenset(KINDS if text == "all" else ())
    for word in text.split(","):
        if word not in KINDS:
            raise ValueError(f"--augment: {word!r}{did_you_mean(word, KINDS)} (all, none, or a list of {', '.join(KINDS)})")
    return frozenset(text.split(","))


def augment(picture: _Array, random: np.random.Generator, kinds: FrozenSet[str], sky: _Array) -> _Array:
    """RGB (H, W, 3) uint8 -> the same, changed. `sky` (H, W) is true where the sky is seen."""
    x = picture.astype(np.float32) / 255
    if "light" in kinds:
        x = _light(x, random, sky)
    if "tone" in kinds:
        x = _tone(x, random)
    if "color" in kinds:
        x = _color(x, random)
    if "blur" in kinds:
        x = _blur(x, random)
    if "noise" in kinds and random.random() < 0.5:
        x = x + _noise(x.shape, random)
    out = (np.clip(x, 0, 1) * 255 + 0.5).astype(np.uint8)
    if "jpeg" in kinds and random.random() < 0.5:
        _, data = cv2.imencode(".jpg", out, [cv2.IMWRITE_JPEG_QUALITY, int(random.integers(25, 95))])
        out = cv2.imdecode(data, cv2.IMREAD_COLOR)
    return out


def resurface(picture: _Array, random: np.random.Generator, label: _Array) -> _Array:
    """RGB (H, W, 3) uint8 with classes (H, W) -> the same, with other materials: dark pavements, light roads, brown or bare trees."""
    x = picture.astype(np.float32) / 255
    if random.random() < 0.5:
        gain = np.exp(random.normal(0, 0.3, (len(CLASSES), 1)) + random.normal(0, 0.08, (len(CLASSES), 3))).astype(np.float32)
        gain[CLASSES.index("sky")] = 1
        x = x * np.vstack([gain, np.ones((256 - len(CLASSES), 3), np.float32)])[label]
    green = label == CLASSES.index("vegetation")
    if green.any() and random.random() < 0.35:
        x = _season(x, random, green, label == CLASSES.index("sky"))
    return (np.clip(x, 0, 1) * 255 + 0.5).astype(np.uint8)


def _season(x: _Array, random: np.random.Generator, green: _Array, sky: _Array) -> _Array:
    h, w = green.shape
    grey = x.mean(-1, keepdims=True)
    tint = np.array([random.uniform(0.8, 1.5), random.uniform(0.7, 1.1), random.uniform(0.3, 0.9)], np.float32)
    x = np.where(green[..., None], x + (grey * tint - x) * random.uniform(0.4, 1), x)
    if random.random() < 0.5:
        return x
    # Bare: lines of twigs, and between them what is behind; what is low in the picture is grass and stays.
    twigs = np.full((h, w), np.inf, np.float32)
    for cell in random.uniform(3, 16, 2):
        coarse = random.standard_normal((max(2, int(h / cell)), max(2, int(w / cell))), np.float32)
        twigs = np.minimum(twigs, np.abs(cv2.resize(coarse, (w, h), interpolation=cv2.INTER_CUBIC)))
    behind = x[sky].mean(0) if sky.any() else random.uniform(0.5, 0.95, 3).astype(np.float32)
    through = green & (twigs > random.uniform(0.1, 0.35)) & (np.arange(h)[:, None] < 0.55 * h)
    share = random.uniform(0.4, 0.95)
    return np.asarray(np.where(through[..., None], x * (1 - share) + share * behind, x), np.float32)


def _light(x: _Array, random: np.random.Generator, sky: _Array) -> _Array:
    h, w = x.shape[:2]
    if random.random() < 0.35:  # dusk, backlight, snow, red earth: sky and ground brighter or darker, and tinted, apart
        soft = cv2.GaussianBlur(sky.astype(np.float32), (0, 0), 0.7)[..., None]
        above, below = (np.exp(random.normal(0, 0.4) + random.normal(0, 0.1, 3)).astype(np.float32) for _ in range(2))
        x = x * (soft * above + (1 - soft) * below)
    if random.random() < 0.35:  # a sky as cameras see it: burnt, or of another even colour
        soft = cv2.GaussianBlur(sky.astype(np.float32), (0, 0), random.uniform(0.5, 2))[..., None]
        grey = random.uniform(0.55, 1.05)
        tint = grey * (1 + random.normal(0, 0.05, 3))
        share = soft * random.uniform(0.4, 1)
        x = x * (1 - share) + share * tint.astype(np.float32)
    if random.random() < 0.3:  # a veil of glare or haze, stronger towards one side
        side = random.normal(0, 1, 2)
        ramp = (np.linspace(-1, 1, w)[None] * side[0] + np.linspace(-1, 1, h)[:, None] * side[1])
        veil = random.uniform(0, 0.35) * np.clip(0.5 + 0.4 * ramp, 0, 1)[..., None]
        x = x * (1 - veil) + veil * (random.uniform(0.7, 1) + random.normal(0, 0.03, 3))
    if random.random() < 0.3:
        r2 = np.linspace(-1, 1, w)[None] ** 2 + np.linspace(-1, 1, h)[:, None] ** 2
        x = x * (1 - random.uniform(0, 0.35) * r2 / 2)[..., None]
    if random.random() < 0.25:  # a shadow with a soft edge
        angle, at = random.uniform(0, 2 * np.pi), random.uniform(-0.7, 0.7)
        line = np.linspace(-1, 1, w)[None] * np.cos(angle) + np.linspace(-1, 1, h)[:, None] * np.sin(angle) - at
        x = x * (1 - random.uniform(0.1, 0.6) / (1 + np.exp(-line * random.uniform(5, 60))))[..., None]
    return np.asarray(x, np.float32)


def _tone(x: _Array, random: np.random.Generator) -> _Array:
    x = np.clip(x, 0, None) ** np.exp(random.normal(0, 0.3))
    x = x * np.exp(random.normal(0, 0.3))
    middle = random.uniform(0.3, 0.6)
    x = (x - middle) * np.exp(random.normal(0, 0.25)) + middle + random.normal(0, 0.04)
    return np.clip(x, 0, 1).astype(np.float32)


def _color(x: _Array, random: np.random.Generator) -> _Array:
    x = x * np.exp(random.normal(0, 0.1, 3))
    x = np.clip(x, 0, 1) ** np.exp(random.normal(0, 0.08, 3))
    grey = x @ np.array([0.299, 0.587, 0.114])
    saturation = 0 if random.random() < 0.08 else np.exp(random.normal(0, 0.4))
    x = grey[..., None] + (x - grey[..., None]) * saturation
    angle = random.normal(0, 0.16)  # of hue, about the grey axis
    c, s = np.cos(angle), np.sin(angle) / np.sqrt(3)
    third = (1 - c) / 3
    turn = np.array([[c + third, third - s, third + s], [third + s, c + third, third - s], [third - s, third + s, c + third]])
    return np.asarray(x @ turn.T, np.float32)


def _blur(x: _Array, random: np.random.Generator) -> _Array:
    kind = random.random()
    h, w = x.shape[:2]
    if kind < 0.25:
        return np.asarray(cv2.GaussianBlur(x, (0, 0), random.uniform(0.3, 1.6)))
    if kind < 0.45:
        scale = random.uniform(0.4, 1)
        small = cv2.resize(x, (max(8, int(w * scale)), max(8, int(h * scale))), interpolation=cv2.INTER_AREA)
        return np.asarray(cv2.resize(small, (w, h), interpolation=cv2.INTER_LINEAR))
    if kind < 0.7:
        return np.asarray(x + random.uniform(0.2, 1.2) * (x - cv2.GaussianBlur(x, (0, 0), random.uniform(0.7, 1.5))))
    return x


def _noise(shape: Any, random: np.random.Generator) -> _Array:
    sigma = random.uniform(0, 0.06)
    noise = random.standard_normal(shape, np.float32) * sigma
    if random.random() < 0.5:
        noise = cv2.GaussianBlur(noise, (0, 0), 0.7) * 1.8
    return np.asarray(noise)
