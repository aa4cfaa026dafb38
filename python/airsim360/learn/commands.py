"""The commands of `python3 -m airsim360.learn` and their flags; nothing here needs torch."""
from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import Any, Dict, List, Optional, Sequence

from .classes import WORLDS

__all__ = ["main"]


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Exit status: 0, 1 for failures, 2 for bad input."""
    parsed = _parser().parse_args(arguments)
    try:
        from .run_commands import run
    except ImportError as error:
        print(f"error: learn needs Debian's python3-torch and python3-opencv ({error}): apt-get install python3-torch python3-opencv", file=sys.stderr)
        return 1
    try:
        result = run(parsed)
    except (ValueError, KeyError) as error:
        print(f"error: {error.args[0] if error.args else error}", file=sys.stderr)
        return 2
    except (RuntimeError, OSError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    print(json.dumps(result) if parsed.json else _lines(result))
    return 0


def _lines(result: Dict[str, Any], indent: str = "") -> str:
    lines: List[str] = []
    for key, value in result.items():
        if isinstance(value, dict):
            lines += [f"{indent}{key}:", _lines(value, indent + "  ")]
        else:
            lines.append(f"{indent}{key}: {value:.4g}" if isinstance(value, float) else f"{indent}{key}: {value}")
    return "\n".join(lines)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="airsim360 learn", description="Reference programs that learn to see from our worlds (docs/guide/learning.md).")
    tasks = parser.add_subparsers(dest="task", required=True)
    frames = tasks.add_parser("frames", help="draw training frames")
    frames.add_argument("--out", type=Path, required=True, help="folder of frames; the same command goes on after an interruption")
    _drawing(frames)
    _machine(frames)
    for task, what, steps in (("segment", "classes of outdoor pictures", 5000), ("depth", "range of panoramas", 3000),
                              ("attitude", "which way is up in a panorama", 3000)):
        actions = tasks.add_parser(task, help=what).add_subparsers(dest="action", required=True)
        _train_parser(actions.add_parser("train", help="train on frames of ours"), task, steps)
        _apply_parser(actions.add_parser("apply", help="look at pictures"), task)
        _eval_parser(actions.add_parser("eval", help="measure a model"), task)
    return parser


def _machine(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--threads", type=int, default=0, help="of drawing and of the network (0: all cores)")
    parser.add_argument("--device", default="auto", help="auto, cpu or cuda")
    parser.add_argument("--json", action="store_true", help="machine-readable result")


def _drawing(parser: argparse.ArgumentParser, width: int = 1280) -> None:
    parser.add_argument("--draw-worlds", default=",".join(WORLDS), help="worlds that are drawn")
    parser.add_argument("--draw", type=int, default=1000, help="how many frames")
    parser.add_argument("--width", type=int, default=width, help=f"of the panoramas, pixels ({width})")
    parser.add_argument("--skies-of", type=int, default=16, help="consecutive frames that share a sky")
    parser.add_argument("--clean", action="store_true", help="without the look of a camera")
    parser.add_argument("--tier", choices=("fast", "high"), default="fast", help="how frames are drawn (fast)")
    parser.add_argument("--seed", type=int, default=0, help="of everything random")


def _choosing(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--worlds", default="", help="frames of these worlds alone: name,name")
    parser.add_argument("--without", default="", help="no frames of these worlds")
    parser.add_argument("--no-people", action="store_true", help="no frames among people")
    parser.add_argument("--skies", type=int, default=0, help="frames of so many skies of each world (0: all)")
    parser.add_argument("--most", type=int, default=0, help="so many frames at most (0: all)")


def _train_parser(parser: argparse.ArgumentParser, task: str, steps: int) -> None:
    parser.add_argument("--out", type=Path, required=True, help="folder of model.pt and last.pt; the same command goes on after an interruption")
    parser.add_argument("--frames", type=Path, help="folder of `learn frames` (OUT/frames, drawn first)")
    parser.add_argument("--steps", type=int, default=steps, help=f"of training ({steps})")
    size = {"segment": 224, "depth": 128, "attitude": 64}[task]
    parser.add_argument("--size", type=int, default=size, help=f"side of crops, height of panoramas ({size})")
    parser.add_argument("--rate", type=float, default=2e-3, help="of learning, at most (0.002)")
    parser.add_argument("--augment", default="all", help="domain randomisation: all, none, or a list of color, tone, blur, noise, jpeg, light, surface")
    parser.add_argument("--precision", default="auto", help="of activations: float32, bfloat16 or auto, what is faster on this CPU")
    if task == "segment":
        parser.add_argument("--level-views", action="store_true", help="all crops level, 70 degrees wide")
    if task == "attitude":
        parser.add_argument("--photographs", nargs="*", type=Path, default=[], help="level panoramas of yours that join the batches")
        parser.add_argument("--share", type=float, default=0.3, help="of the batches that they have (0.3; 1: they alone)")
    parser.add_argument("--workers", type=int, default=1, help="processes that prepare batches")
    _choosing(parser)
    _drawing(parser, 1280 if task == "segment" else 512)
    _machine(parser)


def _apply_parser(parser: argparse.ArgumentParser, task: str) -> None:
    parser.add_argument("pictures", nargs="+", type=Path, help="JPEG, PNG or EXR files")
    parser.add_argument("--model", type=Path, required=True, help="folder of `train`, or its model.pt")
    parser.add_argument("--out", type=Path, required=task != "attitude", help="folder of results")
    if task == "segment":
        parser.add_argument("--projection", choices=("photo", "erp"), default="photo", help="photographs, or panoramas")
        parser.add_argument("--other", type=float, default=0.5, help="share from which a pixel is none of the seven classes (0.5; 1: never)")
        parser.add_argument("--boundaries", action="store_true", help="NAME_boundary.png too: where another entity begins, 0 to 255")
        parser.add_argument("--overlay", action="store_true", help="NAME_overlay.jpg too: the classes over the picture")
    _machine(parser)


def _eval_parser(parser: argparse.ArgumentParser, task: str) -> None:
    if task == "attitude":
        parser.add_argument("pictures", nargs="+", type=Path, help="level panoramas, which are turned")
        parser.add_argument("--turns", type=int, default=4, help="of each (4)")
        parser.add_argument("--tilt", type=float, default=180, help="degrees that they are tilted at most (180)")
        parser.add_argument("--seed", type=int, default=0, help="of the turns")
    else:
        parser.add_argument("--frames", type=Path, required=True, help="folder of `learn frames`")
        _choosing(parser)
    parser.add_argument("--model", type=Path, required=True, help="folder of `train`, or its model.pt")
    _machine(parser)
