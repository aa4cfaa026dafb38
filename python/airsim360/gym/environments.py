"""Env and VectorEnv over the native vector environment."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, Iterable, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

import airsim360

from .._words import did_you_mean
from . import gymnasium_stand_ins as spaces

if TYPE_CHECKING:
    from types import TracebackType
    from ..records import EpisodeInfo, ResetOptions, VectorInfo

__all__ = ["Env", "VectorEnv", "make", "make_vec"]

_Array = npt.NDArray[Any]
Observation = Dict[str, _Array]


class _StandIn:
    """What of Gymnasium's base classes is used by wrappers and training code."""

    _np_random: Optional[np.random.Generator] = None

    @property
    def np_random(self) -> np.random.Generator:
        """Random numbers for code around the environment; its own episodes come from reset's seed alone."""
        if self._np_random is None:
            self._np_random = np.random.default_rng()
        return self._np_random

    @np_random.setter
    def np_random(self, value: np.random.Generator) -> None:
        self._np_random = value

    def has_wrapper_attr(self, name: str) -> bool:
        """Whether it has an attribute of that name."""
        return hasattr(self, name)

    def get_wrapper_attr(self, name: str) -> Any:
        """The attribute of that name; AttributeError without one."""
        return getattr(self, name)

    def set_wrapper_attr(self, name: str, value: Any, *, force: bool = True) -> bool:
        """Sets an attribute; without force only one that is there. Returns whether it was set."""
        if not force and not hasattr(self, name):
            return False
        setattr(self, name, value)
        return True

    def __enter__(self) -> _StandIn:
        return self

    def __exit__(self, kind: Optional[type[BaseException]], value: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        self.close()

    def close(self) -> None:
        """Nothing to be closed."""


if TYPE_CHECKING or not spaces.HAS_GYMNASIUM:
    _EnvBase = _StandIn
    _VectorBase = _StandIn
else:
    import gymnasium
    _EnvBase, _VectorBase = gymnasium.Env, gymnasium.vector.VectorEnv

# Options of the native environment, beside airsim360.PICTURE_SETTINGS; those of a task are
# airsim360.VectorEnvironment.TASK_OPTIONS.
_NATIVE_OPTIONS = ("drone", "action", "width", "height", "period", "max_speed", "max_turn", "max_rate", "level")

_IMAGES: Dict[str, Tuple[float, float, npt.DTypeLike]] = {
    "rgb": (0, 255, np.uint8), "range": (0, np.inf, np.float32),
    "semantic": (0, 2**16 - 1, np.uint16), "entity": (0, 2**32 - 1, np.uint32)}
def _metadata() -> Dict[str, Any]:
    """Gymnasium's word for what auto_reset does here, where it has one."""
    try:
        from gymnasium.vector import AutoresetMode
        return {"render_modes": ["rgb_array"], "autoreset_mode": AutoresetMode.NEXT_STEP}
    except ImportError:
        return {"render_modes": ["rgb_array"], "autoreset_mode": "NextStep"}


class _Base:
    """What both have: the native environment, its spaces and observations."""

    native: airsim360.VectorEnvironment
    """The environment in C++, for what is not in Gymnasium's API: pose_of, goal_of, hash."""
    world: airsim360.World
    """Where it takes place."""
    task: str
    """reach, avoid or search."""
    _begun = False
    _closed = False
    _np_random: Optional[np.random.Generator]

    def _open(self, task: Any, world: Union[str, airsim360.World], count: int, seed: Optional[int], copy: bool,
              observations: Optional[Iterable[Any]], options: Dict[str, Any], auto_reset: bool) -> None:
        world = airsim360.World(world) if isinstance(world, str) else world
        of_native = (*_NATIVE_OPTIONS, *airsim360.PICTURE_SETTINGS)
        known = (*of_native, *airsim360.VectorEnvironment.TASK_OPTIONS)
        for name in options:
            if name not in known:
                raise ValueError(f"unknown option {name!r}{did_you_mean(name, known)} (options: {', '.join(known)})")
        native = {name: options.pop(name) for name in of_native if name in options}
        task_options: Any = options  # their names are checked above, their values there
        self.native = airsim360.VectorEnvironment(world, task, task_options, count=count, seed=seed or 0,
                                                  observations=None if observations is None else list(observations), auto_reset=auto_reset, **native)
        self.world, self.task, self._copy = world, task, copy
        # Views stay valid: each step writes into the same memory.
        pictures = {"rgb": self.native.rgb, "range": self.native.range, "semantic": self.native.semantic,
                    "entity": self.native.entity}
        self._views: Observation = {name: view for name, view in pictures.items() if view is not None}
        self._views["state"] = self.native.state
        boxes = {name: spaces.Box(_IMAGES[name][0], _IMAGES[name][1], view.shape[1:], _IMAGES[name][2])
                 for name, view in self._views.items() if name != "state"}
        boxes["state"] = spaces.Box(-np.inf, np.inf, self.native.state.shape[1:], np.float32)
        self._one_observation = spaces.Dict(boxes)
        self._one_action = spaces.Box(-1.0, 1.0, (self.native.action_size,), np.float32)

    def _begin(self, seed: Optional[int], options: Optional[ResetOptions]) -> None:
        if self._closed:
            raise ValueError("reset: the environment is closed; make another one")
        if seed is not None:
            self._np_random = np.random.default_rng(seed)
        self.native.reset(seed, options)
        self._begun = True

    def _step(self, actions: npt.NDArray[np.float32]) -> None:
        if self._closed:
            raise ValueError("step: the environment is closed; make another one")
        if not self._begun:
            raise ValueError("step: no episode has begun; call reset first")
        self.native.step(actions)

    def _observe(self, row: Optional[int] = None) -> Observation:
        views = self._views if row is None else {name: view[row] for name, view in self._views.items()}
        if self._copy:
            return {name: np.array(view) for name, view in views.items()}
        return dict(views)

    @property
    def unwrapped(self) -> _Base:
        """Itself."""
        return self

    def close(self, **kwargs: Any) -> None:
        """From now on reset and step are refused; memory goes with the object and its views."""
        self._closed = True


class VectorEnv(_Base, _VectorBase):
    """`num_envs` copies of a task, all in one call. Where one has ended the next step begins its next episode.

    task: reach, avoid or search. world: a World, or what World() takes. observations: pictures besides "state", of rgb,
    range, semantic, entity; None: rgb, unless the tier is labels, and range. copy: observations are copies; without it views that the next step writes over. options:
    drone, action ("velocity", "rates", "rotors"), width, height, period, max_speed, max_turn, max_rate, level, tier and
    the other airsim360.PICTURE_SETTINGS (VectorEnvironment), and those of the task (records.TaskOptions); ValueError names the nearest for an unknown one.
    """

    metadata = _metadata()
    render_mode = "rgb_array"
    spec = None

    @property
    def closed(self) -> bool:
        """Whether close was called."""
        return self._closed

    def __init__(self, task: str = "reach", world: Union[str, airsim360.World] = "box_room", num_envs: int = 8, seed: Optional[int] = None,
                 observations: Optional[Sequence[str]] = None, copy: bool = False, **options: Any) -> None:
        self._open(task, world, num_envs, seed, copy, observations, options, auto_reset=True)
        self.num_envs = num_envs
        self.single_observation_space, self.single_action_space = self._one_observation, self._one_action
        self.observation_space = spaces.batch_space(self._one_observation, num_envs)
        self.action_space = spaces.batch_space(self._one_action, num_envs)
        self._seed = seed

    def reset(self, *, seed: Optional[int] = None, options: Optional[ResetOptions] = None) -> Tuple[Observation, VectorInfo]:
        """All begin: with the first episodes of `seed`, or with the next ones. Returns observations and info.

        options: "goal" and "start" (metres in W) and "yaw" (radians) of these episodes instead of drawn ones, for all
        or with one row an environment; ValueError for a place that is not free, and for other names.
        """
        self._begin(seed, options)
        return self._observe(), self._info()

    def step(self, actions: npt.ArrayLike) -> Tuple[Observation, npt.NDArray[np.float32], npt.NDArray[np.bool_],
                                                     npt.NDArray[np.bool_], VectorInfo]:
        """actions: (num_envs, n) in -1 … 1. Returns observations, rewards, terminated, truncated, info."""
        native = self.native
        self._step(np.asarray(actions, np.float32))
        return (self._observe(), np.array(native.reward), np.array(native.terminated), np.array(native.truncated),
                self._info())

    def render(self) -> Optional[npt.NDArray[np.uint8]]:
        """Pictures of all, (num_envs, H, W, 3) uint8; None without "rgb"."""
        return self._views.get("rgb")

    def _info(self) -> VectorInfo:
        native = self.native
        return {"success": np.array(native.reached), "crashed": np.array(native.crashed),
                "distance": np.array(native.distance), "episode_step": np.array(native.steps)}


class Env(_Base, _EnvBase):
    """One drone with one task; arguments as VectorEnv, but that observations are copies. A step after the end, or before the first reset, is a ValueError: reset first."""

    metadata = _metadata()
    render_mode = "rgb_array"
    spec = None

    def __init__(self, task: str = "reach", world: Union[str, airsim360.World] = "box_room", seed: Optional[int] = None,
                 observations: Optional[Sequence[str]] = None, copy: bool = True, **options: Any) -> None:
        self._open(task, world, 1, seed, copy, observations, options, auto_reset=False)
        self.observation_space, self.action_space = self._one_observation, self._one_action

    def reset(self, *, seed: Optional[int] = None, options: Optional[ResetOptions] = None) -> Tuple[Observation, EpisodeInfo]:
        """Begins the first episode of `seed`, or the next one. Returns observation and info.

        options: as VectorEnv.reset.
        """
        self._begin(seed, options)
        return self._observe(0), self._info()

    def step(self, action: npt.ArrayLike) -> Tuple[Observation, float, bool, bool, EpisodeInfo]:
        """Returns observation, reward, terminated, truncated, info."""
        native = self.native
        self._step(np.asarray(action, np.float32).reshape(1, -1))
        return (self._observe(0), float(native.reward[0]), bool(native.terminated[0]), bool(native.truncated[0]),
                self._info())

    def render(self) -> Optional[npt.NDArray[np.uint8]]:
        """(H, W, 3) uint8, or None without "rgb"."""
        return self._views["rgb"][0].copy() if "rgb" in self._views else None

    def _info(self) -> EpisodeInfo:
        native = self.native
        return {"success": bool(native.reached[0]), "crashed": bool(native.crashed[0]),
                "distance": float(native.distance[0]), "episode_step": int(native.steps[0])}


def make(task: str = "reach", **options: Any) -> Env:
    """One environment: Env(task, **options)."""
    return Env(task, **options)


def make_vec(task: str = "reach", num_envs: int = 8, **options: Any) -> VectorEnv:
    """A vector of environments: VectorEnv(task, num_envs=num_envs, **options)."""
    return VectorEnv(task, num_envs=num_envs, **options)
