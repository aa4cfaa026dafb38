"""Memory that a client lends to a server on the same machine: pictures are written there and pass through no socket.

Where it cannot be had (another machine or server, another user, another system) pictures come through the socket.
"""
from __future__ import annotations

import collections
import ctypes
import mmap
import os
import socket
import struct
import threading
import weakref
from typing import Any, Callable, Deque, List, Optional, Tuple

import numpy as np
import numpy.typing as npt

try:
    import fcntl
except ImportError:  # clients run on other systems too
    pass

_Place = Tuple[int, int]  # offset, size

_BYTES = 128 << 20  # of address space; only what pictures fill is taken of the machine's memory
_FIRST = 1 << 20  # bytes offered before it is known how large the pictures are


class Region:
    """A part of the memory, free again when the last view of it is gone."""

    def __init__(self, offset: int, size: int, bytes_: Any, give_back: Callable[[_Place], None]) -> None:
        self.offset, self.size = offset, size
        self._bytes = bytes_
        self.free = weakref.finalize(bytes_, give_back, (offset, size))
        self.free.atexit = False

    def view(self, offset: int, size: int, dtype: npt.DTypeLike) -> npt.NDArray[Any]:
        """What the server has written at `offset` of the memory: a read-only array of one dimension."""
        place: npt.NDArray[Any] = np.frombuffer(self._bytes, dtype, size // np.dtype(dtype).itemsize, offset - self.offset)
        place.flags.writeable = False
        return place


class Lending:
    """Memory lent to the server that listens on `port` of this machine. OSError where that cannot be."""

    def __init__(self, port: int) -> None:
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        weakref.finalize(self, self._socket.close)  # ends the loan
        self._socket.settimeout(2)
        self._socket.connect(f"\0airsim360/{port}")
        user = struct.unpack("3i", self._socket.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, 12))[1]
        if user not in (0, os.getuid()):
            raise PermissionError("another user's server")
        file = os.memfd_create("airsim360", os.MFD_CLOEXEC | os.MFD_ALLOW_SEALING)
        try:
            os.ftruncate(file, _BYTES)
            fcntl.fcntl(file, fcntl.F_ADD_SEALS, fcntl.F_SEAL_SHRINK | fcntl.F_SEAL_GROW | fcntl.F_SEAL_SEAL)
            self._memory = mmap.mmap(file, _BYTES)
            socket.send_fds(self._socket, [b"\0"], [file])
        finally:
            os.close(file)
        token = self._socket.recv(8, socket.MSG_WAITALL)
        if len(token) != 8:
            raise ConnectionError("the server takes no memory")
        self.token: int = struct.unpack("=Q", token)[0]
        self.wanted = _FIRST  # what the pictures of the last call needed
        self._lock = threading.Lock()
        self._free = [(0, _BYTES)]  # offset, size: in order, apart
        self._returned: Deque[_Place] = collections.deque()  # finalizers may run anywhere, also while the lock is held
        self._lost: List[Region] = []

    def take(self) -> Optional[Region]:
        """A region for the next call; None if there is none."""
        size = -(-self.wanted // 4096) * 4096  # the server wants multiples of 64
        with self._lock:
            while self._returned:
                self._give_back(*self._returned.popleft())
            for number, (offset, room) in enumerate(self._free):
                if room >= size:
                    self._free[number:number + 1] = [(offset + size, room - size)] if room > size else []
                    memory = (ctypes.c_ubyte * size).from_buffer(self._memory, offset)
                    return Region(offset, size, memory, self._returned.append)
        return None

    def lose(self, region: Region) -> None:
        """Nobody knows when the server has done with it: it is never used again."""
        self._lost.append(region)

    def _give_back(self, offset: int, size: int) -> None:
        pieces = sorted(self._free + [(offset, size)])
        self._free = [pieces[0]]
        for offset, size in pieces[1:]:
            before, length = self._free[-1]
            if before + length == offset:
                self._free[-1] = (before, length + size)
            else:
                self._free.append((offset, size))


def lend(host: str, port: int) -> Optional[Lending]:
    """A Lending, or None."""
    if host not in ("127.0.0.1", "localhost"):
        return None
    try:
        return Lending(port)
    except (OSError, AttributeError, NameError):  # not Linux: there is no memfd, perhaps no fcntl
        return None
