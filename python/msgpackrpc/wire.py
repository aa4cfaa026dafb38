"""Messages as they travel: msgpack-rpc's kinds, packing and unpacking."""
import msgpack

REQUEST, RESPONSE, NOTIFY = 0, 1, 2
_MOST = 2**31 - 1


def unpacker():
    """An unpacker of messages of any size, texts as str."""
    return msgpack.Unpacker(raw=False, strict_map_key=False, max_buffer_size=_MOST, max_bin_len=_MOST, max_str_len=_MOST,
                            max_array_len=_MOST)


def pack(message):
    return msgpack.packb(message, default=_to_msgpack)


def _to_msgpack(value):
    """Structures of AirSim's clients know how to be sent; NumPy numbers and arrays as plain ones."""
    if hasattr(value, "to_msgpack"):
        return value.to_msgpack()
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"cannot send {type(value).__name__}")
