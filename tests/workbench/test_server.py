"""The server of the workbench as a process of its own: who may ask, and what happens to files."""

import http.client
import json
import os
import re
import signal
import subprocess
import sys
import threading
from contextlib import suppress

import pytest

pytestmark = [pytest.mark.slow, pytest.mark.needs("starlette", "uvicorn")]
BROKEN = "G00 X40. Z0.\r\nG111 X100. A180. K-30. B120. P60.\r\nM30\r\n"
SECONDS = 60


class Served:
    """A server process, and requests to it as a browser sends them."""

    def __init__(self, *arguments, **environment):
        command = [sys.executable, "-m", "contoursolve", "serve", *map(str, arguments), "--no-browser"]
        self.process = subprocess.Popen(
            command,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, "PYTHONUNBUFFERED": "1", **environment},
        )
        self.programs, printed = {}, ""
        while "Ctrl-C" not in printed:
            line = self.process.stdout.readline()
            assert line, self.process.stderr.read()
            printed += line
        self.host, self.port, self.token = re.search(r"http://(.+):(\d+)/\?token=(\S+)", printed).groups()

    def send(self, method, path, body=b"", host=None, **headers):
        own = http.client.HTTPConnection("127.0.0.1", int(self.port), timeout=SECONDS)
        headers = {"Host": host or f"127.0.0.1:{self.port}", **{k.replace("_", "-"): v for k, v in headers.items()}}
        own.request(method, path, body, headers)
        reply = own.getresponse()
        data = reply.read()
        own.close()
        return reply.status, {name.lower(): value for name, value in reply.getheaders()}, data

    def ask(self, do, window="a", headers=None, **fields):
        """The status and the reply of an action."""
        own = {"Content_Type": "application/json", "X_Token": self.token, **(headers or {})}
        fields = {"program": self.programs.get(window), **fields}
        body = json.dumps({"window": window, "do": do, **fields}).encode()
        status, _, data = self.send("POST", "/ask", body, **own)
        reply = json.loads(data)
        if do == "open":
            self.programs[window] = reply.get("id")
        while reply.get("examined", 0) < reply.get("lines", 0):
            more = self.ask("go_on", window, headers, program=reply["id"])[1]
            reply |= {**more, "seq": reply["seq"]}
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


def test_a_strangers_page_is_refused(serve, tmp_path):
    served = serve(tmp_path)
    own = f"http://127.0.0.1:{served.port}"
    assert served.ask("hello")[0] == 200
    assert served.ask("hello", headers={"Origin": own, "Sec_Fetch_Site": "same-origin"})[0] == 200
    for headers in (
        {"X_Token": ""},
        {"X_Token": f"{served.token}x"},
        {"Origin": "http://evil.example"},
        {"Origin": "null"},
        {"Origin": f"http://localhost:{served.port}"},  # an address of this machine, but of another page
        {"Sec_Fetch_Site": "cross-site"},
        {"Sec_Fetch_Site": "same-site"},
        {"host": "evil.example"},
        {"host": f"evil.example:{served.port}"},
        {"host": f"127.0.0.1.evil.example:{served.port}"},
        {"host": f"192.168.1.7:{served.port}"},
        {"Content_Type": "text/plain"},
    ):
        status, *_ = served.send(
            "POST",
            "/ask",
            b'{"do":"hello"}',
            **{"Content_Type": "application/json", "X_Token": served.token, **headers},
        )
        assert status in (403, 415), headers
    # Another page may not ask whether it may send, nor read what comes.
    status, headers, _ = served.send("OPTIONS", "/ask", Origin=own, Access_Control_Request_Method="POST")
    assert status == 405
    assert not [name for name in headers if name.startswith("access-control")]


def test_the_page_is_given_to_who_knows_the_token(serve, tmp_path):
    served = serve(tmp_path)
    status, headers, page = served.send("GET", f"/?token={served.token}")
    assert status == 200
    assert b"workbench.js" in page
    assert headers["cache-control"] == "no-store"
    assert headers["referrer-policy"] == "no-referrer"
    assert headers["x-content-type-options"] == "nosniff"
    assert headers["content-security-policy"].startswith("default-src 'self'; ")
    assert "set-cookie" not in headers
    for address in ("/", "/?token=", f"/?token={served.token[:-1]}", "/?token=%ff"):
        assert served.send("GET", address)[0] == 403
    for name in ("/../desk.py", "/..%2fdesk.py", "/%2e%2e/desk.py", "//etc/passwd", "/..\\desk.py", "/nothing"):
        assert served.send("GET", name)[0] == 404, name


def test_what_is_no_action_is_refused_in_a_sentence(serve, tmp_path):
    served = serve(tmp_path)
    for body in (b"", b"{", b"[]", b"\xff", b"[" * 100_000, b"null", b'{"do":NaN}'):
        status, _, data = served.send("POST", "/ask", body, Content_Type="application/json", X_Token=served.token)
        assert status == 400
        assert json.loads(data)["trouble"]
    status, reply = served.ask("open", name="a", text="x" * 20_000_000)
    assert status == 413
    assert "20 MB" in reply["trouble"]


def test_two_windows_on_one_file_and_what_is_told_where_both_save(serve, tmp_path):
    (tmp_path / "part.nc").write_bytes(BROKEN.encode())
    served = serve(tmp_path / "part.nc")
    assert served.ask("hello")[1]["open"] == "part.nc"
    for window, words in (("a", "P5."), ("b", "P6.")):
        _, opened = served.ask("open", window, name="part.nc")
        _, changed = served.ask("edit", window, text=opened["text"].replace("P60.", words))
        assert changed["counts"]["errors"] == 0
    assert served.ask("save", "a")[1]["saved"] == "part.nc"
    _, refused = served.ask("save", "b")
    assert "another window or program changed the file" in refused["trouble"]
    assert (tmp_path / "part.nc").read_bytes() == BROKEN.replace("P60.", "P5.").encode()
    assert served.ask("save", "b", name="other.nc")[1]["saved"] == "other.nc"
    assert (tmp_path / "other.nc").read_bytes() == BROKEN.replace("P60.", "P6.").encode()
    served.ask("view", "b")
    (tmp_path / "other.nc").write_bytes(b"by hand")
    assert served.ask("save", "b", over=served.ask("save", "b")[1]["conflict"])[1]["saved"]


def test_a_server_that_is_killed_while_it_saves_leaves_the_old_file_or_the_new_one(serve, tmp_path):
    texts = [f"(TEXT {number})\r\n" * 20_000 for number in range(2)]
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


def test_actions_of_a_window_run_in_their_order_while_another_window_waits_for_none(serve, tmp_path):
    served = serve(tmp_path)
    served.ask("open", name="a.nc", text="")
    replies = []

    def type_line(number):
        replies.append(served.ask("edit", text=f"(line {number})\n" * number)[1])

    typing = [threading.Thread(target=type_line, args=(number,)) for number in range(1, 20)]
    for each in typing:
        each.start()
    assert served.ask("open", "b", name="b.nc", text=BROKEN)[1]["counts"]["errors"] == 1
    for each in typing:
        each.join()
    assert sorted(each["seq"] for each in replies) == [*range(1, 20)]


def test_ctrl_c_ends_it_and_a_port_that_is_taken_is_told(serve, tmp_path):
    served = serve(tmp_path)
    command = [sys.executable, "-m", "contoursolve", "serve", str(tmp_path), "--port", served.port, "--no-browser"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=SECONDS)
    assert done.returncode == 2
    assert done.stderr.startswith(f"Error: port {served.port} cannot be served")
    assert "Traceback" not in done.stderr
    # Also while it works: what is computed is given up.
    long = "G111 X100. A180. K-30. B120. P5.\n" * 1_000
    served.ask("open", name="a.nc", text=f"G00 X40. Z0.\n{long}")
    given_up = []
    working = threading.Thread(target=lambda: given_up.append(served.ask("report")))
    working.start()
    working.join(0.5)
    code, printed = served.end()
    working.join()
    assert given_up[0][0] == 503
    assert (code, printed) == (130, "stopped\n")


@pytest.mark.parametrize("arguments", [("nothing",), (".", "--port", "70000")])
def test_what_cannot_be_served_is_one_sentence(arguments, tmp_path):
    command = [sys.executable, "-m", "contoursolve", "serve", *arguments, "--no-browser"]
    done = subprocess.run(
        command,
        capture_output=True,
        text=True,
        check=False,
        timeout=SECONDS,
        cwd=tmp_path,
    )
    assert done.returncode == 2
    assert "Traceback" not in done.stderr


def test_on_a_full_disk_the_old_file_stays_and_there_is_room_later_for_the_new_one(serve, small_disk):
    file = small_disk.folder / "a.nc"
    file.write_bytes(BROKEN.encode())
    server = serve(small_disk.folder)
    server.ask("open", name="a.nc")
    longer = f"{BROKEN}({'x' * 8_000})\r\n"
    server.ask("edit", text=longer)
    small_disk.fill()
    full = "a.nc was not saved: it cannot be written: No space left on device; your text is still here"
    assert server.ask("save") == (200, {"trouble": full})
    assert server.ask("save", name="b.nc") == (200, {"trouble": full.replace("a.nc", "b.nc")})
    assert (small_disk.names(), file.read_bytes()) == (["a.nc"], BROKEN.encode())
    assert server.ask("view")[1]["has_changes"]
    small_disk.make_room()
    assert server.ask("save")[1]["saved"] == "a.nc"
    assert (small_disk.names(), file.read_bytes()) == (["a.nc"], longer.encode())
