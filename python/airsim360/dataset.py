"""Datasets on disk (docs/reference/dataset_format.md) as NumPy arrays; no compiled module and no other package is needed.

    frames = airsim360.Dataset("my_dataset")
    frame = frames[0]
    frame.rgb, frame.range, frame.semantic           # arrays, read when asked for
    frame.points()                                    # (H, W, 3) metres in W
    frames.samples("rgb", "semantic")                 # what torch.utils.data.DataLoader takes
"""
from __future__ import annotations

import json
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, Dict, Iterator, List, Literal, Optional, Sequence, Tuple, Union, overload

import numpy as np
import numpy.typing as npt

from ._words import did_you_mean
from .pictures import read_exr, read_png

if TYPE_CHECKING:
    from .data import Panoramas
    from .records import Category, EntityRecord, FrameRecord, Meta, PersonRecord, Pose

__all__ = ["Dataset", "Frame", "Samples"]

_Array = npt.NDArray[Any]
_F64 = npt.NDArray[np.float64]
_F32 = npt.NDArray[np.float32]
_Channels = Dict[str, _Array]

# Folders of pictures and how `collect` is asked for them.
_PRODUCTS = {"rgb": "any tier but labels", "range": "", "semantic": "", "entity": "", "normal": "--products normal",
             "position": "--products position", "albedo": "--products albedo", "material": "--products material",
             "part": "--products part", "sky": "--products sky", "flow": "--products flow",
             "coverage": "--products coverage", "radiance": "--radiance"}
_RGB8 = ("rgb", "entity", "albedo")
# The axes of C that the faces of a cube look along and have on their right: forward, right (down = forward x right).
_CUBE_FACES = {"+x": ((1, 0, 0), (0, 0, -1)), "-x": ((-1, 0, 0), (0, 0, 1)), "+y": ((0, 1, 0), (1, 0, 0)),
               "-y": ((0, -1, 0), (1, 0, 0)), "+z": ((0, 0, 1), (1, 0, 0)), "-z": ((0, 0, -1), (-1, 0, 0))}
_EXR_COLOR = {"rgb": "RGB", "radiance": "RGB", "position": "XYZ"}


def _product(name: str) -> str:
    if name not in _PRODUCTS:
        raise ValueError(f"no product is called {name!r}{did_you_mean(name, _PRODUCTS)} (products: {', '.join(_PRODUCTS)})")
    return name


class Frame:
    """One frame of a dataset: its pictures as attributes, read from disk at each use, and where it was taken.

    H rows from top to bottom, W columns from left to right. A product that the dataset lacks is a ValueError that names
    the flag which writes it. Where a frame has several views (the faces of a cube, several cameras) use
    read(product, view).
    """

    def __init__(self, dataset: "Dataset", record: FrameRecord) -> None:
        self.dataset = dataset
        self.record = record

    def __repr__(self) -> str:
        x, y, z = self.p
        return f"{type(self).__name__}({self.index}: {', '.join(self.products)} at ({x:.2f}, {y:.2f}, {z:.2f}) m, t = {self.t:.2f} s)"

    @property
    def index(self) -> int:
        """Number of the frame in the whole dataset, shards counted as one."""
        return self.record["index"]

    @property
    def stem(self) -> str:
        """Name of its files without extension."""
        return self.record["stem"]

    @property
    def t_ns(self) -> int:
        """Simulated time, nanoseconds."""
        return self.record["t_ns"]

    @property
    def t(self) -> float:
        """Simulated time, seconds."""
        return self.t_ns * 1e-9

    @property
    def p(self) -> _F64:
        """(3,) place of the camera in W, metres."""
        return np.array(self.record["X_WC"]["p"])

    @property
    def q_wxyz(self) -> _F64:
        """(4,) rotation of the camera in W as w, x, y, z."""
        return np.array(self.record["X_WC"]["q_wxyz"])

    @property
    def pose(self) -> _F64:
        """(4, 4) X_WC: p_W = X_WC p_C, C with +X right, +Y down, +Z forward."""
        return _pose(self.record["X_WC"])

    @property
    def velocity(self) -> _F64:
        """(3,) of the body in W, m/s."""
        return np.array(self.record["v_WB"])

    @property
    def products(self) -> List[str]:
        """Names of the pictures that are there."""
        return [name for name in _PRODUCTS if any(name == product for product, _ in self._keys)]

    @property
    def views(self) -> List[str]:
        """Names of the views of a frame: [""] for one picture a product, the faces of a cube, or the cameras."""
        return list(dict.fromkeys(view for _, view in self._keys))

    @property
    def people(self) -> List[PersonRecord]:
        """The persons of people.jsonl in this frame (docs/reference/people_format.md); [] without people."""
        return self.dataset._people.get(self.index, [])

    @property
    def rgb(self) -> npt.NDArray[np.uint8]:
        """(H, W, 3) uint8, sRGB."""
        return self.read("rgb")

    @property
    def range(self) -> _F32:
        """(H, W) float32, metres along the ray, 0 = sky."""
        return self.read("range")

    @property
    def semantic(self) -> _Array:
        """(H, W) uint8 (uint16 with custom categories), category ids."""
        return self.read("semantic")

    @property
    def entity(self) -> npt.NDArray[np.uint32]:
        """(H, W) uint32, entity ids."""
        return self.read("entity")

    @property
    def normal(self) -> _F32:
        """(H, W, 3) float32, unit normal in W towards the camera, 0 = sky."""
        return self.read("normal")

    @property
    def position(self) -> _F32:
        """(H, W, 3) float32, point hit, metres in W."""
        return self.read("position")

    @property
    def albedo(self) -> npt.NDArray[np.uint8]:
        """(H, W, 3) uint8, sRGB colour of the surface without any light."""
        return self.read("albedo")

    @property
    def material(self) -> npt.NDArray[np.uint16]:
        """(H, W) uint16, key of materials.json, 0 = sky."""
        return self.read("material")

    @property
    def part(self) -> npt.NDArray[np.uint8]:
        """(H, W) uint8, index into airsim360.PARTS."""
        return self.read("part")

    @property
    def sky(self) -> npt.NDArray[np.bool_]:
        """(H, W) bool: the ray meets the sky."""
        return self.read("sky")

    @property
    def flow(self) -> _F32:
        """(H, W, 2) float32, pixels to where the point is in the next frame; read("flow") has more channels."""
        stored = self.read("flow")
        return np.stack([stored["dx"], stored["dy"]], -1)

    @property
    def coverage(self) -> _Channels:
        """Channels of a file of coverage (docs/reference/dataset_format.md), by name."""
        return self.read("coverage")

    @property
    def radiance(self) -> _F32:
        """(H, W, 3) float32, linear light."""
        return self.read("radiance")

    @overload
    def read(self, product: Literal["rgb", "range", "semantic", "entity", "normal", "position", "albedo", "material", "part",
                                    "sky", "radiance"], view: str = "") -> _Array: ...
    @overload
    def read(self, product: Literal["flow", "coverage"], view: str = "") -> _Channels: ...
    @overload
    def read(self, product: str, view: str = "") -> Union[_Array, _Channels]: ...

    def read(self, product: str, view: str = "") -> Union[_Array, _Channels]:
        """A picture as stored, of one view; flow and coverage: a dictionary of their channels."""
        path = self.path(_product(product), view)
        if path.suffix == ".exr":
            channels = read_exr(path)
            if product == "range":
                return channels["Y"]
            if product in _EXR_COLOR:
                return np.stack([channels[c] for c in _EXR_COLOR[product]], -1).astype(np.float32, copy=False)
            return channels
        stored = _read_picture(path, product in _RGB8)
        if product == "entity":
            return stored.astype(np.uint32) @ np.array([1, 256, 65536], np.uint32)
        if product == "normal":
            return _normals(stored)
        return stored != 0 if product == "sky" else stored

    def path(self, product: str, view: str = "") -> Path:
        """The file of a picture. ValueError where there is none."""
        if (product, view) not in self._keys:
            views = [v for p, v in self._keys if p == product]
            if views:
                raise ValueError(f"frame {self.index}: view {view!r}; name one: read({product!r}, {views[0]!r}) "
                                 f"(views: {', '.join(map(repr, views))})")
            flag = _PRODUCTS[product] and f": collect it with {_PRODUCTS[product]}"
            raise ValueError(f"{self.dataset.folder}: product {product!r} is not in this dataset{flag}")
        name = f"{self.stem}_{view}" if view else self.stem
        for suffix in (".png", ".exr", ".jpg"):
            path = self.dataset.folder / product / (name + suffix)
            if path.exists():
                return path
        raise FileNotFoundError(f"{self.dataset.folder / product / name}.*: missing (airsim360 verify tells what else is)")

    def arrays(self, *products: str) -> _Channels:
        """Pictures by product, for instance for a network; all that are stored if none is named."""
        return {name: getattr(self, name)
                for name in (products or self.products) if _product(name)}

    def rays(self, view: str = "") -> _F64:
        """(H, W, 3) float64 unit rays in C through the pixel centres: panoramas, cube faces and pinholes."""
        if view in _CUBE_FACES:
            forward, right = (np.array(axis, float) for axis in _CUBE_FACES[view])
            size = self._meta["size"][0]
            grid = 2 * (np.arange(size) + 0.5) / size - 1
            ray: _F64 = forward + grid[None, :, None] * right + grid[:, None, None] * np.cross(forward, right)
            return _unit(ray)
        width, height = self._meta["size"]
        projection = self._meta["parameters"]["projection"]
        if projection == "erp":
            theta = 2 * np.pi * ((np.arange(width) + 0.5) / width - 0.5)
            phi = np.pi * (0.5 - (np.arange(height) + 0.5) / height)[:, None]
            return np.stack([np.cos(phi) * np.sin(theta), np.broadcast_to(-np.sin(phi), (height, width)),
                             np.cos(phi) * np.cos(theta)], -1)
        if projection == "pinhole":
            K = self.K
            x = (np.arange(width) + 0.5 - K[0, 2]) / K[0, 0]
            y = (np.arange(height) + 0.5 - K[1, 2]) / K[1, 1]
            ray = np.stack([*np.meshgrid(x, y), np.ones((height, width))], -1)
            return _unit(ray)
        raise ValueError(f"rays: {projection} pictures: name a view of a cube, or use panoramas and pinholes")

    @property
    def K(self) -> _F64:
        """(3, 3) intrinsics of a pinhole picture in pixels: x = (K p_C)_x / z, pixel centres at + 0.5."""
        parameters = self._meta["parameters"]
        if parameters["projection"] != "pinhole":
            raise ValueError(f"K: {parameters['projection']} pictures have no pinhole intrinsics")
        width, height = self._meta["size"]
        f = width / 2 / np.tan(np.radians(parameters["fov_deg"]) / 2)
        return np.array([[f, 0, width / 2], [0, f, height / 2], [0, 0, 1]])

    def points(self, view: str = "") -> _F64:
        """(H, W, 3) float64 surface points in W, metres; NaN where nothing is hit (sky)."""
        distance = self.read("range", view)[..., None].astype(float)
        pose = self.pose
        return np.where(distance > 0, self.rays(view) * distance @ pose[:3, :3].T + pose[:3, 3], np.nan)

    if not TYPE_CHECKING:  # checkers are to find unknown names themselves
        def __getattr__(self, name):
            raise AttributeError(f"a frame has no {name!r}{'' if name.startswith('_') else did_you_mean(name, _PRODUCTS)}")

    @property
    def _meta(self) -> Meta:
        return self.dataset.meta

    @cached_property
    def _keys(self) -> List[Tuple[str, str]]:
        """(product, view) of every picture, from the names under which frames.jsonl keeps their checksums."""
        keys = []
        for key in self.record["sha256"]:
            product = next((name for name in _PRODUCTS if key == name or key.startswith(name + "_")), None)
            if product:
                keys.append((product, key[len(product) + 1:]))
        return keys


class Dataset(Sequence[Frame]):
    """The frames of a folder that `airsim360 collect`, `render` or `fly` wrote: len(), [i], slices, iteration.

    folder: ValueError where it holds no dataset or an unfinished one. Frames read their pictures when asked, so a
    Dataset is small and can be pickled to the workers of a loader.
    """

    def __init__(self, folder: Union[str, Path]) -> None:
        self.folder = Path(folder)
        if not (self.folder / "meta.json").is_file():
            raise ValueError(f"{self.folder}: not a dataset: it has no meta.json")
        self.meta: Meta = json.loads((self.folder / "meta.json").read_text())
        if not (self.folder / "frames.jsonl").is_file():
            raise ValueError(f"{self.folder}: unfinished: run the command that began it again, it goes on from there")
        self._frames = [Frame(self, record) for record in _lines(self.folder / "frames.jsonl")]

    def __len__(self) -> int:
        return len(self._frames)

    @overload
    def __getitem__(self, i: int) -> Frame: ...
    @overload
    def __getitem__(self, i: slice) -> List[Frame]: ...

    def __getitem__(self, i: Union[int, slice]) -> Union[Frame, List[Frame]]:
        return self._frames[i]

    def __iter__(self) -> Iterator[Frame]:
        return iter(self._frames)

    def __repr__(self) -> str:
        width, height = self.meta["size"]
        return (f"Dataset({str(self.folder)!r}: {len(self)} frames of {self.meta['world']}, "
                f"{self.meta['parameters']['projection']} {width}x{height}, {', '.join(self.products)})")

    @property
    def products(self) -> List[str]:
        """Names of the pictures that its frames have."""
        return self._frames[0].products if self._frames else []

    @cached_property
    def categories(self) -> Dict[int, Category]:
        """Category id → path, parent, kind ("thing" or "stuff"), ids in ADE20K, Cityscapes and COCO."""
        return {category["id"]: category for category in self.meta["categories"]}

    @cached_property
    def entities(self) -> Dict[int, EntityRecord]:
        """Entity id → name, category, category_path, kind, first_frame."""
        stored = json.loads((self.folder / "entities.json").read_text())
        return {int(number): entity for number, entity in stored.items()}

    def samples(self, *products: str, transform: Optional[Callable[[Dict[str, _Array]], Any]] = None) -> "Samples":
        """Frames as dictionaries of arrays, in types that torch has, for torch.utils.data.DataLoader."""
        return Samples(self, products or ("rgb", "semantic"), transform)

    @cached_property
    def _people(self) -> Dict[int, List[PersonRecord]]:
        path = self.folder / "people.jsonl"
        return {line["index"]: line["persons"] for line in _lines(path)} if path.is_file() else {}


class Samples(Sequence[Any]):
    """A map-style dataset: samples[i] is {product: array} of frame i, or what `transform` makes of it.

    Unsigned integers of more than 8 bits become int64, which torch's losses take as class ids.
    """

    def __init__(self, dataset: Union[Dataset, "Panoramas"], products: Sequence[str],
                 transform: Optional[Callable[[Dict[str, _Array]], Any]] = None) -> None:
        self.dataset, self.products, self.transform = dataset, [_product(name) for name in products], transform

    def __len__(self) -> int:
        return len(self.dataset)

    def __getitem__(self, i: Any) -> Any:
        sample = {name: array.astype(np.int64) if array.dtype in (np.uint16, np.uint32) or name == "semantic" else array
                  for name, array in self.dataset[i].arrays(*self.products).items()}
        return self.transform(sample) if self.transform else sample


def _lines(path: Path) -> List[Any]:
    with open(path, encoding="utf-8") as lines:
        return [json.loads(line) for line in lines]


def _normals(stored: npt.NDArray[np.uint16]) -> _F32:
    """Unit normals as they are stored, (H, W, 3); 0 = nothing hit."""
    normals: _F32 = np.where(stored.any(-1, keepdims=True), stored / np.float32(32767) - np.float32(1), np.float32(0))
    return normals


def _unit(rays: _F64) -> _F64:
    length: _F64 = np.linalg.norm(rays, axis=-1, keepdims=True)
    return rays / length


def _pose(X: Pose) -> _F64:
    w, x, y, z = X["q_wxyz"]
    pose = np.eye(4)
    pose[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                    [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                    [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
    pose[:3, 3] = X["p"]
    return pose


def _read_picture(path: Path, rgb8: bool) -> _Array:
    """PNG, or JPEG by whichever decoder is there. rgb8: 8-bit colour, which the compiled module reads some ten times faster."""
    if rgb8:
        try:
            from ._native import _read_rgb
            return _read_rgb(str(path))
        except ImportError:
            pass
    if path.suffix == ".png":
        return read_png(path)
    try:
        from PIL import Image
    except ImportError:
        raise ImportError(f"{path}: JPEG needs the compiled module (make build) or Pillow") from None
    return np.asarray(Image.open(path).convert("RGB"))
