"""Errors with the names of msgpack-rpc-python."""

__all__ = ["RPCError", "TimeoutError", "TransportError"]


class RPCError(Exception):
    """An error that the server has answered with."""


class TimeoutError(RPCError):
    """No answer in time."""


class TransportError(RPCError):
    """The connection could not be made or was lost."""
