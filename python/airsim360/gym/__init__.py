"""Reinforcement learning with Gymnasium's API; Gymnasium itself is used where installed and not needed.

    import airsim360.gym as gym
    env = gym.make_vec("reach", world="box_room", num_envs=8, seed=0)
    observations, info = env.reset(seed=0)
    observations, rewards, terminated, truncated, info = env.step(env.action_space.sample())

Tasks: "reach" (fly to a point), "avoid" (the same with something between), "search" (find a thing, see it from near).
Observations are a dictionary: the panoramas asked for ("rgb", "range", "semantic", "entity") and "state", 17 numbers
(docs/guide/gym.md). They are views of the environment's own arrays: the next step writes over them; copy what you keep,
or give copy=True. Where Gymnasium is installed, importing this module registers airsim360/Reach-v0, airsim360/Avoid-v0 and
airsim360/Search-v0 with it.
"""
from .environments import Env, VectorEnv, make, make_vec
from .gymnasium_stand_ins import HAS_GYMNASIUM, Box, Dict

__all__ = ["Box", "Dict", "Env", "HAS_GYMNASIUM", "VectorEnv", "make", "make_vec"]


def _register() -> None:
    """Names for gymnasium.make and make_vec: airsim360/Reach-v0, airsim360/Avoid-v0, airsim360/Search-v0."""
    import gymnasium
    for task in ("reach", "avoid", "search"):
        gymnasium.register(id=f"airsim360/{task.capitalize()}-v0", entry_point="airsim360.gym:Env",
                           vector_entry_point="airsim360.gym:VectorEnv", kwargs={"task": task})


if HAS_GYMNASIUM:
    _register()
