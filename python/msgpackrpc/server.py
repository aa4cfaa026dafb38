"""The server side of msgpack-rpc-python: scene managers of AirVLN and its successors listen with it."""
import socket
import threading

import msgpack

from .wire import NOTIFY, REQUEST, RESPONSE, pack, unpacker


class Server:
    """Answers calls by the methods of `dispatcher`, one call at a time; what they raise becomes the error's text.

    Methods whose names begin with an underscore cannot be called.
    """

    def __init__(self, dispatcher, pack_encoding="utf-8", unpack_encoding="utf-8"):
        del pack_encoding, unpack_encoding  # always UTF-8
        self._dispatcher = dispatcher
        self._one_at_a_time = threading.Lock()
        self._lock = threading.Lock()  # of the sockets
        self._listener, self._clients = None, set()
        self._stopped = threading.Event()

    def listen(self, address):
        self._listener = socket.create_server((address.host, address.port))

    @property
    def address(self):
        """(host, port) that it listens on."""
        return self._listener.getsockname()

    def start(self):
        """Serves until stop() is called in another thread."""
        self._listener.settimeout(0.2)  # how often it looks whether it is to stop
        while not self._stopped.is_set():
            try:
                client, _ = self._listener.accept()
            except TimeoutError:
                continue
            except OSError:
                break
            client.settimeout(None)
            with self._lock:
                self._clients.add(client)
            threading.Thread(target=self._serve, args=(client,), daemon=True).start()

    def stop(self):
        self._stopped.set()

    def close(self):
        """Stops, and closes every connection."""
        self.stop()
        self._listener.close()
        with self._lock:
            clients = list(self._clients)
        for client in clients:
            try:
                client.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass

    def _serve(self, client):
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

    def _answer(self, message):
        kind = message[0] if isinstance(message, list) and message and isinstance(message[0], int) else None
        length = {REQUEST: 4, NOTIFY: 3}.get(kind)
        if length is None or len(message) != length or not (isinstance(message[-2], str) and isinstance(message[-1], list)):
            raise ValueError("neither a call nor a notification")
        if kind == NOTIFY:
            self._call(*message[1:])
            return None
        failure, result = self._call(*message[2:])
        return pack([RESPONSE, message[1], failure, result])

    def _call(self, method, arguments):
        function = None if method.startswith("_") else getattr(self._dispatcher, method, None)
        if not callable(function):
            return f"'{method}' method not found", None
        with self._one_at_a_time:
            try:
                return None, function(*arguments)
            except Exception as problem:  # pylint: disable=broad-except  # the caller is told
                return str(problem), None
