"""The server side of msgpack-rpc-python: scene managers of AirVLN and its successors listen with it."""
from __future__ import annotations

import socket
import threading
from typing import Any, Optional, Protocol, Tuple

import msgpack

from .wire import NOTIFY, REQUEST, RESPONSE, pack, unpacker


__all__ = ["Server"]


class _Place(Protocol):
    """Host and port, as msgpackrpc.Address has them."""

    @property
    def host(self) -> str: ...
    @property
    def port(self) -> int: ...


class Server:
    """Answers calls by the methods of `dispatcher`, one call at a time; what they raise becomes the error's text.

    Methods whose names begin with an underscore cannot be called.
    """

    def __init__(self, dispatcher: object, pack_encoding: str = "utf-8", unpack_encoding: str = "utf-8") -> None:
        del pack_encoding, unpack_encoding  # always UTF-8
        self._dispatcher = dispatcher
        self._one_at_a_time = threading.Lock()
        self._lock = threading.Lock()  # of the sockets
        self._listener: Optional[socket.socket] = None
        self._clients: set[socket.socket] = set()
        self._stopped = threading.Event()

    def listen(self, address: _Place) -> None:
        """Takes calls at an address from now on; start() answers them. OSError where that cannot be."""
        self._listener = socket.create_server((address.host, address.port))

    @property
    def address(self) -> Tuple[str, int]:
        """(host, port) that it listens on."""
        place: Tuple[str, int] = self._listening().getsockname()
        return place

    def start(self) -> None:
        """Serves until stop() is called in another thread."""
        listener = self._listening()
        listener.settimeout(0.2)  # how often it looks whether it is to stop
        while not self._stopped.is_set():
            try:
                client, _ = listener.accept()
            except TimeoutError:
                continue
            except OSError:
                break
            client.settimeout(None)
            with self._lock:
                self._clients.add(client)
            threading.Thread(target=self._serve, args=(client,), daemon=True).start()

    def stop(self) -> None:
        """Lets start() return."""
        self._stopped.set()

    def close(self) -> None:
        """Stops, and closes every connection."""
        self.stop()
        self._listening().close()
        with self._lock:
            clients = list(self._clients)
        for client in clients:
            try:
                client.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass

    def _listening(self) -> socket.socket:
        if self._listener is None:
            raise AttributeError("listen() first")
        return self._listener

    def _serve(self, client: socket.socket) -> None:
        messages = unpacker()
        try:
            while data := client.recv(1 << 16):
                messages.feed(data)
                for message in messages:
                    answer = self._answer(message)
                    if answer is not None:
                        client.sendall(answer)
        except (OSError, ValueError, msgpack.exceptions.UnpackException):
            pass  # the client has gone, or does not speak this protocol
        with self._lock:
            self._clients.discard(client)
        client.close()

    def _answer(self, message: Any) -> Optional[bytes]:
        kind = message[0] if isinstance(message, list) and message and isinstance(message[0], int) else None
        length = {REQUEST: 4, NOTIFY: 3}.get(kind) if kind is not None else None
        if length is None or len(message) != length or not (isinstance(message[-2], str) and isinstance(message[-1], list)):
            raise ValueError("neither a call nor a notification")
        if kind == NOTIFY:
            self._call(*message[1:])
            return None
        failure, result = self._call(*message[2:])
        return pack([RESPONSE, message[1], failure, result])

    def _call(self, method: str, arguments: list[Any]) -> Tuple[Optional[str], Any]:
        function = None if method.startswith("_") else getattr(self._dispatcher, method, None)
        if not callable(function):
            return f"'{method}' method not found", None
        with self._one_at_a_time:
            try:
                return None, function(*arguments)
            except Exception as problem:  # pylint: disable=broad-except  # the caller is told
                return str(problem), None
