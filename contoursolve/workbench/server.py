"""The server of the workbench: its page, and its desk behind `POST /ask`, for this machine alone.

A page of a stranger in the same browser can send requests here, but it knows no token, may set no header without being
asked first, and is refused by its origin and by the name of the host. Nothing of another host is ever loaded.
"""

import asyncio
import hashlib
import hmac
import json
import logging
import mimetypes
import socket
import sys
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any

import uvicorn
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import JSONResponse, PlainTextResponse, Response
from starlette.routing import Mount, Route
from starlette.staticfiles import StaticFiles

from contoursolve.diagnostics import UserError
from contoursolve.families import THREADS
from contoursolve.workbench.desk import Desk

MOST_BYTES = 20_000_000
"""Of a request."""

MOST_WAITING = 64
"""Actions of one window that wait for their turn."""

_WORKERS = 4
_PAGE = Path(__file__).with_name("page")
HOST = "127.0.0.1"
_LOOPBACK = frozenset((HOST, "localhost", "[::1]"))

_HEADERS = {
    "Content-Security-Policy": (
        # Pictures have their own styles inside.
        "default-src 'self'; img-src 'self' data: blob:; style-src 'self' 'unsafe-inline'; "
        "base-uri 'none'; form-action 'none'; frame-ancestors 'none'; object-src 'none'"
    ),
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
}

_TYPES = {".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml", ".wasm": "application/wasm"}
"""A registry of Windows may say otherwise, and a browser would not run the page."""


class CannotServeError(UserError, OSError):
    """The address cannot be served; the message says why and what to do."""


def _is_same(one: str, other: str) -> bool:
    """Whether two secrets are the same, in a time that does not tell how much of them is."""
    return hmac.compare_digest(*(hashlib.sha256(each.encode("utf-8", "replace")).digest() for each in (one, other)))


def _is_own(host: str) -> bool:
    """Whether a host is named as this machine is. A name that a stranger owns may lead here, too."""
    name = host.rpartition(":")[0] if host.rpartition(":")[2].isdigit() else host
    return name.lower() in _LOOPBACK


class Workbench:
    """The application: it takes actions one after the other for each window, in the order in which they came."""

    def __init__(self, desk: Desk, token: str) -> None:
        """Only who knows the token may ask."""
        self.desk, self.token = desk, token
        self._pool = ThreadPoolExecutor(_WORKERS, thread_name_prefix=THREADS)
        self._turns: dict[str, tuple[asyncio.Lock, int]] = {}
        """The turn of each window that has actions, and how many."""
        for ending, kind in _TYPES.items():
            mimetypes.add_type(kind, ending)
        routes = [
            Route("/", self.index),
            Route("/ask", self.ask, methods=["POST"]),
            Mount("/", StaticFiles(directory=_PAGE)),
        ]
        self._routed = Starlette(routes=routes)

    async def __call__(self, scope: Any, receive: Any, send: Any) -> None:
        """Answer one request (ASGI)."""
        if scope["type"] != "http":
            return
        request = Request(scope)

        async def send_guarded(message: Any) -> None:
            if message["type"] == "http.response.start":
                own = {**_HEADERS, "Cache-Control": "no-cache" if is_file else "no-store"}
                message["headers"] += [(name.lower().encode(), value.encode()) for name, value in own.items()]
            await send(message)

        is_file = request.method == "GET" and request.url.path != "/"
        if not _is_own(request.headers.get("host", "")):
            refused = PlainTextResponse(
                "This name is not that of the workbench; open the address that it printed.\n", 403
            )
            await refused(scope, receive, send_guarded)
            return
        await self._routed(scope, receive, send_guarded)

    async def index(self, request: Request) -> Response:
        """The page, for who knows the token."""
        if not _is_same(request.query_params.get("token", ""), self.token):
            told = "Open the whole address that contoursolve serve printed: it ends in a token.\n"
            return PlainTextResponse(told, 403)
        return Response((_PAGE / "index.html").read_bytes(), media_type="text/html")

    async def ask(self, request: Request) -> Response:
        """The reply to an action."""
        headers = request.headers
        own = f"http://{headers.get('host', '')}"
        if headers.get("origin", own) != own or headers.get("sec-fetch-site", "same-origin") != "same-origin":
            return _refused(403, "another page asked; only the workbench's own page may")
        if not _is_same(headers.get("x-token", ""), self.token):
            return _refused(403, "the token is another one; open the address that contoursolve serve printed last")
        if headers.get("content-type", "").partition(";")[0].strip().lower() != "application/json":
            return _refused(415, "an action is JSON")
        data = b""
        async for piece in request.stream():
            data += piece
            if len(data) > MOST_BYTES:
                most = f"{MOST_BYTES // 1_000_000} MB"
                return _refused(413, f"this is more than {most}, the most that is taken at once; nothing was changed")
        try:
            action = json.loads(data, parse_constant=_not_finite)
        except (ValueError, RecursionError):
            return _refused(400, "the action did not arrive whole; nothing was changed")
        if not isinstance(action, dict):
            return _refused(400, "an action is an object; nothing was changed")
        return await self._answer(action)

    async def _answer(self, action: Mapping[str, Any]) -> Response:
        window = str(action.get("window", ""))
        turn, waiting = self._turns.get(window, (asyncio.Lock(), 0))
        if waiting >= MOST_WAITING:
            return _refused(429, f"{waiting} actions of this window wait; send this one again in a moment")
        self._turns[window] = turn, waiting + 1
        try:
            async with turn:
                work = partial(self._work, action)
                data = await asyncio.get_running_loop().run_in_executor(self._pool, work)
        except asyncio.CancelledError:  # at Ctrl-C; what is computed is given up
            return _refused(503, "the workbench was ended; your text stays on the page")
        finally:
            turn, waiting = self._turns.pop(window)
            if waiting > 1:
                self._turns[window] = turn, waiting - 1
        return Response(data, media_type="application/json")

    def _work(self, action: Mapping[str, Any]) -> bytes:
        reply = self.desk.answer(action)
        # Surrogates that a program holds are no UTF-8; JSON has an escape for them.
        return json.dumps(reply, separators=(",", ":")).encode("ascii")


def _not_finite(name: str) -> float:
    raise ValueError(f"{name} is no number of JSON")


def _refused(status: int, trouble: str) -> Response:
    return JSONResponse({"trouble": trouble}, status)


def bind(port: int) -> socket.socket:
    """A socket at a port, or at a free one for 0. Raises CannotServeError."""
    own = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    # On Windows, two programs might share a port; elsewhere, one that has just ended might hold it.
    option = socket.SO_REUSEADDR
    if sys.platform == "win32":
        option = socket.SO_EXCLUSIVEADDRUSE
    try:
        own.setsockopt(socket.SOL_SOCKET, option, 1)
        own.bind((HOST, port))
        own.listen()
    except (OSError, OverflowError) as error:
        own.close()
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise CannotServeError(
            f"port {port} cannot be served: {reason}; name another one, or leave out --port for a free one"
        ) from None
    return own


def run(desk: Desk, token: str, own: socket.socket) -> None:
    """Serve until Ctrl-C, which raises KeyboardInterrupt."""
    config = uvicorn.Config(
        Workbench(desk, token),
        loop="asyncio",
        http="h11",
        ws="none",
        lifespan="off",
        log_config=None,
        access_log=False,
        proxy_headers=False,
        server_header=False,
        timeout_graceful_shutdown=2,
    )
    # What Ctrl-C gives up is no error.
    logging.getLogger("uvicorn.error").addFilter(lambda record: not record.getMessage().startswith("Cancel "))
    uvicorn.Server(config).run(sockets=[own])
