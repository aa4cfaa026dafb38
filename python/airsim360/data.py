"""Frames of a plan drawn when they are asked for: a dataset without a download, whose storage is the plan's seed.

    panoramas = airsim360.data.Panoramas("omni360-mini@5f0c1d…", size=(1024, 512))   # recipe, and the hash that its plan must have
    frame = panoramas[7]
    frame.rgb, frame.range, frame.semantic, frame.pose      # as airsim360.Dataset reads them of what `airsim360 dataset run` wrote
    frame["entity"]                                         # the same in a type that torch has
    loader = torch.utils.data.DataLoader(panoramas, batch_size=4, num_workers=2, sampler=panoramas.order(seed=1))

Frame i equals, array by array, frame i of the collected dataset.
"""
from __future__ import annotations

import json
import os
import sys
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, Dict, Iterator, List, Mapping, Optional, Sequence, Tuple, Union, cast, overload

import numpy as np
import numpy.typing as npt

from ._words import did_you_mean
from .dataset import _PRODUCTS, Frame, Samples, _normals

if TYPE_CHECKING:
    from ._native import _PlanFrames
    from .records import Category, FrameRecord, Meta, PersonRecord, PlannedFrame

__all__ = ["Panorama", "Panoramas"]

_Array = npt.NDArray[Any]
_Stored = Union[_Array, Dict[str, _Array]]

# Words of the sky, as the flags of `airsim360 render`.
_ENVIRONMENT = ("weather", "clouds", "sky_seed", "sun", "time", "place", "hdri", "environment")


class Panorama(Frame, Mapping[str, Any]):
    """One frame of a plan: an airsim360.Frame whose pictures are in memory, and a dictionary of what a loader takes.

    As a dictionary it has each picture by its product ("semantic", or "rgb_+x" for the faces of a cube), "index" and "X_WC",
    the (4, 4) pose. Values share the memory of the attributes; unsigned integers of more than 8 bits are int32, which torch
    has. A picture that was not asked for is a KeyError that names the option.
    """

    def __init__(self, meta: Meta, about: PlannedFrame, pictures: Dict[Tuple[str, str], _Stored]) -> None:
        self.about = about
        """What Panoramas.meta gives."""
        self.record = cast("FrameRecord", {**about, "stem": f"{about['index']:06d}"})
        self._of_plan, self._pictures = meta, pictures

    @property
    def row(self) -> str:
        """Row of the plan."""
        return self.about["row"]

    @property
    def world(self) -> str:
        """World of the row."""
        return self.about["world"]

    @property
    def environment(self) -> str:
        """Sun, sky and weather; World(environment=…) takes it."""
        return self.about["environment"]

    @property
    def seed(self) -> int:
        """Of the frame's noise and samples."""
        return self.about["seed"]

    @property
    def people(self) -> List[PersonRecord]:
        """The persons of people.jsonl in this frame; [] in rows without people."""
        persons: Optional[List[PersonRecord]] = self.about.get("persons")
        if persons is None and self.about["people"] > 0:
            raise KeyError(f"frame {self.index}: people need the products semantic and entity: name them in Panoramas(products=[…])")
        return persons or []

    def read(self, product: str, view: str = "") -> Any:
        """A picture of one view, as airsim360.Frame.read; KeyError where it was not asked for."""
        if (product, view) not in self._pictures:
            views = [v for p, v in self._pictures if p == product]
            if views:
                raise KeyError(f"frame {self.index}: view {view!r}; name one: read({product!r}, {views[0]!r}) (views: {', '.join(map(repr, views))})")
            if product not in _PRODUCTS:
                raise KeyError(f"no product is called {product!r}{did_you_mean(product, _PRODUCTS)} (products: {', '.join(_PRODUCTS)})")
            raise KeyError(f"frame {self.index}: product {product!r} was not asked for: name it in "
                           f"Panoramas(products={[*self.products, product]!r})")
        stored = self._pictures[product, view]
        if product == "normal":
            return _normals(cast(_Array, stored))
        return cast(_Array, stored) != 0 if product == "sky" else stored

    def path(self, product: str, view: str = "") -> Path:
        """There is none: ValueError."""
        raise ValueError(f"frame {self.index} of a plan is in no file; airsim360 dataset run writes files")

    def __getitem__(self, name: str) -> Any:
        if name == "index":
            return self.index
        if name == "X_WC":
            return self.pose
        product, view = next((key for key in self._keys if name == _name(*key)), (name, ""))
        picture = self.read(product, view)
        if product == "flow":
            return np.stack([picture["dx"], picture["dy"]], -1)
        return picture.astype(np.int32) if getattr(picture, "dtype", None) == np.uint16 else \
            picture.view(np.int32) if getattr(picture, "dtype", None) == np.uint32 else picture

    def __iter__(self) -> Iterator[str]:
        return iter(["index", "X_WC", *(_name(*key) for key in self._keys)])

    def __len__(self) -> int:
        return 2 + len(self._keys)

    def __eq__(self, other: object) -> bool:
        return self is other

    def __hash__(self) -> int:
        return id(self)

    @property
    def _meta(self) -> Meta:
        return self._of_plan

    @cached_property
    def _keys(self) -> List[Tuple[str, str]]:
        return list(self._pictures)


class Panoramas(Sequence[Panorama]):
    """The frames of a plan in any order, each drawn when it is asked for: len(), [i], slices, iteration.

    plan: a recipe (a name of `airsim360 dataset plan`, or a YAML file) or the file of a plan; "@HASH" behind it, or the first
    digits, is what the plan's hash must be. world (names, or "a,b"), frames and seed are for recipes, as the flags of
    `dataset plan`.

    products: the pictures of a frame; None: those that `dataset run` would write. size ((width, height) or "WxH"),
    projection (erp, cube, pinhole, fisheye), fov (radians) and cameras (a file) are what is looked through; keywords of
    airsim360.PICTURE_SETTINGS and rgb_format are how pictures are made; weather, clouds, sky_seed, sun, time, place, hdri and
    environment are laid over the sky of every frame. What is not given is as the plan says.

    cache: a folder of frames drawn before; True: one in the user's cache; False: none. It holds at most cache_bytes, the least
    recently used go first; several processes may share it. threads: of drawing; 0: all, in worker processes one.

    ValueError for what makes no sense, and for frames of worlds that do not exist; IndexError outside of the plan.
    """

    def __init__(self, plan: Union[str, Path], *, world: Union[str, Sequence[str]] = (), frames: int = 0, seed: int = 0,
                 products: Optional[Sequence[str]] = None, size: Union[None, str, Tuple[int, int]] = None, projection: str = "erp",
                 fov: Optional[float] = None, cameras: Union[str, Path] = "", weather: str = "", clouds: str = "", sky_seed: str = "",
                 sun: str = "", time: str = "", place: str = "", hdri: str = "", environment: str = "", device: str = "auto",
                 gpu: int = -1, cache: Union[bool, str, Path] = True, cache_bytes: int = 2 << 30, threads: int = 0,
                 **picture: Any) -> None:
        from . import _native
        if isinstance(products, str):
            raise ValueError(f"products: a list of names, found {products!r}")
        if threads < 0 or cache_bytes < 0:
            raise ValueError(f"{'threads' if threads < 0 else 'cache_bytes'}: {min(threads, cache_bytes)}; give 0 or more")
        worlds = world.split(",") if isinstance(world, str) else list(world)
        self._text: str = _native._find_plan(str(plan), [w for w in worlds if w], frames, seed, device, gpu)
        sky = dict(zip(_ENVIRONMENT, (weather, clouds, str(sky_seed), sun, time, place, hdri, environment)))
        self._options: Dict[str, Any] = dict(
            picture=picture, products=None if products is None else list(products), projection=projection,
            size=size or "" if isinstance(size, str) or size is None else f"{size[0]}x{size[1]}",
            fov_deg=0.0 if fov is None else float(np.degrees(fov)), cameras=str(cameras), environment=sky, device=device, gpu=gpu,
            cache=None if cache is True else str(cache or ""), cache_bytes=cache_bytes)
        self._threads, self._process = threads, 0
        self._frames: Optional[_PlanFrames] = None
        native = self._native  # mistakes are told now
        self._count, self.hash = native.count, native.hash
        """hash: of the plan; with the recipe's name and seed it names every byte."""

    @property
    def _native(self) -> _PlanFrames:
        """What draws in this process. A forked one goes on with the worlds that its parent had opened."""
        frames = self._frames
        if frames is None:
            from . import _native
            self._frames = frames = _native._PlanFrames(self._text, **self._options)
            self._process = os.getpid()
        return frames

    @property
    def _own_threads(self) -> int:
        multiprocessing = sys.modules.get("multiprocessing")
        worker = self._process != os.getpid() or multiprocessing is not None and multiprocessing.parent_process() is not None
        return self._threads or int(worker)

    def __getstate__(self) -> Dict[str, Any]:
        return {**self.__dict__, "_frames": None, "_process": 0}

    def __len__(self) -> int:
        return self._count

    @overload
    def __getitem__(self, i: int) -> Panorama: ...
    @overload
    def __getitem__(self, i: slice) -> Sequence[Panorama]: ...

    def __getitem__(self, i: Union[int, slice]) -> Union[Panorama, Sequence[Panorama]]:
        """Frame i; of a slice a sequence that draws its frames when they are asked for."""
        if isinstance(i, slice):
            return _Part(self, range(*i.indices(len(self))))
        native = self._native
        text, pictures = native.take(self._index(i), self._own_threads)
        stored: Dict[Tuple[str, str], _Stored] = {
            (product, view): {name: picture[..., k] for k, name in enumerate(channels)} if channels and product != "position" else picture
            for product, view, channels, picture in pictures}
        return Panorama(self._meta, json.loads(text), stored)

    def __iter__(self) -> Iterator[Panorama]:
        """In order, without the frames of worlds that did not exist when the plan was made, as `dataset run`."""
        return (self[i] for i in self.order())

    def __repr__(self) -> str:
        width, height = self._meta["size"]
        parameters = self._meta["parameters"]
        return (f"Panoramas({self.hash[:12]}: {len(self)} frames of {self._meta['world']}, "
                f"{parameters['projection']} {width}x{height}, {', '.join(self.products)})")

    def meta(self, i: int) -> PlannedFrame:
        """What frame i is, without drawing it: row, world, X_WC, environment, seed and more (records.PlannedFrame)."""
        native = self._native
        return cast("PlannedFrame", json.loads(native.describe(self._index(i), self._own_threads)))

    def order(self, seed: Optional[int] = None) -> List[int]:
        """Numbers of the frames whose worlds exist, for a loader's `sampler`: in order, or shuffled by a seed.

        Frames that share a sky stay together, because a sky takes seconds to prepare, as do those of a world.
        """
        blocks = np.array(self._native.blocks(), np.int64).reshape(-1, 2)
        if seed is None:
            return [int(i) for first, last in blocks for i in range(first, last)]
        random = np.random.default_rng(seed)
        return [int(i) for b in random.permutation(len(blocks)) for i in blocks[b, 0] + random.permutation(blocks[b, 1] - blocks[b, 0])]

    def open(self) -> "Panoramas":
        """Opens up to three worlds now, so that workers forked from this process share their memory; returns this object."""
        native = self._native
        native.open(self._own_threads)
        return self

    def samples(self, *products: str, transform: Optional[Callable[[Dict[str, _Array]], Any]] = None) -> Samples:
        """The same as Dataset.samples: dictionaries of these pictures alone, or what `transform` makes of them."""
        return Samples(self, products or ("rgb", "semantic"), transform)

    @property
    def worlds(self) -> Dict[str, Optional[str]]:
        """World -> its hash; None where it did not exist when the plan was made."""
        return self._native.worlds

    @property
    def products(self) -> List[str]:
        """Names of the pictures of a frame."""
        products: List[str] = self._meta["parameters"]["products"]
        return products

    @cached_property
    def categories(self) -> Dict[int, Category]:
        """Category id -> path, parent, kind, ids in ADE20K, Cityscapes and COCO."""
        return {category["id"]: category for category in self._meta["categories"]}

    @cached_property
    def _meta(self) -> Meta:
        return cast("Meta", json.loads(self._native.meta))

    def _index(self, i: int) -> int:
        number = i.__index__()
        if not -len(self) <= number < len(self):
            raise IndexError(f"frame {number} is not in 0 … {len(self) - 1} of the plan")
        if self._process != os.getpid() and self._native.uses_gpu:
            raise RuntimeError("a GPU cannot be used by a forked process: give the loader multiprocessing_context='spawn', or device='cpu'")
        return number % len(self)


class _Part(Sequence[Panorama]):
    """Some frames of Panoramas."""

    def __init__(self, panoramas: Panoramas, frames: range) -> None:
        self._panoramas, self._frames = panoramas, frames

    def __len__(self) -> int:
        return len(self._frames)

    @overload
    def __getitem__(self, i: int) -> Panorama: ...
    @overload
    def __getitem__(self, i: slice) -> Sequence[Panorama]: ...

    def __getitem__(self, i: Union[int, slice]) -> Union[Panorama, Sequence[Panorama]]:
        return _Part(self._panoramas, self._frames[i]) if isinstance(i, slice) else self._panoramas[self._frames[i]]


def _name(product: str, view: str) -> str:
    return f"{product}_{view}" if view else product

