"""The server behind `stand_ins/browser`: it sends a site, and does with NumPy and CasADi what its pages ask for."""

import builtins
import operator
import pickle
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from io import BytesIO
from pathlib import Path
from threading import Lock, Thread
from types import SimpleNamespace
from typing import Any

import casadi
import numpy

_PACKAGES = SimpleNamespace(numpy=numpy, casadi=casadi)
_CLASSES = {numpy.ndarray: "array", numpy.generic: "array", casadi.SX: "SX", casadi.Function: "Function"}


class _Desk:
    """The arrays and expressions of the pages, by number."""

    def __init__(self) -> None:
        self.things: dict[int, Any] = {}
        self.number = 0
        self.lock = Lock()

    def answer(self, request: bytes) -> bytes:
        """What comes of one request."""
        with self.lock, numpy.errstate(all="ignore"):
            gone, kind, *rest = _Unpickler(self, BytesIO(request)).load()
            for number in gone:
                self.things.pop(number, None)
            try:
                found = getattr(self, kind)(*rest)
            except numpy.linalg.LinAlgError as error:
                found = ArithmeticError(str(error))
            except Exception as error:
                found = error
            written = BytesIO()
            _Pickler(self, written).dump(found)
            return written.getvalue()

    def method(self, thing: Any, name: str, args: Any, options: Any) -> Any:
        return getattr(thing, name)(*args, **options)

    def attribute(self, thing: Any, name: str) -> Any:
        return getattr(thing, name)

    def builtin(self, name: str, thing: Any) -> Any:
        return getattr(builtins, name)(thing)

    def operator(self, name: str, operands: Any) -> Any:
        return getattr(operator, name)(*operands)

    def call(self, path: str, args: Any, options: Any) -> Any:
        return operator.attrgetter(path)(_PACKAGES)(*args, **options)

    def evaluate(self, function: Any, given: list[list[float]], sizes: list[int]) -> list[list[float]]:
        buffer, trigger = function.buffer()
        arguments, results = [numpy.array(each) for each in given], [numpy.zeros(size) for size in sizes]
        for number, each in enumerate(arguments):
            buffer.set_arg(number, memoryview(each))
        for number, each in enumerate(results):
            buffer.set_res(number, memoryview(each))
        trigger()
        return [each.tolist() for each in results]


class _Unpickler(pickle.Unpickler):
    def __init__(self, desk: _Desk, file: Any) -> None:
        super().__init__(file)
        self.desk = desk

    def persistent_load(self, told: Any) -> Any:
        return self.desk.things[told] if isinstance(told, int) else operator.attrgetter(told)(_PACKAGES)


class _Pickler(pickle.Pickler):
    def __init__(self, desk: _Desk, file: Any) -> None:
        super().__init__(file, 4)
        self.desk = desk

    def persistent_id(self, each: Any) -> Any:
        if isinstance(each, numpy.float64):
            return "number", float(each)
        if isinstance(each, numpy.dtype) or (isinstance(each, type) and issubclass(each, numpy.generic)):
            return "name", f"numpy.{numpy.dtype(each).name}"
        if isinstance(each, (bool, int, float, str, bytes, tuple, list, type(None), Exception, type)):
            return None
        self.desk.number += 1
        self.desk.things[self.desk.number] = each
        return next((name for kind, name in _CLASSES.items() if isinstance(each, kind)), "other"), self.desk.number

    def reducer_override(self, each: Any) -> Any:
        # Named tuples are known only here.
        return (tuple, (list(each),)) if isinstance(each, tuple) else NotImplemented


class _Handler(SimpleHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    disable_nagle_algorithm, wbufsize = True, -1  # an answer is sent at once, and whole

    def __init__(self, *args: Any, desk: _Desk, folders: dict[str, Path], **options: Any) -> None:
        self.desk, self.folders = desk, folders
        super().__init__(*args, **options)

    def translate_path(self, path: str) -> str:
        first, _, rest = path.partition("?")[0].lstrip("/").partition("/")
        return str(self.folders[first] / rest) if first in self.folders else super().translate_path(path)

    def do_POST(self) -> None:
        found = self.desk.answer(self.rfile.read(int(self.headers["Content-Length"])))
        self.send_response(200)
        self.send_header("Content-Length", str(len(found)))
        self.end_headers()
        self.wfile.write(found)
        self.wfile.flush()

    def handle(self) -> None:
        with suppress(ConnectionResetError):  # the page is closed
            super().handle()

    def log_message(self, *_: Any) -> None:
        pass


@contextmanager
def serving(site: Path, **folders: Path) -> Iterator[str]:
    """The address of a server of a site on this machine, with other folders below names of their own."""
    handler = partial(_Handler, desk=_Desk(), folders=folders, directory=str(site))
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        server.daemon_threads = True
        Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()
