"""Messages as they travel: msgpack-rpc's kinds, packing and unpacking."""
from __future__ import annotations

from typing import Any

import msgpack

REQUEST, RESPONSE, NOTIFY = 0, 1, 2
_MOST = 2**31 - 1


def unpacker() -> Any:
    """An unpacker of messages of any size, texts as str."""
    return msgpack.Unpacker(raw=False, strict_map_key=False, max_buffer_size=_MOST, max_bin_len=_MOST, max_str_len=_MOST,
                            max_array_len=_MOST)


def pack(message: object) -> bytes:
    """The bytes of a message; TypeError for what cannot be sent."""
    packed: bytes = msgpack.packb(message, default=_to_msgpack)
    return packed


def _to_msgpack(value: Any) -> Any:
    """Structures of AirSim's clients know how to be sent; NumPy numbers and arrays as plain ones."""
    if hasattr(value, "to_msgpack"):
        return value.to_msgpack()
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"cannot send {type(value).__name__}")
