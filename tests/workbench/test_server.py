"""The server of the workbench: who may ask, in this process; and what only a process of its own can show."""

import asyncio
import http.client
import json
import os
import re
import signal
import socket
import subprocess
import sys
import threading
import webbrowser
from contextlib import suppress
from queue import SimpleQueue
from urllib.parse import unquote_to_bytes

import pytest
from click.testing import CliRunner

from contoursolve.__main__ import commands

pytestmark = pytest.mark.needs("starlette", "uvicorn")
SECONDS = 60
JSON = "application/json"


class Application:
    """The application that `contoursolve serve` makes, and requests to it as a server hands them over."""

    def __init__(self, monkeypatch, *arguments):
        import uvicorn  # noqa: PLC0415 - skipped without it

        found = []
        monkeypatch.setattr(uvicorn.Server, "run", lambda self, sockets: found.extend((self.config.app, *sockets)))
        self.shown = SimpleQueue()
        monkeypatch.setattr(webbrowser, "open", self.shown.put)
        done = CliRunner().invoke(commands(), ["serve", *map(str, arguments)])
        assert done.exit_code == 0, done.output
        self.application, self.socket = found
        self.printed = done.output.splitlines()
        self.port, self.token = re.fullmatch(r"http://127\.0\.0\.1:(\d+)/\?token=(.{32})", self.printed[1]).groups()
        self.host = f"127.0.0.1:{self.port}"

    async def request(self, method, address, body=b"", **headers):
        """The status, the headers and the body of a reply."""
        path, _, query = address.partition("?")
        named = {"host": self.host, **{name.replace("_", "-").lower(): value for name, value in headers.items()}}
        scope = {
            "type": "http",
            "method": method,
            "path": unquote_to_bytes(path).decode(errors="replace"),
            "query_string": query.encode(),
            "headers": [(name.encode(), value.encode()) for name, value in named.items()],
        }
        parts = [{"type": "http.request", "body": body[at : at + 10**6]} for at in range(0, len(body) + 1, 10**6)]
        coming = iter([{**part, "more_body": number < len(parts)} for number, part in enumerate(parts, 1)])
        sent = []

        async def receive():
            return next(coming, None) or await asyncio.Event().wait()

        async def send(message):
            sent.append(message)

        await self.application(scope, receive, send)
        first, *rest = sent
        replied = {name.decode(): value.decode() for name, value in first["headers"]}
        return first["status"], replied, b"".join(each.get("body", b"") for each in rest)

    def send(self, method, address, body=b"", **headers):
        return asyncio.run(self.request(method, address, body, **headers))

    async def asked(self, action, **headers):
        body = action if isinstance(action, bytes) else json.dumps(action).encode()
        headers = {"Content_Type": JSON, "X_Token": self.token, **headers}
        status, _, data = await self.request("POST", "/ask", body, **headers)
        return status, json.loads(data)

    def ask(self, action, **headers):
        """The status and the reply of an action, or of what is none."""
        return asyncio.run(self.asked(action, **headers))


@pytest.fixture
def application(monkeypatch, tmp_path):
    found = Application(monkeypatch, tmp_path, "--no-browser")
    yield found
    found.socket.close()


@pytest.mark.parametrize("has_browser", [True, False])
def test_the_address_is_printed_and_opened_in_a_browser_unless_there_is_to_be_none(has_browser, monkeypatch, tmp_path):
    (tmp_path / "part.nc").write_bytes(b"M30")
    monkeypatch.chdir(tmp_path)
    found = Application(monkeypatch, "part.nc" if has_browser else ".", *([] if has_browser else ["--no-browser"]))
    address = f"http://{found.host}/?token={found.token}"
    assert found.printed == [f"The workbench of {tmp_path}:", address, "Ctrl-C ends it."]
    if has_browser:
        assert found.shown.get(timeout=SECONDS) == address
    assert found.shown.empty()
    assert found.socket.getsockname() == ("127.0.0.1", int(found.port))
    status, hello = found.ask({"do": "hello"})
    assert (status, hello["open"], hello["folder"]) == (200, "part.nc" if has_browser else "", tmp_path.name)
    found.socket.close()


def test_what_cannot_be_served_is_one_sentence(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        port = str(other.getsockname()[1])
        taken = f"port {port} cannot be served: Address already in use; name another one, or leave out --port for a"
        for arguments, told in (
            (["--port", port], f"Error: {taken} free one\n"),
            (["nothing"], "Error: nothing: no such file or folder\n"),
            (["--port", "65536"], "Error: Invalid value for '--port': 65536 is not in the range 0<=x<=65535.\n"),
        ):
            done = CliRunner().invoke(commands(), ["serve", "--no-browser", *arguments])
            assert (done.exit_code, done.stdout, done.stderr[-len(told) :]) == (2, "", told)


FOREIGN = "another page asked; only the workbench's own page may"
STRANGE = "the token is another one; open the address that contoursolve serve printed last"
NAMED = b"This name is not that of the workbench; open the address that it printed.\n"


@pytest.mark.parametrize(
    ("headers", "trouble"),
    [
        ({}, None),
        ({"Origin": "http://{host}", "Sec_Fetch_Site": "same-origin"}, None),
        ({"Content_Type": "Application/JSON ; charset=utf-8"}, None),
        ({"Host": "LOCALHOST:{port}"}, None),
        ({"Host": "localhost"}, None),
        ({"Host": "[::1]:9"}, None),
        ({"X_Token": ""}, STRANGE),
        ({"X_Token": "{token}x"}, STRANGE),
        ({"Origin": "http://evil.example"}, FOREIGN),
        ({"Origin": "null"}, FOREIGN),
        ({"Origin": "http://localhost:{port}"}, FOREIGN),  # an address of this machine, but of another page
        ({"Sec_Fetch_Site": "cross-site"}, FOREIGN),
        ({"Sec_Fetch_Site": "same-site"}, FOREIGN),
        ({"Origin": "http://{host}", "Sec_Fetch_Site": "none"}, FOREIGN),
        ({"Content_Type": "text/plain"}, "an action is JSON"),
        ({"Content_Type": ""}, "an action is JSON"),
    ],
    ids=str,
)
def test_only_the_own_page_may_ask(headers, trouble, application):
    named = {name: text.format(**vars(application)) for name, text in headers.items()}
    status, reply = application.ask({"do": "files"}, **named)
    refused = 415 if trouble == "an action is JSON" else 403
    assert (status, reply) == ((refused, {"trouble": trouble}) if trouble else (200, {"files": [], "left_out": 0}))


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:{port}", "127.0.0.1.evil.example:{port}", "192.168.1.7:{port}", "", "::1"]
)
def test_another_name_of_this_machine_is_none_of_the_workbench(host, application):
    for method, address in (("GET", f"/?token={application.token}"), ("POST", "/ask"), ("GET", "/workbench.js")):
        status, _, data = application.send(method, address, host=host.format(**vars(application)))
        assert (status, data) == (403, NAMED)


def test_the_page_is_given_to_who_knows_the_token_and_asks_nobody_else(application):
    guards = {
        "content-security-policy": (
            "default-src 'self'; img-src 'self' data: blob:; style-src 'self' 'unsafe-inline'; "
            "base-uri 'none'; form-action 'none'; frame-ancestors 'none'; object-src 'none'"
        ),
        "x-content-type-options": "nosniff",
        "referrer-policy": "no-referrer",
        "cross-origin-opener-policy": "same-origin",
        "cross-origin-resource-policy": "same-origin",
    }
    status, headers, page = application.send("GET", f"/?token={application.token}")
    assert (status, b"workbench.js" in page) == (200, True)
    size, own = str(len(page)), {"cache-control": "no-store"}
    assert headers == {"content-length": size, "content-type": "text/html; charset=utf-8", **guards, **own}
    for name, kind in (("workbench.js", "text/javascript"), ("workbench.css", "text/css")):
        status, headers, _ = application.send("GET", f"/{name}")
        assert (status, headers["content-type"].partition(";")[0]) == (200, kind)
        assert headers["cache-control"] == "no-cache"
    status, headers, told = application.send("GET", "/")
    assert (status, headers) == (403, {**headers, **guards, **own})
    assert told == b"Open the whole address that contoursolve serve printed: it ends in a token.\n"
    for address in ("/?token=", f"/?token={application.token[:-1]}", "/?token=%ff"):
        assert application.send("GET", address)[0] == 403
    for name in ("/../desk.py", "/..%2fdesk.py", "/%2e%2e/desk.py", "//etc/passwd", "/..\\desk.py", "/nothing"):
        assert application.send("GET", name)[0] == 404, name
    # Another page may not ask whether it may send, nor read what comes.
    own = f"http://{application.host}"
    status, headers, _ = application.send("OPTIONS", "/ask", Origin=own, Access_Control_Request_Method="POST")
    assert (status, [name for name in headers if name.startswith("access-control")]) == (405, [])


BROKEN_OFF, NO_OBJECT = (
    "the action did not arrive whole; nothing was changed",
    "an action is an object; nothing was changed",
)


@pytest.mark.parametrize(
    ("body", "status", "trouble"),
    [
        *((body, 400, BROKEN_OFF) for body in (b"", b"{", b"\xff", b"[" * 100_000, b'{"do":NaN}')),
        *((body, 400, NO_OBJECT) for body in (b"[]", b"null", b"3", b'"hello"')),
        (b"{}", 200, "nothing is called None here"),
        pytest.param(b"{}".ljust(20_000_000), 200, "nothing is called None here", marks=pytest.mark.boundary),
        pytest.param(
            b"{}".ljust(20_000_001),
            413,
            "this is more than 20 MB, the most that is taken at once; nothing was changed",
            marks=pytest.mark.boundary,
        ),
    ],
    ids=lambda each: repr(each)[:12] if isinstance(each, bytes) else "",
)
def test_what_is_no_action_is_refused_in_a_sentence(body, status, trouble, application):
    assert application.ask(body) == (status, {"trouble": trouble})


def test_actions_of_a_window_run_in_their_order_and_64_of_them_wait(application):
    async def type_quickly():
        _, opened = await application.asked({"window": "a", "do": "open", "name": "a.nc", "text": ""})
        typing = [
            application.asked({"window": "a", "do": "edit", "program": opened["id"], "text": f"(line {number})"})
            for number in range(70)
        ]
        *replies, other = await asyncio.gather(*typing, application.asked({"window": "b", "do": "files"}))
        # When all are answered, the window may ask again.
        return replies, other, await application.asked({"window": "a", "do": "view", "program": opened["id"]})

    replies, other, view = asyncio.run(type_quickly())
    assert [reply["seq"] for _, reply in replies[:64]] == [*range(1, 65)]
    refused = {"trouble": "64 actions of this window wait; send this one again in a moment"}
    assert replies[64:] == [(429, refused)] * 6
    assert other == (200, {"files": [], "left_out": 0})
    assert (view[0], view[1]["text"]) == (200, "(line 63)")


# With a slice of 0, as on a busy machine, each request examines one block or contour.
SLICED = """
import sys
from contoursolve.__main__ import main
from contoursolve.workbench import open_view
open_view.MOMENT = 0
sys.exit(main())
"""


class Served:
    """A server process, and requests to it as a browser sends them."""

    def __init__(self, *arguments, is_sliced=False, **environment):
        start = ("-c", SLICED) if is_sliced else ("-m", "contoursolve")
        command = [sys.executable, *start, "serve", *map(str, arguments), "--no-browser"]
        self.process = subprocess.Popen(
            command,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, "PYTHONUNBUFFERED": "1", **environment},
        )
        self.program, printed = None, ""
        while "Ctrl-C" not in printed:
            line = self.process.stdout.readline()
            assert line, self.process.stderr.read()
            printed += line
        self.host, self.port, self.token = re.search(r"http://(.+):(\d+)/\?token=(\S+)", printed).groups()

    def ask(self, do, **fields):
        """The status and the reply of an action."""
        own = http.client.HTTPConnection("127.0.0.1", int(self.port), timeout=SECONDS)
        body = json.dumps({"window": "a", "do": do, "program": self.program, **fields})
        own.request("POST", "/ask", body, {"Content-Type": JSON, "X-Token": self.token})
        answer = own.getresponse()
        status, reply = answer.status, json.loads(answer.read())
        own.close()
        self.program = reply.get("id", self.program)
        return status, reply

    def end(self):
        self.process.send_signal(signal.SIGINT)
        printed = self.process.communicate(timeout=SECONDS)
        return self.process.returncode, printed[1]


@pytest.fixture
def serve():
    started = []

    def start(*arguments, **environment):
        started.append(Served(*arguments, **environment))
        return started[-1]

    yield start
    for each in started:
        each.process.kill()
        each.process.communicate()


@pytest.mark.slow
def test_a_server_that_is_killed_while_it_saves_leaves_the_old_file_or_the_new_one(serve, tmp_path):
    texts = [f"(TEXT {number} {'x' * 2_000})\r\n" * 100 for number in range(2)]
    (tmp_path / "part.nc").write_bytes(texts[0].encode())

    def save(served):
        with suppress(OSError, http.client.HTTPException):
            for number in range(1_000):
                served.ask("edit", text=texts[number % 2].replace("\r", ""))
                served.ask("save")

    for moment in range(4):
        served = serve(tmp_path)
        served.ask("open", name="part.nc")
        saving = threading.Thread(target=save, args=(served,))
        saving.start()
        saving.join(0.3 * (moment + 1))
        served.process.kill()
        saving.join()
        assert (tmp_path / "part.nc").read_bytes().decode() in texts


@pytest.mark.slow
def test_ctrl_c_ends_it_also_while_it_works(serve, tmp_path):
    served = serve(tmp_path)
    long = "G111 X100. A180. K-30. B120. P5.\n" * 300
    served.ask("open", name="a.nc", text=f"G00 X40. Z0.\n{long}")
    given_up = []
    working = threading.Thread(target=lambda: given_up.append(served.ask("report")))
    working.start()
    working.join(0.5)
    ended = served.end()
    working.join()
    assert given_up == [(503, {"trouble": "the workbench was ended; your text stays on the page"})]
    assert ended == (130, "stopped\n")
