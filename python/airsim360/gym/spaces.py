"""Gymnasium's Box and Dict where it is installed, else small stand-ins with the same names and meaning."""
import numpy as np

try:
    from gymnasium.spaces import Box, Dict
    from gymnasium.vector.utils import batch_space
    HAS_GYMNASIUM = True
except ImportError:
    HAS_GYMNASIUM = False

    class Box:
        """Arrays of one shape and type within bounds."""

        def __init__(self, low, high, shape=None, dtype=np.float32, seed=None):
            self.shape = tuple(np.shape(low) if shape is None else shape)
            self.dtype = np.dtype(dtype)
            self.low = np.broadcast_to(np.asarray(low, self.dtype), self.shape)
            self.high = np.broadcast_to(np.asarray(high, self.dtype), self.shape)
            self.seed(seed)

        def seed(self, seed=None):
            self._random = np.random.default_rng(seed)

        def sample(self):
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

        def contains(self, x):
            return (isinstance(x, np.ndarray) and x.shape == self.shape and np.can_cast(x.dtype, self.dtype)
                    and bool(np.all(x >= self.low) and np.all(x <= self.high)))

        __contains__ = contains

        def __repr__(self):
            return f"Box({self.low.min(initial=0)}, {self.high.max(initial=0)}, {self.shape}, {self.dtype})"

    class Dict:
        """Named spaces."""

        def __init__(self, spaces, seed=None):
            self.spaces = dict(spaces)
            self.seed(seed)

        def seed(self, seed=None):
            for i, space in enumerate(self.spaces.values()):
                space.seed(None if seed is None else seed + i)

        def sample(self):
            return {name: space.sample() for name, space in self.spaces.items()}

        def contains(self, x):
            return (isinstance(x, dict) and x.keys() == self.spaces.keys()
                    and all(space.contains(x[name]) for name, space in self.spaces.items()))

        __contains__ = contains

        def __getitem__(self, name):
            return self.spaces[name]

        def keys(self):
            return self.spaces.keys()

        def __repr__(self):
            return f"Dict({self.spaces})"

    def batch_space(space, n):
        """The space of n elements of `space`, one behind the other."""
        if isinstance(space, Dict):
            return Dict({name: batch_space(part, n) for name, part in space.spaces.items()})
        shape = (n,) + space.shape
        return Box(np.broadcast_to(space.low, shape), np.broadcast_to(space.high, shape), shape, space.dtype)
