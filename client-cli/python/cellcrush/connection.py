"""The connection to a daemon: its address, who calls, and calls and streams that survive interruptions."""
from __future__ import annotations

import ipaddress
import os
import pathlib
import pwd
import sys
import threading
import time
from typing import Any, Callable, Iterator, NoReturn, Optional, Tuple, TypeVar

import grpc

from cellcrush.errors import CrushError, NotConnected, ServerChanged, raise_error
from cellcrush.v1 import (admin_service_pb2, admin_service_pb2_grpc, cases_service_pb2_grpc, jobs_service_pb2_grpc,
                          sweeps_service_pb2_grpc)

DEFAULT_ADDRESS = "127.0.0.1:50551"
# A mesh of a large lattice is one message; the daemon is called directly, whatever proxy the environment names.
OPTIONS = [("grpc.max_receive_message_length", -1), ("grpc.max_send_message_length", -1), ("grpc.enable_http_proxy", 0),
           ("grpc.initial_reconnect_backoff_ms", 100), ("grpc.min_reconnect_backoff_ms", 500),
           ("grpc.max_reconnect_backoff_ms", 1000),
           # Tunnels and proxies cut what is silent for a minute.
           ("grpc.keepalive_time_ms", 20_000), ("grpc.keepalive_timeout_ms", 20_000),
           ("grpc.http2.max_pings_without_data", 0)]
CALL_TIMEOUT_S = 120.0
EPOCH = "cellcrush-epoch"  # identifies the data of a daemon, in the metadata of its answers and of calls for it
SILENCE_S = 60.0  # a living watch sends something every 15 s
MAX_PAUSE_S = 5.0
RECOVERABLE = (grpc.StatusCode.UNAVAILABLE, grpc.StatusCode.DEADLINE_EXCEEDED, grpc.StatusCode.CANCELLED,
               grpc.StatusCode.RESOURCE_EXHAUSTED)

Event = TypeVar("Event")


def find_address(address: Optional[str]) -> str:
    """The given address, else $CELLCRUSH_SERVER, else the daemon's default socket, else its default port.

    >>> find_address("crusher:50551")
    'crusher:50551'
    """
    address = address or os.environ.get("CELLCRUSH_SERVER", "")
    if not address:
        data = os.environ.get("XDG_DATA_HOME") or os.path.expanduser("~/.local/share")
        socket = pathlib.Path(data, "cellcrush", "cellcrushd.sock")
        return f"unix:{socket}" if socket.is_socket() else DEFAULT_ADDRESS
    host, _, port = address.rpartition(":")
    if not (address.startswith("unix:") and len(address) > 5) and not (host and port.isdigit()):
        raise ValueError(f"address {address!r}: expected unix:PATH or HOST:PORT")
    return address


def _is_this_machine(address: str) -> bool:
    host = address.rpartition(":")[0].strip("[]")
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"


def _own_user() -> str:
    try:
        return pwd.getpwuid(os.geteuid()).pw_name
    except KeyError:
        return f"uid{os.geteuid()}"


class Connection:
    """A channel to a daemon. Every call of it is safe to repeat, and is repeated while the daemon does not answer. All
    are for the daemon that answered first: what names a job to it is not sent to another one."""

    def __init__(self, address: Optional[str], ca: Optional[str], token_file: Optional[str], certificate: Optional[str],
                 key: Optional[str], patience_s: float) -> None:
        self.address = find_address(address)
        # Any user may hold the default port.
        self.may_be_others = self.address == DEFAULT_ADDRESS and not (address or os.environ.get("CELLCRUSH_SERVER"))
        self.owner = ""  # of another user's daemon that was not named
        self.patience_s = patience_s
        self.is_private = False  # whether the daemon ends with this script
        self.metadata: Tuple[Tuple[str, str], ...] = ()
        self.credentials: Optional[grpc.ChannelCredentials] = None
        if not self.address.startswith("unix:"):
            self._read_credentials(ca, token_file, certificate, key)
        if self.credentials is None:
            channel = grpc.insecure_channel(self.address, options=OPTIONS)
        else:
            channel = grpc.secure_channel(self.address, self.credentials, options=OPTIONS)
        self.channel = channel
        self.cases = cases_service_pb2_grpc.CasesStub(channel)
        self.jobs = jobs_service_pb2_grpc.JobsStub(channel)
        self.sweeps = sweeps_service_pb2_grpc.SweepsStub(channel)
        self.admin = admin_service_pb2_grpc.AdminStub(channel)

    def _read_credentials(self, ca: Optional[str], token_file: Optional[str], certificate: Optional[str],
                          key: Optional[str]) -> None:
        ca = ca or os.environ.get("CELLCRUSH_TLS_CA")
        if bool(certificate) != bool(key):
            raise ValueError("certificate and key go together: give both or neither")
        if certificate and not ca:
            raise ValueError("certificate requires ca, the authority of the server's certificate")
        token_file = token_file or os.environ.get("CELLCRUSH_TOKEN_FILE")
        token = pathlib.Path(token_file).read_text() if token_file else os.environ.get("CELLCRUSH_TOKEN", "")
        if token_file and not token.strip():
            raise ValueError(f"token_file {token_file}: holds no token")
        if token.strip():
            if not ca and not _is_this_machine(self.address):
                raise ValueError(f"the token is not sent to {self.address} in plain text, where others could read it: "
                                 "turn on TLS with ca= or CELLCRUSH_TLS_CA")
            self.metadata = (("authorization", "Bearer " + token.strip()),)
        if ca:
            read = [pathlib.Path(file).read_bytes() if file else None for file in (ca, key, certificate)]
            self.credentials = grpc.ssl_channel_credentials(*read)

    def require(self) -> None:
        """Waits for the daemon for two seconds."""
        if not self._is_ready(2.0):
            raise NotConnected(f"no server answers at {self.address}. Start cellcrushd, or give its address to "
                               "connect().")
        if self.may_be_others:
            self._find_owner()

    def _find_owner(self) -> None:
        try:
            who = self.admin.WhoAmI(admin_service_pb2.WhoAmIRequest(), timeout=CALL_TIMEOUT_S, metadata=self.metadata)
            owner = who.server_owner
        except grpc.RpcError as error:
            # A daemon that does not let this user in says so at the next call.
            owner = "an unknown user" if error.code() == grpc.StatusCode.UNIMPLEMENTED else ""
        if owner and owner != _own_user():
            self.owner = owner
            print(f"cellcrush: using the server of {owner} at {self.address}", file=sys.stderr)

    def _require_named(self, request: Any) -> None:
        reading = ("Get", "List", "Check", "Preview", "Import", "WhoAmI")
        if self.owner and not type(request).__name__.startswith(reading):
            raise CrushError(f"the server at {self.address} belongs to {self.owner}, and is changed only if you name "
                             f"it: connect({self.address!r}). For a server of your own, start cellcrushd.")

    def _is_ready(self, timeout_s: float) -> bool:
        ready = grpc.channel_ready_future(self.channel)
        try:
            ready.result(timeout=timeout_s)
            return True
        except grpc.FutureTimeoutError:
            return False
        finally:
            ready.cancel()

    def _pause(self, patience: "Patience") -> bool:
        """Waits before another try; False when patience is up. Calls alone would not do: between them nothing drives
        the handshake of a new connection."""
        pause = patience.next_pause()
        if pause is None:
            return False
        time.sleep(pause)
        return self._is_ready(patience.left_s())

    def keep_epoch(self, answer: Any) -> None:
        """Names the epoch of the first answer in all later calls."""
        if EPOCH not in dict(self.metadata):
            self.metadata += tuple(pair for pair in answer.initial_metadata() or () if pair[0] == EPOCH)

    def refuse(self, error: Any) -> NoReturn:
        """Raises the exception for a call that failed."""
        if EPOCH in dict(tuple(error.trailing_metadata() or ())):  # of a server with another one than the call names
            raise ServerChanged(f"{self.address}: {error.details()} connect() again to use this server.") from None
        raise_error(error, self.address)

    def call(self, method: Callable[..., Event], request: Any) -> Event:
        """Calls a method; repeats it while the daemon is away."""
        self._require_named(request)
        patience = Patience(self.patience_s)
        while True:
            try:
                answer: Event
                answer, call = method.with_call(  # type: ignore[attr-defined]
                    request, timeout=CALL_TIMEOUT_S, metadata=self.metadata)
                self.keep_epoch(call)
                return answer
            except ValueError as error:
                if "closed channel" not in str(error):
                    raise
                raise NotConnected("the private daemon has stopped; call within `with private_server()`") from None
            except grpc.RpcError as error:
                lost = error.code() in (grpc.StatusCode.UNAVAILABLE, grpc.StatusCode.DEADLINE_EXCEEDED)
                if not lost or not self._pause(patience):
                    self.refuse(error)

    def pages(self, method: Callable[..., Event], request: Any) -> Iterator[Event]:
        """All pages of a list."""
        while True:
            page: Any = self.call(method, request)
            yield page
            if not page.next_page_token:
                return
            request.page_token = page.next_page_token

    def follow(self, method: Callable[..., Any], next_request: Callable[[], Any],
               is_complete: Callable[[], bool]) -> Iterator[Any]:
        """The messages of a stream, which goes on where it broke: `next_request` asks for what comes after the last."""
        patience = Patience(self.patience_s)
        while True:
            stream = method(next_request(), metadata=self.metadata)
            watchdog = Watchdog(stream.cancel)
            try:
                for message in stream:
                    watchdog.heard()
                    patience.renew()
                    self.keep_epoch(stream)
                    yield message
                if is_complete():
                    return
                lost = "the server closed the stream"
            except grpc.RpcError as error:
                if error.code() not in RECOVERABLE:
                    self.refuse(error)
                lost = error.details() or ""
            finally:
                watchdog.stop()
                stream.cancel()
            if not self._pause(patience):
                raise NotConnected(f"lost the connection to {self.address}: {lost}")


class Patience:
    """Pauses that double, up to a total."""

    def __init__(self, patience_s: float) -> None:
        self._patience_s = patience_s
        self.renew()

    def renew(self) -> None:
        self._end, self._next = time.monotonic() + self._patience_s, 0.25

    def next_pause(self) -> Optional[float]:
        """The next pause; None when patience is up."""
        pause, self._next = self._next, min(2 * self._next, MAX_PAUSE_S)
        return pause if time.monotonic() + pause <= self._end else None

    def left_s(self) -> float:
        return self._end - time.monotonic()


class Watchdog:
    """Cancels a stream on which nothing arrives."""

    def __init__(self, cancel: Callable[[], Any]) -> None:
        self._cancel, self._stop = cancel, threading.Event()
        self.heard()
        threading.Thread(target=self._run, daemon=True).start()

    def heard(self) -> None:
        self._last = time.monotonic()

    def stop(self) -> None:
        self._stop.set()

    def _run(self) -> None:
        while not self._stop.wait(1.0):
            if time.monotonic() - self._last > SILENCE_S:
                self._cancel()
                return
