"""A small msgpack-rpc client and server with the names of msgpack-rpc-python, on plain sockets.

The stock `airsim` package imports `msgpackrpc`, whose original needs tornado < 5 and msgpack < 1. This one needs only
msgpack (Debian: python3-msgpack). One thread reads answers, in whatever order they come; calls may be made from any
thread.
"""
from __future__ import annotations

import itertools
import socket
import struct
import threading
from typing import Any, Callable, Dict, List, Optional

from . import error
from .server import Server
from .wire import NOTIFY, REQUEST, RESPONSE, pack, unpacker

__all__ = ["Address", "Client", "Future", "Server", "error"]

_CHUNK = 1 << 20  # bytes that are read at once
_NEAR = 1 << 17  # bytes on their way from this machine: so many stay in the processor's caches


def _open(host: str, port: int, timeout: Optional[float]) -> socket.socket:
    """A connected socket."""
    found = socket.getaddrinfo(host, port, 0, socket.SOCK_STREAM)
    for number, (family, kind, protocol, _, place) in enumerate(found):
        made = socket.socket(family, kind, protocol)
        try:
            if place[0] in ("127.0.0.1", "::1"):
                made.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, _NEAR)
            made.settimeout(timeout)
            made.connect(place)
            return made
        except OSError:
            made.close()
            if number + 1 == len(found):
                raise
    raise OSError(f"{host} has no address")


class Address:
    """Host and port of a server."""

    def __init__(self, host: str, port: int) -> None:
        self._host, self._port = host, port

    @property
    def host(self) -> str:
        """Name or number of the machine."""
        return self._host

    @property
    def port(self) -> int:
        """Its port."""
        return self._port

    def __repr__(self) -> str:
        return f"Address({self._host!r}, {self._port})"


class Future:
    """An answer that may not be there yet."""

    def __init__(self, timeout: Optional[float] = None) -> None:
        self._done = threading.Event()
        self._timeout = timeout
        self._result: Any = None
        self._error: Any = None
        self._callbacks: List[Callable[[Future], object]] = []
        self._lock = threading.Lock()

    def _set(self, result: Any, failure: Any) -> None:
        with self._lock:
            self._result, self._error = result, failure
            self._done.set()
            callbacks, self._callbacks = self._callbacks, []
        for callback in callbacks:
            callback(self)

    def join(self, timeout: Optional[float] = None) -> Future:
        """Waits for the answer; errors of the server are not raised here."""
        if not self._done.wait(self._timeout if timeout is None else timeout):
            self._set(None, error.TimeoutError("Request timed out"))
        return self

    def get(self) -> Any:
        """Waits and returns the result; raises RPCError, TimeoutError or TransportError."""
        self.join()
        if self._error is None:
            return self._result
        if isinstance(self._error, Exception):
            raise self._error
        raise error.RPCError(self._error)

    @property
    def result(self) -> Any:
        """What the server has answered; None before that."""
        return self._result

    @property
    def error(self) -> Any:
        """What went wrong: a text of the server or an exception; None if nothing has."""
        return self._error

    def attach_callback(self, callback: Callable[[Future], object]) -> None:
        """Calls callback(self) when the answer is there, at once if it is."""
        with self._lock:
            if not self._done.is_set():
                self._callbacks.append(callback)
                return
        callback(self)


class Client:
    """Calls functions of one server. Connects at the first call, and again after the connection was lost."""

    def __init__(self, address: Address, timeout: Optional[float] = 10, pack_encoding: str = "utf-8",
                 unpack_encoding: str = "utf-8", reconnect_limit: int = 5, connect_timeout: Optional[float] = 10) -> None:
        del pack_encoding, unpack_encoding  # always UTF-8
        self._address, self._timeout = address, timeout
        self._connect_timeout, self._tries = connect_timeout, max(1, reconnect_limit)
        self._ids = itertools.count()
        self._lock = threading.Lock()
        self._socket: Optional[socket.socket] = None
        self._waiting: Dict[int, Future] = {}

    @property
    def address(self) -> Address:
        """Of the server."""
        return self._address

    def call(self, method: str, *args: Any) -> Any:
        """Result of a function of the server; RPCError, TimeoutError, TransportError."""
        return self.call_async(method, *args).get()

    def call_async(self, method: str, *args: Any) -> Future:
        """The same as a Future, at once."""
        future = Future(self._timeout)
        with self._lock:
            connected = self._connect()
            number = next(self._ids) & 0xFFFFFFFF
            message = pack([REQUEST, number, method, args])
            self._waiting[number] = future
            try:
                connected.sendall(message)
            except OSError as problem:
                self._waiting.pop(number, None)
                self._drop(connected)
                raise error.TransportError(str(problem)) from problem
        return future

    def notify(self, method: str, *args: Any) -> None:
        """Calls a function without an answer."""
        with self._lock:
            self._connect().sendall(pack([NOTIFY, method, args]))

    def close(self) -> None:
        """Ends the connection; the next call makes a new one."""
        with self._lock:
            if self._socket is not None:
                self._drop(self._socket)

    def _connect(self) -> socket.socket:
        if self._socket is not None:
            return self._socket
        problem: Optional[OSError] = None
        for _ in range(self._tries):
            try:
                connected = _open(self._address.host, self._address.port, self._connect_timeout)
                break
            except OSError as failure:
                problem = failure
        else:
            raise error.TransportError(f"Retry connection over the limit: {problem}")
        connected.settimeout(None)
        connected.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._socket = connected
        threading.Thread(target=self._read, args=(connected,), daemon=True).start()
        return connected

    def _drop(self, connected: socket.socket) -> None:
        if self._socket is connected:
            self._socket = None
        try:
            connected.shutdown(socket.SHUT_RDWR)
        except OSError:
            pass

    def _read(self, connected: socket.socket) -> None:
        messages, chunk = unpacker(), memoryview(bytearray(_CHUNK))
        failure = error.TransportError("Connection closed by the server")
        try:
            while True:
                size = connected.recv_into(chunk)
                if not size:
                    break
                messages.feed(chunk[:size])
                for message in messages:
                    if len(message) == 4 and message[0] == RESPONSE:
                        future = self._waiting.pop(message[1], None)
                        if future is not None:
                            future._set(message[3], message[2])
        except (OSError, ValueError, struct.error) as problem:
            failure = error.TransportError(str(problem))
        with self._lock:
            self._drop(connected)
            waiting, self._waiting = self._waiting, {}
        connected.close()
        for future in waiting.values():
            future._set(None, failure)
