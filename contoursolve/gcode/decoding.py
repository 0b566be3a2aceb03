"""Decoding of a program's bytes. Files that are no program are known by their first or their control bytes, and
refused."""

import codecs
import re
from collections.abc import Iterable

from contoursolve.gcode.text import UnreadableProgramError

_TAPE_CODES = bytes([0x02, 0x03, 0x11, 0x12, 0x13, 0x14, 0x1A])
"""STX, ETX, DC1 to DC4 and SUB: left in a program by a reader of paper tape or by DOS."""

_CONTROLS = bytes(each for each in range(0x20) if each not in b"\t\n\v\f\r" + _TAPE_CODES)
_LEADER = re.compile(rb"\0{2,}")
"""Blank tape before and behind a program."""
_MOST_CONTROLS = 1 / 32
"""The share of other control bytes in a text that came over a poor line."""
_HEAD = 4096
"""Bytes in which a file shows what it is."""

_WIDE = "UTF-16 text"
_KINDS = tuple(
    (re.compile(pattern, re.MULTILINE), kind)
    for pattern, kind in (
        (rb"\A%PDF-", "a PDF document"),
        (rb"\APK\x03\x04", "a zip archive or a spreadsheet"),
        (rb"\A\xd0\xcf\x11\xe0", "an Office document"),
        (rb"\A(?:\x7fELF|MZ.{0,100}\0)", "an executable"),
        (rb"\A(?:\x89PNG|GIF8|\xff\xd8\xff|BM.{4}\0{4})", "a picture"),
        (rb"\A(?:CDF[\x01\x02\x05]|\x89HDF)", "netCDF data"),
        (rb"\A(?:\xff\xfe|\xfe\xff|[ -~]\0[ -~\r]\0|\0[ -~]\0[ -~\r])", _WIDE),
        (rb"\A(?:\xef\xbb\xbf)?\s*<(?:\?xml|!DOCTYPE|html|svg)\b", "an XML or HTML file"),
        (rb"\A(?:\xef\xbb\xbf)?\s*[{\[]\s*(?:[{\[]\s*)*\"", "JSON data"),
        (rb"\A#!.*python|^(?:from [\w.]+ import |import [a-z][\w.]*\r?$|def \w+\(.*\).*:\r?$)", "Python source"),
        (rb"^[ \t]*#[ \t]*(?:include[ \t]*[<\"]|ifndef[ \t]|ifdef[ \t]|pragma[ \t]+once)", "C source"),
        (rb"\Asolid\b[^\n]*\n\s*facet\b", "an STL model"),
        (rb"\A(?:\s*999\r?\n.*\n)*\s*0\r?\n\s*SECTION\b", "a DXF drawing"),
        (rb"\AISO-10303-21;", "a STEP model"),
    )
)


def encoding_of(chunks: Iterable[bytes], name: str) -> tuple[str, bytes]:
    """UTF-8 where every byte fits, else Latin-1, which gives every byte back; and the byte order mark of UTF-8.

    Raises UnreadableProgramError for what is no program: `name` is what the message calls it.
    """
    decoder, head, controls, size, is_utf8 = codecs.getincrementaldecoder("utf-8")(), b"", 0, 0, True
    for chunk in chunks:
        head = head or chunk[:_HEAD]
        rest = _LEADER.sub(b"", chunk)
        size, controls = size + len(rest), controls + len(rest) - len(rest.translate(None, _CONTROLS))
        try:
            is_utf8 = is_utf8 and decoder.decode(chunk) is not None
        except UnicodeDecodeError:
            is_utf8 = False
    try:
        decoder.decode(b"", is_utf8)
    except UnicodeDecodeError:
        is_utf8 = False
    kind = next((kind for pattern, kind in _KINDS if pattern.search(head)), "")
    if not kind and controls > size * _MOST_CONTROLS:
        kind = "binary data"
    if kind:
        advice = ": save it as UTF-8 or Latin-1 text" if kind is _WIDE else ", no CNC program"
        raise UnreadableProgramError(f"{name} is {kind}{advice}")
    mark = codecs.BOM_UTF8 if is_utf8 and head.startswith(codecs.BOM_UTF8) else b""
    return ("utf-8" if is_utf8 else "latin-1"), mark


def decode(data: bytes, name: str) -> str:
    """Text in UTF-8 or Latin-1. Raises UnreadableProgramError for what is no program."""
    encoding, mark = encoding_of([data], name)
    return data[len(mark) :].decode(encoding)
