"""Frames of a plan on demand: seconds to the first one, frames a second, from the cache, and with two workers.

    PYTHONPATH=build/python /usr/bin/python3 bench/on_demand.py [--world downtown_west] [--size 2048x1024] [--tiers labels,fast]

Frames of one sky are taken in order. Workers have one thread each, as has the process that they are compared with; worlds are
opened before the workers are forked. The median of three rounds counts.
"""
import argparse
import multiprocessing
import statistics
import tempfile
import time

from airsim360.data import Panoramas


def take(panoramas, frames):
    start = time.monotonic()
    for i in frames:
        panoramas[i]
    return time.monotonic() - start


def two_workers(panoramas, frames):
    """Seconds of both together, from the first frame on."""
    context = multiprocessing.get_context("fork")
    with context.Pool(2) as pool:
        pool.starmap(take, [(panoramas, frames[:1])] * 2, chunksize=1)
        start = time.monotonic()
        pool.starmap(take, [(panoramas, frames[0::2]), (panoramas, frames[1::2])], chunksize=1)
        return time.monotonic() - start


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--world", default="downtown_west")
    parser.add_argument("--size", default="2048x1024")
    parser.add_argument("--tiers", default="labels,fast")
    parser.add_argument("--frames", type=int, default=16)
    given = parser.parse_args()
    frames = list(range(given.frames))
    with tempfile.TemporaryDirectory() as folder:
        for tier in given.tiers.split(","):
            start = time.monotonic()
            options = dict(world=given.world, frames=1000, size=given.size, tier=tier)
            panoramas = Panoramas("omni360-scene", cache=f"{folder}/{tier}", **options)
            planned = time.monotonic()
            panoramas[0]
            first = time.monotonic()
            print(f"{tier}: plan {planned - start:.2f} s, first frame {first - planned:.2f} s")
            plain = Panoramas("omni360-scene", cache=False, **options)
            take(plain, frames[:1])
            print(f"{tier}: {len(frames) / statistics.median(take(plain, frames) for _ in range(3)):.2f} frames/s on all threads")
            take(panoramas, frames)
            kept = Panoramas("omni360-scene", cache=f"{folder}/{tier}", **options)
            start = time.monotonic()
            kept[0]
            print(f"{tier}: from the cache: first {time.monotonic() - start:.3f} s, "
                  f"{len(frames) / statistics.median(take(kept, frames) for _ in range(3)):.1f} frames/s")
            if tier == "labels":
                one = Panoramas("omni360-scene", cache=False, threads=1, **options)
                take(one, frames[:1])
                alone = [take(one, frames) for _ in range(3)]
                both = [two_workers(one, frames) for _ in range(3)]
                print(f"{tier}: one thread {len(frames) / statistics.median(alone):.2f} frames/s, two workers "
                      f"{len(frames) / statistics.median(both):.2f}: {statistics.median(alone) / statistics.median(both):.2f} times")


if __name__ == "__main__":
    main()
