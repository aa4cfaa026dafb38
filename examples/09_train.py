"""Example 9: a dataset as NumPy arrays and as batches for PyTorch, which learns from it to tell sky, ground and the rest.

    PYTHONPATH=build/python /usr/bin/python3 examples/09_train.py [DATASET]

Without a dataset it collects a small one. Without PyTorch (Debian: python3-torch) it fits the same model with NumPy.
"""
import os
import pathlib
import subprocess
import sys
import tempfile
from typing import Any

import numpy as np
import numpy.typing as npt

import airsim360

program = os.environ.get("AIRSIM360", str(pathlib.Path(__file__).resolve().parents[1] / "build/bin/airsim360"))
temporary = tempfile.TemporaryDirectory()
folder = sys.argv[1] if len(sys.argv) > 1 else os.path.join(temporary.name, "town")
if len(sys.argv) == 1:
    subprocess.run([program, "collect", "--world", "map_town", "--frames", "6", "--size", "256x128", "--out", folder],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

frames = airsim360.Dataset(folder)
print(frames)

# Ids of the tree become three classes. In a panorama a pixel near the poles is a small part of the sphere: it counts less.
paths = {number: category["path"] for number, category in frames.categories.items()}
classes = np.zeros(max(paths) + 1, np.int64)
for number, path in paths.items():
    classes[number] = 0 if path.startswith("sky") else 1 if path.startswith("ground") else 2
height = frames.meta["size"][1]
weight = np.cos(np.pi * (0.5 - (np.arange(height) + 0.5) / height)).astype(np.float32)[:, None]


def prepare(sample: dict[str, npt.NDArray[Any]]) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.int64]]:
    """Colour and elevation of every pixel, (H, W, 4) float32, and its class (H, W)."""
    rgb = sample["rgb"].astype(np.float32) / 255
    elevation = np.broadcast_to(np.linspace(1, -1, rgb.shape[0], dtype=np.float32)[:, None, None], (*rgb.shape[:2], 1))
    return np.concatenate([rgb, elevation], -1), classes[sample["semantic"]]


samples = frames.samples("rgb", "semantic", transform=prepare)
train, test = range(len(samples) - 1), len(samples) - 1

try:
    import torch

    loader = torch.utils.data.DataLoader(torch.utils.data.Subset(samples, train), batch_size=2, num_workers=2)
    torch.manual_seed(0)
    model = torch.nn.Sequential(torch.nn.Linear(4, 32), torch.nn.ReLU(), torch.nn.Linear(32, 3))
    optimiser = torch.optim.Adam(model.parameters(), lr=0.02)
    for epoch in range(8):
        for pixels, truth in loader:
            loss = torch.nn.functional.cross_entropy(model(pixels).flatten(0, 2), truth.flatten(), reduction="none")
            loss = (loss.view(truth.shape) * torch.from_numpy(weight)).mean()
            optimiser.zero_grad()
            loss.backward()
            optimiser.step()
    guess = model(torch.from_numpy(samples[test][0])).argmax(-1).numpy()
    print("trained with PyTorch", torch.__version__)
except ImportError:
    # Least squares on the same features and their products.
    def features(pixels: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
        flat = pixels.reshape(-1, 4)
        pairs = [flat[:, i] * flat[:, j] for i in range(4) for j in range(i, 4)]
        return np.column_stack([np.ones(len(flat)), flat, *pairs])

    pixels, truth = (np.stack(part) for part in zip(*(samples[i] for i in train)))
    root = np.sqrt(np.tile(np.broadcast_to(weight, truth.shape[1:]).ravel(), len(truth)))[:, None]
    fit = np.linalg.lstsq(root * features(pixels), root * np.eye(3)[truth.ravel()], rcond=None)[0]
    guess = (features(samples[test][0]) @ fit).argmax(-1).reshape(truth.shape[1:])
    print("PyTorch is not installed: fitted with NumPy")

truth = samples[test][1]
right = np.average(guess == truth, weights=np.broadcast_to(weight, truth.shape))
most = max(np.average(truth == c, weights=np.broadcast_to(weight, truth.shape)) for c in range(3))
print(f"a frame that was not trained on: {right:.1%} of the sphere right; always the most frequent class: {most:.1%}")
sys.exit(int(right < most))
