#!/usr/bin/env python3
"""Does our crowd teach a predictor how people walk? Measured on the walks of ETH and UCY, leave one scene out.

    PYTHONPATH=build/python /usr/bin/python3 bench/walks.py draw --world downtown_west --people 150 --seconds 300 --out ours.txt
    PYTHONPATH=build/python /usr/bin/python3 bench/walks.py count ours.txt
    PYTHONPATH=build/python /usr/bin/python3 bench/walks.py table --ours ours.txt [more.txt ...] --real FOLDER [--seeds 3]

A file of walks has a line `moment person x y` for each person and moment, metres, 0.4 s apart, as those of ETH and UCY have it.
FOLDER holds biwi_eth.txt, biwi_hotel.txt, crowds_zara01.txt, crowds_zara02.txt, students001.txt and students003.txt (`datasets/raw/all_data` of
abduallahmohamed/Social-STGCNN, for example; not part of this repository). 8 moments are seen, the next 12 told; a walk is 20 moments of
a person without a gap. The error is the mean distance over the 12 (ADE) and that at the last one (FDE). The predictor tells what is to
be added to walking on as in the last step; it sees the person's own 8 moments and the nearest eight others, all turned to the person's
heading.
"""
import argparse
import math
import statistics
import sys
from pathlib import Path

import numpy as np
import torch
from torch import nn

SEEN, TOLD, STEP, NEAREST = 8, 12, 0.4, 8
SCENES = {"eth": ["biwi_eth"], "hotel": ["biwi_hotel"], "univ": ["students001", "students003"], "zara1": ["crowds_zara01"], "zara2": ["crowds_zara02"]}
STUDENT = {2: 12.71, 3: 4.30, 4: 3.18, 5: 2.78}  # 97.5 % of t with n - 1 degrees of freedom


def draw(a):
    """Walks of our crowd."""
    import airsim360
    sim = airsim360.Simulation(airsim360.World(a.world, seed=a.seed), people=a.people, seed=a.seed, dt=0.002)
    with open(a.out, "w", encoding="utf-8") as out:
        for moment in range(round(a.seconds / STEP)):
            for person in sim.people:
                if person["locomotion"] != "sit":
                    out.write(f"{moment} {person['entity']} {person['position'][0]:.3f} {person['position'][1]:.3f}\n")
            sim.step(round(STEP / 0.002))


def walks(path):
    """(n, 20, 2) walks, and (n, NEAREST, 8, 2) of the nearest others, NaN where there are fewer."""
    rows = np.loadtxt(path)
    moments = np.unique(rows[:, 0])
    pace = np.median(np.diff(moments))
    place = {(round(m / pace), int(who)): (x, y) for m, who, x, y in rows}
    at = {}
    for (m, who), p in place.items():
        at.setdefault(m, {})[who] = p
    own, others = [], []
    for m, now in at.items():
        for who in now:
            if not all((m + k, who) in place for k in range(SEEN + TOLD)):
                continue
            own.append([place[m + k, who] for k in range(SEEN + TOLD)])
            last = at[m + SEEN - 1]
            near = sorted((q for q in last if q != who), key=lambda q: math.dist(last[q], last[who]))[:NEAREST]
            track = [[place.get((m + k, q), (np.nan, np.nan)) for k in range(SEEN)] for q in near]
            others.append(track + [[(np.nan, np.nan)] * SEEN] * (NEAREST - len(near)))
    return np.array(own).reshape(-1, SEEN + TOLD, 2), np.array(others).reshape(-1, NEAREST, SEEN, 2)


def joined(parts):
    return tuple(np.concatenate(each) for each in zip(*parts))


def straight(own):
    """Walking on as in the last step: (n, 12, 2)."""
    return own[:, SEEN - 1:SEEN] + np.arange(1, TOLD + 1)[None, :, None] * (own[:, SEEN - 1:SEEN] - own[:, SEEN - 2:SEEN - 1])


def error(told, own):
    """ADE and FDE of every walk."""
    apart = np.linalg.norm(told - own[:, SEEN:], axis=-1)
    return apart.mean(1), apart[:, -1]


class Predictor(nn.Module):
    """(B, 8, 2) own, (B, 8, 8, 2) others, both in the frame of the last moment and heading -> (B, 12, 2) to be added."""

    def __init__(self, width=64):
        super().__init__()
        self.own = nn.Sequential(nn.Linear(2 * SEEN, width), nn.ReLU(), nn.Linear(width, width), nn.ReLU())
        self.other = nn.Sequential(nn.Linear(6, width), nn.ReLU(), nn.Linear(width, width), nn.ReLU())
        self.told = nn.Sequential(nn.Linear(2 * width, width), nn.ReLU(), nn.Dropout(0.1), nn.Linear(width, 2 * TOLD))

    def forward(self, own, others):
        known = ~torch.isnan(others).any(-1).any(-1)
        near = torch.nan_to_num(others)
        place, pace = near[:, :, -1], (near[:, :, -1] - near[:, :, -3]) / (2 * STEP)
        far = place.norm(dim=-1, keepdim=True)
        features = torch.cat([place / (1 + far), pace, 1 / (0.5 + far), far.clamp(max=10) / 5], -1)
        pooled = (self.other(features) * (known & (far[..., 0] < 8))[..., None]).amax(2 - 1)
        pace = (own[:, -1] - own[:, 0]).norm(dim=-1) / ((SEEN - 1) * STEP)
        more = self.told(torch.cat([self.own((own / 2).flatten(1)), pooled], 1)).reshape(-1, TOLD, 2)
        return more * (pace / (pace + 0.1))[:, None, None]  # who stands is left standing


def framed(own, others):
    """In the person's frame: the last moment is the origin, the way of the last three steps +x. And what turns back."""
    ahead = own[:, SEEN - 1] - own[:, SEEN - 4]
    length = np.linalg.norm(ahead, axis=-1, keepdims=True)
    ahead = np.where(length > 1e-6, ahead / np.maximum(length, 1e-6), [1.0, 0])
    turn = np.stack([np.stack([ahead[:, 0], -ahead[:, 1]], -1), np.stack([ahead[:, 1], ahead[:, 0]], -1)], 1)  # frame -> world
    origin = own[:, SEEN - 1]
    return np.einsum("nki,nij->nkj", own - origin[:, None], turn), np.einsum("nqki,nij->nqkj", others - origin[:, None, None], turn), turn


def train(data, shares, steps, seed, batch=256):
    """A predictor trained on sets of walks, drawn by their shares."""
    torch.manual_seed(seed)
    random = np.random.default_rng(seed)
    model = Predictor()
    optimizer = torch.optim.AdamW(model.parameters(), lr=2e-3, weight_decay=1e-3)
    sets = [[torch.from_numpy(np.asarray(x, np.float32)) for x in framed(*each)[:2]] for each in data]
    for step in range(steps):
        for group in optimizer.param_groups:
            group["lr"] = 2e-3 * 0.5 * (1 + math.cos(math.pi * step / steps))
        parts = []
        for (own, others), share in zip(sets, shares):
            pick = random.integers(len(own), size=max(1, round(batch * share)))
            parts.append((own[pick], others[pick]))
        own, others = (torch.cat(x) for x in zip(*parts))
        size = torch.from_numpy(np.exp(random.normal(0, 0.15, (len(own), 1, 1))).astype(np.float32))
        flip = torch.tensor([1.0, -1.0]) ** torch.from_numpy(random.integers(2, size=(len(own), 1)).astype(np.float32))
        own, others = own * size * flip[:, None], others * size[..., None] * flip[:, None, None]
        jitter = torch.from_numpy(random.normal(0, 0.02, (len(own), SEEN, 2)).astype(np.float32))
        seen = own[:, :SEEN] + jitter
        seen = seen - seen[:, -1:]
        told = seen[:, -1:] + torch.arange(1, TOLD + 1)[None, :, None] * (seen[:, -1:] - seen[:, -2:-1]) + model(seen, others)
        loss = (told - own[:, SEEN:]).pow(2).sum(-1).add(1e-4).sqrt().mean()
        optimizer.zero_grad()
        loss.backward()
        optimizer.step()
    return model.eval()


def predicted(model, own, others):
    seen, near, turn = framed(own, others)
    with torch.no_grad():
        more = model(torch.from_numpy(seen[:, :SEEN].astype(np.float32)), torch.from_numpy(near.astype(np.float32))).numpy()
    return straight(own) + np.einsum("nkj,nij->nki", more, turn)


def some(data, count, seed):
    """`count` walks of a set."""
    pick = np.random.default_rng(seed).choice(len(data[0]), size=min(count, len(data[0])), replace=False)
    return data[0][pick], data[1][pick]


def table(a):
    ours = joined([walks(path) for path in a.ours])
    moving = np.linalg.norm(ours[0][:, SEEN - 1] - ours[0][:, 0], axis=-1) > a.moving
    ours = some((ours[0][moving], ours[1][moving]), a.most, 0)
    print(f"{len(ours[0])} walks of ours", file=sys.stderr)
    real = {name: joined([walks(a.real / f"{file}.txt") for file in files]) for name, files in SCENES.items()}
    rows = {"walking on as in the last step": None, "our crowd alone": ([ours], [1]), "50 real walks": 50, "50 real walks and ours": (50, ours),
            "all real walks of the other scenes": 0, "all of them and ours": (0, ours)}
    print("| trained on | " + " | ".join(f"{name} ({len(real[name][0])})" for name in real) + " | mean | ± |\n|---|" + "--:|" * (len(real) + 2))
    for name, what in rows.items():
        cells, means = [], []
        for seed in range(a.seeds if what else 1):
            found, everywhere = [], None
            for held in real:
                rest = joined([each for other, each in real.items() if other != held])
                own, others = real[held]
                if what is None:
                    told = straight(own)
                else:
                    data, shares = chosen(what, rest, seed)
                    model = everywhere or train(data, shares, a.steps, seed)
                    everywhere = model if len(data) == 1 and data[0] is ours else None  # ours has no scene to leave out
                    told = predicted(model, own, others)
                found.append([e.mean() for e in error(told, own)])
            cells.append(found)
            means.append(np.mean(found, 0)[0])
        found = np.mean(cells, 0)
        spread = STUDENT.get(len(means), 2.6) * statistics.stdev(means) / math.sqrt(len(means)) if len(means) > 1 else 0
        print(f"| {name} | " + " | ".join(f"{ade:.2f} / {fde:.2f}" for ade, fde in found) + f" | {found.mean(0)[0]:.3f} / {found.mean(0)[1]:.3f} | {spread:.3f} |", flush=True)


def count(a):
    """How people walk: speeds, who stands, turns, distances, stops."""
    print("| | speed of who walks, m/s | stand | error of walking on for who stands, m | turn in 4.8 s, median, 90th percentile | nearest other, m | stop |\n|---|" + "--:|" * 6)
    for path in a.walks:
        own, others = walks(path)
        length = np.linalg.norm(np.diff(own, axis=1), axis=-1).sum(1)
        speed = length / (STEP * (SEEN + TOLD - 1))
        stands = speed < 0.3
        before, after = own[:, SEEN - 1] - own[:, SEEN - 4], own[:, -1] - own[:, -4]
        goes = np.minimum(np.linalg.norm(before, axis=-1), np.linalg.norm(after, axis=-1)) > 0.5 * 3 * STEP
        turn = np.abs(np.degrees(np.angle((after @ [1, 1j])[goes] / (before @ [1, 1j])[goes])))
        near = np.nanmedian(np.linalg.norm(others[:, 0, -1] - own[:, SEEN - 1], axis=-1))
        went = np.linalg.norm(own[:, SEEN - 1] - own[:, 0], axis=-1) > 0.6 * STEP * (SEEN - 1)
        stops = went & (np.linalg.norm(own[:, -1] - own[:, SEEN], axis=-1) < 0.2 * STEP * (TOLD - 1))
        print(f"| {path.stem} | {np.median(speed[~stands]):.2f} | {stands.mean():.2f} | {error(straight(own), own)[0][stands].mean():.2f} | "
              f"{np.median(turn):.0f}°, {np.percentile(turn, 90):.0f}° | {near:.1f} | {100 * stops.mean():.1f} % |")


def chosen(what, rest, seed):
    if isinstance(what, tuple) and isinstance(what[0], list):
        return what
    count, ours = what if isinstance(what, tuple) else (what, None)
    real = some(rest, count, seed) if count else rest
    return ([real], [1]) if ours is None else ([real, ours], [0.5, 0.5])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    actions = parser.add_subparsers(dest="action", required=True)
    drawing = actions.add_parser("draw", help="walks of our crowd")
    drawing.add_argument("--world", default="downtown_west")
    drawing.add_argument("--people", type=int, default=150)
    drawing.add_argument("--seconds", type=float, default=300)
    drawing.add_argument("--seed", type=int, default=0)
    drawing.add_argument("--out", type=Path, required=True)
    counted = actions.add_parser("count", help="how people walk, in figures")
    counted.add_argument("walks", type=Path, nargs="+")
    told = actions.add_parser("table", help="errors on real walks")
    told.add_argument("--ours", type=Path, nargs="+", required=True)
    told.add_argument("--real", type=Path, required=True)
    told.add_argument("--seeds", type=int, default=3)
    told.add_argument("--steps", type=int, default=1500)
    told.add_argument("--moving", type=float, default=0.0, help="walks of ours that went so many metres at least while they were seen")
    told.add_argument("--most", type=int, default=20000, help="so many walks of ours")
    a = parser.parse_args()
    torch.set_num_threads(1)
    {"draw": draw, "count": count, "table": table}[a.action](a)


if __name__ == "__main__":
    main()
