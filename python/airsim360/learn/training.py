"""The loop that trains: batches are pure functions of (seed, step), so that a run goes on after an interruption as if there had been
none, and the same seed gives the same weights on the CPU with one thread count."""
from __future__ import annotations

import json
import math
import os
import sys
import time
from pathlib import Path
from typing import Any, Callable, Dict, Mapping, Optional

import numpy as np
import torch

__all__ = ["PRECISIONS", "Schedule", "device_of", "load_model", "precision_of", "read_checkpoint", "train", "write_checkpoint"]

PRECISIONS = ("auto", "float32", "bfloat16")

FORMAT = "airsim360.learn 1"


class Schedule:
    """How long and how fast: AdamW with a warm-up of 2 % and a cosine to zero; weights are averaged over about `average` steps."""

    def __init__(self, steps: int, rate: float, average: int = 300, decay: float = 0.02, save_seconds: float = 60) -> None:
        if not 1 <= steps <= 10_000_000:
            raise ValueError(f"--steps: {steps}; give 1 to 10000000")
        self.steps, self.top, self.average, self.decay, self.save_seconds = steps, rate, average, decay, save_seconds

    def rate(self, step: int) -> float:
        """Of learning, at a step."""
        warm = max(1, self.steps // 50)
        return self.top * min(1, (step + 1) / warm) * 0.5 * (1 + math.cos(math.pi * step / self.steps))


def device_of(name: str) -> torch.device:
    """auto: CUDA where torch has it."""
    if name == "auto":
        name = "cuda" if torch.cuda.is_available() else "cpu"
    if name.startswith("cuda") and not torch.cuda.is_available():
        raise ValueError("--device cuda: torch finds no CUDA device here")
    return torch.device(name)


def precision_of(name: str, device: torch.device) -> str:
    """float32 or bfloat16, in which activations are kept; auto: bfloat16 on a CPU that has instructions for it, where it is nearly twice as fast."""
    if name not in PRECISIONS:
        raise ValueError(f"--precision: {name!r}; give {', '.join(PRECISIONS)}")
    if name != "auto":
        return name
    words = Path("/proc/cpuinfo")
    return "bfloat16" if device.type == "cpu" and words.exists() and "avx512_bf16" in words.read_text(encoding="utf-8") else "float32"


class _Steps(torch.utils.data.Dataset):  # type: ignore[misc]
    def __init__(self, batch: Callable[[int, np.random.Generator], Any], seed: int, first: int, steps: int) -> None:
        self.batch, self.seed, self.first, self.steps = batch, seed, first, steps

    def __len__(self) -> int:
        return self.steps - self.first

    def __getitem__(self, i: int) -> Any:
        if i >= len(self):
            raise IndexError(i)
        step = self.first + i
        return self.batch(step, np.random.default_rng([self.seed, step]))


def train(out: Path, about: Dict[str, Any], make: Callable[[], Any], batch: Callable[[int, np.random.Generator], Any],
          loss: Callable[[Any, Any], Any], schedule: Schedule, *, seed: int, device: torch.device, workers: int = 1, precision: str = "float32") -> Any:
    """Trains what `make` makes on what `batch` gives, and writes OUT/model.pt every minute; returns the model with averaged weights.

    `about` tells one run from another: OUT/last.pt of another is refused. loss(model, batch on the device) -> scalar. With `precision`
    bfloat16 the model's activations are; weights, their averages and the loss stay float32.
    """
    out.mkdir(parents=True, exist_ok=True)
    about = {**about, "steps": schedule.steps, "seed": seed, "precision": precision}
    torch.manual_seed(seed)
    coarse = precision == "bfloat16"
    layout = torch.channels_last if coarse else torch.contiguous_format  # the faster one of each
    model = make().to(device, memory_format=layout)

    def forward(x: Any) -> Any:
        with torch.autocast(device.type, dtype=torch.bfloat16, enabled=coarse):
            found = model(x.contiguous(memory_format=layout))
        return found.float()
    averaged = {k: v.detach().clone() for k, v in model.state_dict().items()}
    optimizer = torch.optim.AdamW(model.parameters(), lr=schedule.top, weight_decay=schedule.decay)
    first = 0
    if (out / "last.pt").exists():
        state = read_checkpoint(out / "last.pt")
        if state["about"] != json.dumps(about, sort_keys=True):
            raise ValueError(f"{out}: holds a run with other options ({state['about']}); choose another folder")
        model.load_state_dict(state["model"])
        optimizer.load_state_dict({"state": state["optimizer"], "param_groups": optimizer.state_dict()["param_groups"]})
        averaged, first = {k: v.to(device) for k, v in state["averaged"].items()}, state["step"]
        print(f"goes on at step {first}", file=sys.stderr, flush=True)
    began = saved = told = time.monotonic()
    mean: Optional[float] = None
    loader = torch.utils.data.DataLoader(_Steps(batch, seed, first, schedule.steps), batch_size=None, num_workers=workers)
    model.train()
    for step, data in enumerate(loader, first):
        for group in optimizer.param_groups:
            group["lr"] = schedule.rate(step)
        value = loss(forward, [part.to(device) for part in data])
        optimizer.zero_grad(set_to_none=True)
        value.backward()
        torch.nn.utils.clip_grad_norm_(model.parameters(), 2.0)
        optimizer.step()
        keep = min(1 - 1 / schedule.average, (1 + step) / (10 + step))
        for k, v in model.state_dict().items():
            averaged[k].lerp_(v, 1 - keep) if v.is_floating_point() else averaged[k].copy_(v)
        now = time.monotonic()
        if not math.isfinite(float(value.detach())):
            raise RuntimeError(f"step {step}: the loss is {float(value.detach())}; try a lower --rate")
        mean = float(value.detach()) if mean is None else 0.98 * mean + 0.02 * float(value.detach())
        if now - told > 10 or step + 1 == schedule.steps:
            left = (now - began) / (step + 1 - first) * (schedule.steps - step - 1)
            print(f"step {step + 1}/{schedule.steps}, loss {mean:.4f}, {left / 60:.1f} min left", file=sys.stderr, flush=True)
            told = now
        if now - saved > schedule.save_seconds or step + 1 == schedule.steps:
            write_checkpoint(out / "last.pt", {"about": json.dumps(about, sort_keys=True), "model": model.state_dict(), "step": step + 1,
                                               "optimizer": optimizer.state_dict()["state"], "averaged": averaged})
            write_checkpoint(out / "model.pt", {"about": json.dumps(about, sort_keys=True), "model": {k: v.cpu() for k, v in averaged.items()}})
            saved = now
    model.load_state_dict(averaged)
    return model.eval()


def write_checkpoint(path: Path, state: Mapping[str, Any]) -> None:
    """By a temporary name, so that a kill leaves the one before. Tensors, whole numbers and text: torch 1.13 reads no other without running code."""
    part = path.with_name(path.name + ".part")
    torch.save({"format": FORMAT, **state}, part)
    os.replace(part, path)


def read_checkpoint(path: Path) -> Dict[str, Any]:
    """What write_checkpoint wrote: tensors, numbers and text alone, nothing in it is run. ValueError for another file."""
    try:
        state = torch.load(path, map_location="cpu", weights_only=True)
    except FileNotFoundError:
        raise ValueError(f"{path}: no such file; `train --out {path.parent}` makes it") from None
    except Exception as error:  # torch raises many kinds for damaged files
        raise ValueError(f"{path}: not a checkpoint of airsim360.learn ({type(error).__name__})") from None
    if not isinstance(state, dict) or state.get("format") != FORMAT:
        raise ValueError(f"{path}: not a checkpoint of airsim360.learn")
    return state


def load_model(path: Path, task: str, make: Callable[[Dict[str, Any]], Any], device: torch.device) -> Any:
    """The model of OUT/model.pt (or OUT) of a task, ready to be applied."""
    path = path / "model.pt" if path.is_dir() else path
    state = read_checkpoint(path)
    about = json.loads(state["about"])
    if about.get("task") != task:
        raise ValueError(f"{path}: a model of {about.get('task')}, not of {task}")
    model = make(about)
    model.load_state_dict(state["model"])
    return model.to(device).eval()
