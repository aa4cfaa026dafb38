"""Vector environments: steps a second with 1, 2, … threads, and the time of a reset. Ratios of one run count.

    PYTHONPATH=build/python /usr/bin/python3 bench/gym_bench.py [WORLD] [--envs 8] [--width 128] [--tier fast] [--json]

Varied: threads. The same: world, task, seeds, actions. Every figure is the best of three rounds.
"""
import argparse
import json
import os
import time

import numpy as np

import airsim360
import airsim360.gym as gym


def best(rounds, call):
    times = []
    for _ in range(rounds):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return min(times)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("world", nargs="?", default="box_room")
    parser.add_argument("--envs", type=int, default=8)
    parser.add_argument("--width", type=int, default=128)
    parser.add_argument("--tier", default="fast")
    parser.add_argument("--steps", type=int, default=50)
    parser.add_argument("--json", action="store_true")
    a = parser.parse_args()
    world = airsim360.World(a.world)
    env = gym.make_vec("reach", world=world, num_envs=a.envs, width=a.width, tier=a.tier)
    actions = np.random.default_rng(1).uniform(-1, 1, (a.steps, a.envs, 4)).astype(np.float32)

    def run():
        env.reset(seed=1)
        for action in actions:
            env.step(action)

    rates, threads = {}, 1
    while threads <= (os.cpu_count() or 1):
        with airsim360.Threads(threads):
            run()
            rates[threads] = a.steps * a.envs / best(3, run)
        threads *= 2
    reset = best(5, lambda: env.reset(seed=2)) * 1e3
    result = {"world": a.world, "envs": a.envs, "width": a.width, "tier": a.tier, "steps_per_second": rates,
              "scaling": {n: rate / rates[1] / n for n, rate in rates.items()}, "reset_ms_all": reset,
              "reset_ms_one": reset / a.envs}
    if a.json:
        print(json.dumps(result))
        return
    for n, rate in rates.items():
        print(f"{n} threads: {rate:.0f} environment steps a second, {rate / rates[1] / n:.2f} of {n} times one thread")
    print(f"reset of all {a.envs}: {reset:.2f} ms")


if __name__ == "__main__":
    main()
