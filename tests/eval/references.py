"""The published definitions of metrics, written again in numpy alone: short, slow, without a line of what they judge."""
import json
import math
import os
import struct
import subprocess
import tempfile
import unittest
import zlib
from pathlib import Path

import numpy as np

PROGRAM = os.environ["AIRSIM360"]


def write_png(path, pixels, bits=8):
    """Gray (H, W), RGB (H, W, 3) or RGBA (H, W, 4)."""
    pixels = np.asarray(pixels)
    height, width = pixels.shape[:2]
    data = pixels.astype(">u2" if bits == 16 else np.uint8)
    raw = b"".join(b"\0" + data[y].tobytes() for y in range(height))

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    header = struct.pack(">IIBBBBB", width, height, bits, {1: 0, 3: 2, 4: 6}[pixels.shape[2] if pixels.ndim == 3 else 1], 0, 0, 0)
    Path(path).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b""))


def write_ids(path, ids):
    ids = np.asarray(ids)
    write_png(path, np.stack([ids % 256, ids // 256 % 256, ids // 65536], -1))


class EvalTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_program(self, *arguments):
        return subprocess.run([PROGRAM, "eval", *map(str, arguments)], capture_output=True, text=True, timeout=300)

    def eval(self, *arguments):
        done = self.run_program(*arguments, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def refuse(self, *arguments, says=()):
        done = self.run_program(*arguments, "--json")
        self.assertEqual(done.returncode, 2, done.stderr + done.stdout)
        for text in says:
            self.assertIn(text, done.stderr)

    def name(self, *arguments, says, refused=None):
        """The likely mistake is named: in the refusal (then also in the warnings with --force), or in the warnings of what is scored."""
        done = self.run_program(*arguments, "--json")
        if refused is not None:
            self.assertEqual(done.returncode, 2 if refused else 0, (says, done.stderr + done.stdout))
        if done.returncode == 2:
            self.assertIn(says, done.stderr)
            self.assertIn("--force", done.stderr)
        scored = self.eval(*arguments, *["--force"] * (done.returncode == 2))
        self.assertIn(says, str(scored["warnings"]))
        return scored

    def write(self, name, value):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(value if isinstance(value, str) else json.dumps(value))
        return path

    def assertSame(self, a, b, what=""):
        if b is None or (isinstance(b, float) and math.isnan(b)):
            self.assertIsNone(a, what)
        else:
            self.assertIsNotNone(a, what)
            self.assertLessEqual(abs(a - b), 1e-9 * max(1.0, abs(b)), f"{what}: {a} {b}")


def row_areas(height, width):
    """Steradians of a pixel of each row."""
    edges = np.pi * (0.5 - np.arange(height + 1) / height)
    return 2 * np.pi / width * (np.sin(edges[:-1]) - np.sin(edges[1:]))


def depth_errors(p, g, w=None, low=0.0, high=np.inf):
    mask = np.isfinite(g) & (g > low) & (g <= high)
    w = np.ones_like(g) if w is None else np.broadcast_to(w, g.shape)
    p, g, w = p[mask].astype(float), g[mask].astype(float), w[mask]
    w = w / w.sum()
    d, n = np.log(p) - np.log(g), len(g)
    ratio = np.maximum(p / g, g / p)
    mean = (w * d).sum()
    return {"absrel": (w * np.abs(p - g) / g).sum(), "sqrel": (w * (p - g) ** 2 / g).sum(), "rmse": np.sqrt((w * (p - g) ** 2).sum()),
            "rmselog": np.sqrt((w * d**2).sum()), "log10": (w * np.abs(np.log10(p) - np.log10(g))).sum(), "mae": (w * np.abs(p - g)).sum(),
            "d1": w[ratio < 1.25].sum(), "d2": w[ratio < 1.25**2].sum(), "d3": w[ratio < 1.25**3].sum(),
            "silog": 100 * np.sqrt((w * (d - mean) ** 2).sum() * n / (n - 1))}


def panoptic_quality(pairs, categories):
    """pairs of (prediction ids, {id: category}, truth ids, {id: (category, crowd)}); {category: (iou, tp, fp, fn)}."""
    counts = {c: [0.0, 0, 0, 0] for c in categories}
    for pred, pred_category, gt, gt_info in pairs:
        matched_p, matched_g = set(), set()
        for g, (category, crowd) in gt_info.items():
            for p, other in pred_category.items():
                if crowd or category != other:
                    continue
                shared = np.sum((gt == g) & (pred == p))
                union = np.sum(gt == g) + np.sum((pred == p) & (gt != 0)) - shared
                if shared / union > 0.5:
                    matched_p.add(p), matched_g.add(g)
                    counts[category][0] += shared / union
                    counts[category][1] += 1
        last_crowd = {}
        for g, (category, crowd) in gt_info.items():
            if crowd:
                last_crowd[category] = g
            elif g not in matched_g:
                counts[category][3] += 1
        for p, category in pred_category.items():
            if p in matched_p:
                continue
            excused = np.sum((pred == p) & ((gt == 0) | (gt == last_crowd.get(category, 0))))
            if excused / np.sum(pred == p) <= 0.5:
                counts[category][2] += 1
    return counts


def mean_quality(counts, chosen):
    values = []
    for c in chosen:
        iou, tp, fp, fn = counts[c]
        if tp + fp + fn:
            values.append((iou / (tp + fp / 2 + fn / 2), iou / tp if tp else 0.0, tp / (tp + fp / 2 + fn / 2)))
    return np.mean(values, 0) if values else (None, None, None)


THRESHOLDS = np.linspace(0.5, 0.95, 10)
SIGMAS = np.array([26, 25, 25, 35, 35, 79, 79, 72, 72, 62, 62, 107, 107, 87, 87, 89, 89]) / 1000  # of COCO's 17 keypoints
AREAS = {"all": (0, 1e10), "small": (0, 32**2), "medium": (32**2, 96**2), "large": (96**2, 1e10)}


def match(overlap, truths, detections, threshold, area):
    """truths (area, crowd, ignore), detections (score, area) by falling score; flags right, ignored of each and how many truths count."""
    ignored = [t[2] or t[1] or not area[0] <= t[0] <= area[1] for t in truths]
    order = sorted(range(len(truths)), key=lambda i: ignored[i])
    taken, result = set(), []
    for d, (_, size) in enumerate(detections):
        best, least = None, min(threshold, 1 - 1e-10)
        for t in order:
            if t in taken and not truths[t][1]:
                continue
            if best is not None and not ignored[best] and ignored[t]:
                break
            if overlap[d][t] >= least:
                best, least = t, overlap[d][t]
        if best is not None:
            taken.add(best)
            result.append((True, ignored[best]))
        else:
            result.append((False, not area[0] <= size <= area[1]))
    return result, sum(not i for i in ignored)


def average_precision(cells, area, most, thresholds=THRESHOLDS):
    """cells: (overlap, truths, detections) of each picture of one category. (precisions (T, 101), recalls (T,)) or None without truths."""
    precisions, recalls = [], []
    for threshold in thresholds:
        scored, total = [], 0
        for overlap, truths, detections in cells:
            order = sorted(range(len(detections)), key=lambda d: -detections[d][0])[:most]
            flags, count = match([overlap[d] for d in order], truths, [detections[d] for d in order], threshold, area)
            total += count
            scored += [(detections[d][0], *flag) for d, flag in zip(order, flags)]
        if total == 0:
            return None
        scored.sort(key=lambda s: -s[0])
        tp = np.cumsum([right and not ignore for _, right, ignore in scored])
        fp = np.cumsum([not right and not ignore for _, right, ignore in scored])
        recall, precision = tp / total, tp / np.maximum(tp + fp, np.spacing(1))
        recalls.append(recall[-1] if len(recall) else 0.0)
        precisions.append([max([p for r, p in zip(recall, precision) if r >= level], default=0.0) for level in np.linspace(0, 1, 101)])
    return np.array(precisions), np.array(recalls)


def coco_summary(cells_by_category, most=(1, 10, 100)):
    def figures(area, m):
        found = [average_precision(cells, AREAS[area], m) for cells in cells_by_category]
        return [f for f in found if f is not None]

    def precision(area, threshold=None):
        found = figures(area, most[-1])
        return np.mean([f[0] if threshold is None else f[0][threshold] for f in found]) if found else -1

    def recall(area, m):
        found = figures(area, m)
        return np.mean([f[1] for f in found]) if found else -1

    return [precision("all"), precision("all", 0), precision("all", 5), precision("small"), precision("medium"), precision("large"),
            *(recall("all", m) for m in most), recall("small", most[-1]), recall("medium", most[-1]), recall("large", most[-1])]


def mask_overlap(d, t, crowd):
    shared = np.sum(d & t)
    union = np.sum(d) if crowd else np.sum(d | t)
    return shared / union if shared else 0.0


def box_overlap(d, t, crowd):
    """Of [x, y, width, height]."""
    d, t = np.array(d), np.array(t)
    size = np.minimum(d[:2] + d[2:], t[:2] + t[2:]) - np.maximum(d[:2], t[:2])
    shared = np.prod(size) if (size > 0).all() else 0.0
    return shared / (np.prod(d[2:]) if crowd else np.prod(d[2:]) + np.prod(t[2:]) - shared) if shared else 0.0


def keypoint_similarity(d, g, area, box, sigmas=SIGMAS):
    """OKS of (n, 3) and (n, 3): cocodataset.org/#keypoints-eval, and pycocotools' rule for truths without labelled points."""
    known = g[:, 2] > 0
    if known.any():
        distance = ((d[:, :2] - g[:, :2]) ** 2).sum(1)
    else:
        x, y, w, h = box
        low, high = np.array([x - w, y - h]), np.array([x + 2 * w, y + 2 * h])
        distance = ((np.maximum(0, low - d[:, :2]) + np.maximum(0, d[:, :2] - high)) ** 2).sum(1)
        known = known | True
    return np.exp(-distance / (2 * (area + np.spacing(1)) * (2 * sigmas) ** 2))[known].mean()


def keypoint_summary(cells):
    full, medium, large = (average_precision(cells, AREAS[a], 20) for a in ("all", "medium", "large"))
    wanted = []
    for part in (0, 1):
        wanted += [full[part].mean(), full[part][0].mean(), full[part][5].mean()] if full else [-1] * 3
        wanted += [f[part].mean() if f else -1 for f in (medium, large)]
    return wanted


def runs(mask):
    """COCO's run lengths: columns first, outside first."""
    flat = mask.flatten(order="F").astype(int)
    edges = np.flatnonzero(np.diff(flat)) + 1
    lengths = np.diff([0, *edges, len(flat)]).tolist()
    return [0, *lengths] if flat[0] else lengths


def compressed(mask):
    text, lengths = "", runs(mask)
    for i, length in enumerate(lengths):
        value = length - (lengths[i - 2] if i > 2 else 0)
        while True:
            group, value = value & 31, value >> 5
            done = value == (-1 if group & 16 else 0)
            text += chr(48 + group + (0 if done else 32))
            if done:
                break
    return text


def time_warping(path, reference):
    table = np.full((len(path) + 1, len(reference) + 1), np.inf)
    table[0, 0] = 0
    for i, p in enumerate(path):
        for j, r in enumerate(reference):
            table[i + 1, j + 1] = np.linalg.norm(np.subtract(p, r)) + min(table[i, j], table[i, j + 1], table[i + 1, j])
    return table[-1, -1]


def path_length(path):
    return sum(np.linalg.norm(np.subtract(a, b)) for a, b in zip(path[1:], path))
