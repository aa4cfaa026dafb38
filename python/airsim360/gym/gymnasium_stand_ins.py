"""Gymnasium's Box and Dict where it is installed, else small stand-ins with the same names and meaning."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict as _Dict, KeysView, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

__all__ = ["Box", "Dict", "HAS_GYMNASIUM", "batch_space"]

_Array = npt.NDArray[Any]

try:
    import gymnasium.spaces
    import gymnasium.vector.utils
    HAS_GYMNASIUM = True
except ImportError:
    HAS_GYMNASIUM = False


class Box:
    """Arrays of one shape and type within bounds."""

    def __init__(self, low: npt.ArrayLike, high: npt.ArrayLike, shape: Optional[Sequence[int]] = None,
                 dtype: npt.DTypeLike = np.float32, seed: Optional[int] = None) -> None:
        self.shape: Tuple[int, ...] = tuple(np.shape(low) if shape is None else shape)
        self.dtype: np.dtype[Any] = np.dtype(dtype)
        self.low: _Array = np.broadcast_to(np.asarray(low, self.dtype), self.shape)
        self.high: _Array = np.broadcast_to(np.asarray(high, self.dtype), self.shape)
        self.seed(seed)

    def seed(self, seed: Optional[int] = None) -> None:
        """Makes what sample() draws repeatable."""
        self._random = np.random.default_rng(seed)

    def sample(self) -> _Array:
        """A random element; unbounded sides as in Gymnasium: normal or exponential."""
        low, high = self.low.astype(np.float64), self.high.astype(np.float64)
        below, above = np.isfinite(low), np.isfinite(high)
        draw = self._random.normal(size=self.shape)
        step = self._random.exponential(size=self.shape)
        draw = np.where(below & ~above, np.where(below, low, 0) + step, draw)
        draw = np.where(~below & above, np.where(above, high, 0) - step, draw)
        both = below & above
        inside = self._random.uniform(np.where(both, low, 0), np.where(both, high, 1))
        if self.dtype.kind in "iu":
            inside = np.floor(self._random.uniform(np.where(both, low, 0), np.where(both, high, 1) + 1))
        return np.where(both, inside, draw).astype(self.dtype)

    def contains(self, x: object) -> bool:
        """Whether x has this shape, fits the type, and is within the bounds."""
        return (isinstance(x, np.ndarray) and x.shape == self.shape and np.can_cast(x.dtype, self.dtype)
                and bool(np.all(x >= self.low) and np.all(x <= self.high)))

    __contains__ = contains

    def __repr__(self) -> str:
        return f"Box({self.low.min(initial=0)}, {self.high.max(initial=0)}, {self.shape}, {self.dtype})"


class Dict:
    """Named spaces."""

    def __init__(self, spaces: Mapping[str, Any], seed: Optional[int] = None) -> None:
        self.spaces: _Dict[str, Any] = dict(spaces)
        self.seed(seed)

    def seed(self, seed: Optional[int] = None) -> None:
        """Makes what sample() draws repeatable."""
        for i, space in enumerate(self.spaces.values()):
            space.seed(None if seed is None else seed + i)

    def sample(self) -> _Dict[str, Any]:
        """A random element of each."""
        return {name: space.sample() for name, space in self.spaces.items()}

    def contains(self, x: object) -> bool:
        """Whether x is a dictionary of elements of these spaces."""
        return (isinstance(x, dict) and x.keys() == self.spaces.keys()
                and all(space.contains(x[name]) for name, space in self.spaces.items()))

    __contains__ = contains

    def __getitem__(self, name: str) -> Any:
        return self.spaces[name]

    def keys(self) -> KeysView[str]:
        """Names of the spaces."""
        return self.spaces.keys()

    def __repr__(self) -> str:
        return f"Dict({self.spaces})"


def batch_space(space: Union[Box, Dict], n: int) -> Union[Box, Dict]:
    """The space of n elements of `space`, one behind the other."""
    if isinstance(space, Dict):
        return Dict({name: batch_space(part, n) for name, part in space.spaces.items()})
    shape = (n,) + space.shape
    return Box(np.broadcast_to(space.low, shape), np.broadcast_to(space.high, shape), shape, space.dtype)


if not TYPE_CHECKING and HAS_GYMNASIUM:
    from gymnasium.spaces import Box, Dict  # noqa: F811  (in place of the stand-ins)
    from gymnasium.vector.utils import batch_space  # noqa: F811
