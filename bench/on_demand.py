"""Frames of a plan on demand: seconds to the first one, frames a second, from the cache, and with two workers.

    PYTHONPATH=build/python /usr/bin/python3 bench/on_demand.py [--world downtown_west] [--size 2048x1024] [--tiers labels,fast]

Frames of one sky are taken in order. Workers have one thread each; one of them is compared with two. Their worlds are opened before
they are forked, so they share them. Medians of rounds.
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


def work(panoramas, frames, barrier, queue):
    barrier.wait()
    cpu = time.process_time()
    take(panoramas, frames)
    queue.put(time.process_time() - cpu)


def workers(panoramas, parts):
    """Seconds of forked workers together, one for each part, and their CPU seconds. They go on with the worlds of this process."""
    context = multiprocessing.get_context("fork")
    barrier, queue = context.Barrier(len(parts) + 1), context.Queue()
    processes = [context.Process(target=work, args=(panoramas, part, barrier, queue)) for part in parts]
    for process in processes:
        process.start()
    barrier.wait()
    start = time.monotonic()
    cpu = sum(queue.get() for _ in parts)
    seconds = time.monotonic() - start
    for process in processes:
        process.join()
    return seconds, cpu


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
            options = dict(world=given.world, frames=1000, size=given.size, tier=tier)

            def tell(what, count, action):
                """Frames a second, or seconds of one, and the CPU time of a frame."""
                start, cpu = time.monotonic(), time.process_time()
                result = action()
                seconds, cpu = time.monotonic() - start, (time.process_time() - cpu) / count
                print(f"{tier}: {what}: " + (f"{count / seconds:.2f} frames/s" if count > 1 else f"{seconds:.2f} s") + f", CPU {cpu:.3f} s")
                return result

            panoramas = tell("plan", 1, lambda: Panoramas("omni360-scene", cache=f"{folder}/{tier}", **options))
            tell("first frame", 1, lambda: panoramas[0])
            plain = Panoramas("omni360-scene", cache=False, **options)
            take(plain, frames[:1])
            tell("next frames, all threads", len(frames), lambda: take(plain, frames))
            take(panoramas, frames)
            kept = Panoramas("omni360-scene", cache=f"{folder}/{tier}", **options)
            tell("first frame from the cache", 1, lambda: kept[0])
            tell("next frames from the cache", len(frames), lambda: take(kept, frames))
            if tier == "labels":
                one = Panoramas("omni360-scene", cache=False, threads=1, **options).open()
                take(one, frames[:1])
                rounds = [(workers(one, [frames]), workers(one, [frames[0::2], frames[1::2]])) for _ in range(5)]
                alone, both = (tuple(statistics.median(r[k][i] for r in rounds) for i in (0, 1)) for k in (0, 1))
                print(f"{tier}: one worker {len(frames) / alone[0]:.2f} frames/s, two {len(frames) / both[0]:.2f}: "
                      f"{alone[0] / both[0]:.2f} times; CPU time of a frame {1000 * alone[1] / len(frames):.0f} and "
                      f"{1000 * both[1] / len(frames):.0f} ms")


if __name__ == "__main__":
    main()
