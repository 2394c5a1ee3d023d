"""Whether a running server keeps to RFC 6455, shape by shape, byte by byte.

    target/release/espalier --port 7800 --database conformance.db &
    python3 tests/conformance/websocket.py http://127.0.0.1:7800

The cases are those that Autobahn's test suite has for servers, in its order, as far as a server can be asked that is no
echo: where that suite compares an echo, here a `ping` of the protocol is asked and its `pong` is read. It needs nothing
but Python 3.9, begins one session, prints a table, and fails where a case does.
"""

import argparse
import struct
import sys

from wire import BINARY, CLOSE, CONTINUED, LAST, LONGEST, PING, PONG, TEXT, Server, Wrong, frame

CASES = []


def case(group, name):
    def add(test):
        CASES.append((group, name, test))
        return test

    return add


def text_of(length, chop=None):
    def test(server):
        to = server.socket()
        to.say(frame(LAST | TEXT, to.ask().ljust(length)), chop)
        to.is_answered()
        to.goes_on()

    return test


def refused(code, data, chop=None):
    """Sent to a socket, this closes it with a code."""

    def test(server):
        to = server.socket()
        to.say(data, chop)
        to.closes(*code if isinstance(code, tuple) else (code,))

    return test


def taken(data, chop=None):
    """Sent to a socket, this changes nothing."""

    def test(server):
        to = server.socket()
        to.say(data, chop)
        to.goes_on()

    return test


def handshakes():
    for name, status, changes in [
        ("another version is answered with ours", (400, 426), {"sec_websocket_version": "8"}),
        ("no key", (400,), {"sec_websocket_key": None}),
        ("no upgrade", (400, 426), {"upgrade": None}),
        ("no connection", (400, 426), {"connection": "close"}),
        ("HTTP/1.0", (400, 426, 505), {"version": "1.0"}),
        ("POST", (400, 405), {"method": "POST"}),
    ]:

        def test(server, status=status, changes=changes):
            answer = server.upgrade(**changes)[0]
            if answer not in status:
                raise Wrong(f"answered {answer}")

        case("opening", name)(test)
    for name, changes in [
        ("letters large and small", {"upgrade": "WebSocket", "connection": "keep-alive, upgrade"}),
        ("an extension is not taken up", {"sec_websocket_extensions": "permessage-deflate; client_max_window_bits"}),
        ("a subprotocol is not taken up", {"sec_websocket_protocol": "mqtt, wamp"}),
    ]:

        def test(server, changes=changes):
            status, told, _ = server.upgrade(**changes)
            if status != 101:
                raise Wrong(f"answered {status}")
            if "sec-websocket-extensions" in told or "sec-websocket-protocol" in told:
                raise Wrong(f"something was taken up: {told}")

        case("opening", name)(test)


def framing():
    for length in (0, 125, 126, 127, 128, 65535, 65536, 65537, LONGEST):
        name = f"text of {length} bytes"
        if length == 0:
            case("frames", name)(taken(frame(LAST | TEXT)))
        else:
            case("frames", name)(text_of(length))
    for length in (0, 125, 126, 127, 128, 65535, 65536):
        case("frames", f"binary of {length} bytes is answered, and the socket lives")(
            taken(frame(LAST | BINARY, b"\xfe" * length))
        )
    for length, chop in ((60, 1), (1000, 3), (65536, 997), (LONGEST, 1460)):
        case("frames", f"text of {length} bytes in writes of {chop}")(text_of(length, chop))
    case("frames", "a hundred in one write")(
        lambda server: many_at_once(server, 100),
    )
    case("frames", "without a mask")(refused(1002, frame(LAST | TEXT, b"{}", mask=False)))
    case("frames", "a control frame without a mask")(refused(1002, frame(LAST | PING, b"x", mask=False)))


def many_at_once(server, count):
    to = server.socket()
    to.say(b"".join(frame(LAST | TEXT, to.ask()) for _ in range(count)))
    to.is_answered()
    to.goes_on()


def pinged(payload, chop=None, between=False):
    def test(server):
        to = server.socket()
        if between:
            whole = to.ask()
            to.say(frame(TEXT, whole[:5]))
        to.say(frame(LAST | PING, payload), chop)
        to.until(lambda first, heard: first == LAST | PONG and heard == payload)
        if between:
            to.say(frame(LAST | CONTINUED, whole[5:]))
            to.is_answered()
        to.goes_on()

    return test


def pings():
    case("pings", "without a payload")(pinged(b""))
    case("pings", "with text")(pinged(b"Hello, world!"))
    case("pings", "with bytes that are no text")(pinged(bytes([0, 255, 254, 253, 252, 251, 0, 255])))
    case("pings", "with 125 bytes")(pinged(b"\xfe" * 125))
    case("pings", "with 126 bytes")(refused(1002, frame(LAST | PING, b"\xfe" * 126)))
    case("pings", "with 125 bytes, byte by byte")(pinged(b"\xfe" * 125, chop=1))
    case("pings", "between the pieces of a text")(pinged(b"between", between=True))
    case("pings", "a pong that nobody asked for")(taken(frame(LAST | PONG)))
    case("pings", "such a pong with a payload")(taken(frame(LAST | PONG, b"unasked")))
    case("pings", "a pong with 126 bytes")(refused(1002, frame(LAST | PONG, b"x" * 126)))
    for chop in (None, 1):

        def ten(server, chop=chop):
            to = server.socket()
            to.say(b"".join(frame(LAST | PING, b"ping %d" % number) for number in range(10)), chop)
            # Of pings that come before the answer to an earlier one only the last must be answered (5.5.3).
            to.until(lambda first, heard: first == LAST | PONG and heard == b"ping 9")
            to.goes_on()

        case("pings", "ten at once" + (", byte by byte" if chop else ""))(ten)


def reserved_bits():
    for bits in range(1, 8):
        first = LAST | bits << 4
        case("reserved bits", f"{bits:03b} in a text")(refused(1002, frame(first | TEXT, b"{}")))
        case("reserved bits", f"{bits:03b} in a ping")(refused(1002, frame(first | PING, b"x")))
    case("reserved bits", "in a close")(refused(1002, frame(LAST | 0x40 | CLOSE, b"\x03\xe8")))
    case("reserved bits", "in a piece")(
        refused(1002, frame(TEXT, b"{") + frame(LAST | 0x20 | CONTINUED, b"}"))
    )
    case("reserved bits", "after a text, byte by byte")(
        refused(1002, frame(LAST | TEXT, b"{}") + frame(LAST | 0x70 | TEXT, b"{}"), chop=1)
    )


def opcodes():
    for opcode in (3, 4, 5, 6, 7, 11, 12, 13, 14, 15):
        case("opcodes", f"{opcode}")(refused(1002, frame(LAST | opcode, b"x")))
        case("opcodes", f"{opcode} without a payload, after a text")(
            refused(1002, frame(LAST | TEXT, b"{}") + frame(LAST | opcode))
        )


def pieces(cuts, chop=None, between=b""):
    def test(server):
        to = server.socket()
        whole = to.ask()
        edges = [0, *cuts(len(whole)), len(whole)]
        parts = [whole[start:end] for start, end in zip(edges, edges[1:])]
        frames = []
        for index, part in enumerate(parts):
            first = (TEXT if index == 0 else CONTINUED) | (LAST if index == len(parts) - 1 else 0)
            frames.append(frame(first, part))
        to.say(between.join(frames), chop)
        to.is_answered()
        to.goes_on()

    return test


def fragmentation():
    ping = frame(LAST | PING, b"between")
    for name, cuts in [
        ("two", lambda length: [length // 2]),
        ("one for each byte", lambda length: range(1, length)),
        ("with empty ones", lambda length: [0, 0, 3, 3, length]),
    ]:
        case("pieces", name)(pieces(cuts))
        case("pieces", f"{name}, byte by byte")(pieces(cuts, chop=1))
        case("pieces", f"{name}, with pings between")(pieces(cuts, between=ping))
    case("pieces", "all of them empty")(
        taken(frame(TEXT) + frame(CONTINUED) + frame(LAST | CONTINUED))
    )
    case("pieces", "a ping in pieces")(refused(1002, frame(PING, b"a") + frame(LAST | CONTINUED, b"b")))
    case("pieces", "a pong in pieces")(refused(1002, frame(PONG, b"a") + frame(LAST | CONTINUED, b"b")))
    case("pieces", "a close in pieces")(refused(1002, frame(CLOSE, b"\x03\xe8")))
    case("pieces", "a last one of nothing")(refused(1002, frame(LAST | CONTINUED, b"{}")))
    case("pieces", "a middle one of nothing")(refused(1002, frame(CONTINUED, b"{}")))
    case("pieces", "one more after the last")(
        refused(1002, frame(TEXT, b"{") + frame(LAST | CONTINUED, b"}") + frame(LAST | CONTINUED, b"}"))
    )
    case("pieces", "a text within a text")(refused(1002, frame(TEXT, b"{") + frame(LAST | TEXT, b"}")))
    case("pieces", "a binary within a text")(refused(1002, frame(TEXT, b"{") + frame(LAST | BINARY, b"}")))
    case("pieces", "a text within a binary")(refused(1002, frame(BINARY, b"{") + frame(LAST | TEXT, b"}")))


VALID = [
    ("words", "κόσμε, Grüße, 木".encode()),
    ("first of two bytes", "\u0080".encode()),
    ("first of three", "\u0800".encode()),
    ("first of four", "\U00010000".encode()),
    ("last of one", "\u007f".encode()),
    ("last of two", "\u07ff".encode()),
    ("last of three", "\uffff".encode()),
    ("last of four", "\U0010ffff".encode()),
    ("before surrogates", "\ud7ff".encode()),
    ("after surrogates", "\ue000".encode()),
    ("no characters", "\ufffe\U0001fffe\U0010fffe".encode()),
    ("nothing", b"\x00"),
]
INVALID = [
    ("a continuation alone", b"\x80"),
    ("the last one alone", b"\xbf"),
    ("many of them", b"\x80\xbf" * 3),
    ("all of them", bytes(range(0x80, 0xC0))),
    ("two bytes without the second", b"\xc3 "),
    ("three without the last", b"\xe2\x82 "),
    ("four without the last", b"\xf0\x9f\x8c "),
    ("fe", b"\xfe"),
    ("ff", b"\xff"),
    ("fe fe ff ff", b"\xfe\xfe\xff\xff"),
    ("/ in two bytes", b"\xc0\xaf"),
    ("/ in three", b"\xe0\x80\xaf"),
    ("/ in four", b"\xf0\x80\x80\xaf"),
    ("5 bytes", b"\xf8\x88\x80\x80\x80"),
    ("6 bytes", b"\xfc\x84\x80\x80\x80\x80"),
    ("the longest too long of two", b"\xc1\xbf"),
    ("of three", b"\xe0\x9f\xbf"),
    ("of four", b"\xf0\x8f\xbf\xbf"),
    ("nothing in two", b"\xc0\x80"),
    ("beyond the last character", b"\xf4\x90\x80\x80"),
    ("a surrogate", b"\xed\xa0\x80"),
    ("the last one", b"\xed\xbf\xbf"),
    ("a pair of them", b"\xed\xa0\x80\xed\xb0\x80"),
]


def utf8():
    for name, letters in VALID:
        words = b'"' + letters + b'"'
        case("UTF-8", f"valid: {name}")(taken(frame(LAST | TEXT, words)))
        cut = [frame(TEXT if at == 0 else CONTINUED, words[at : at + 1]) for at in range(len(words))]
        case("UTF-8", f"valid, in pieces of a byte: {name}")(taken(b"".join(cut) + frame(LAST | CONTINUED)))
    for name, letters in INVALID:
        words = b'"' + letters + b'"'
        case("UTF-8", f"invalid: {name}")(refused(1007, frame(LAST | TEXT, words)))
        cut = [frame(TEXT if at == 0 else CONTINUED, words[at : at + 1]) for at in range(len(words))]
        case("UTF-8", f"invalid, in pieces of a byte: {name}")(
            refused(1007, b"".join(cut) + frame(LAST | CONTINUED))
        )
    for name, letters in [("two", b"\xc3"), ("three", b"\xe2\x82"), ("four", b"\xf0\x9f\x8c")]:
        case("UTF-8", f"the end within {name} bytes")(refused(1007, frame(LAST | TEXT, b'"' + letters)))
        case("UTF-8", f"the end within {name} bytes, in pieces")(
            refused(1007, frame(TEXT, b'"' + letters) + frame(LAST | CONTINUED))
        )
    case("UTF-8", "told at the piece that is wrong")(refused(1007, frame(TEXT, b'"\xff') + frame(CONTINUED, b"x")))


def closes():
    case("closes", "without a code")(refused((1000, 1005, None), frame(LAST | CLOSE)))
    case("closes", "with half a code")(refused(1002, frame(LAST | CLOSE, b"\x03")))
    for code in (1000, 1001, 1002, 1003, 1007, 1008, 1009, 1010, 1011, 3000, 3999, 4000, 4999):
        case("closes", f"{code} is answered with itself")(
            refused(code, frame(LAST | CLOSE, struct.pack("!H", code)))
        )
    for code in (0, 999, 1004, 1005, 1006, 1015, 1016, 1100, 2000, 2999, 5000, 65535):
        case("closes", f"{code}, which nobody may send")(
            refused(1002, frame(LAST | CLOSE, struct.pack("!H", code)))
        )
    case("closes", "with a sentence")(refused(1000, frame(LAST | CLOSE, b"\x03\xe8Bye.")))
    case("closes", "with one of 123 bytes")(refused(1000, frame(LAST | CLOSE, b"\x03\xe8" + b"x" * 123)))
    case("closes", "with one of 124")(refused(1002, frame(LAST | CLOSE, b"\x03\xe8" + b"x" * 124)))
    case("closes", "with one that is no UTF-8")(refused(1007, frame(LAST | CLOSE, b"\x03\xe8\xff\xfe")))
    case("closes", "byte by byte")(refused(1001, frame(LAST | CLOSE, b"\x03\xe9Bye."), chop=1))
    case("closes", "twice")(refused(1000, 2 * frame(LAST | CLOSE, b"\x03\xe8")))
    case("closes", "before a ping, which is not answered")(
        refused(1000, frame(LAST | CLOSE, b"\x03\xe8") + frame(LAST | PING, b"late"))
    )
    case("closes", "before a text, which is not answered")(
        refused(1000, frame(LAST | CLOSE, b"\x03\xe8") + frame(LAST | TEXT, b'{"type":"ping","nonce":1}'))
    )
    case("closes", "within a text in pieces")(
        refused(1000, frame(TEXT, b"{") + frame(LAST | CLOSE, b"\x03\xe8"))
    )
    case("closes", "before 100 kB of text")(
        refused(1000, frame(LAST | CLOSE, b"\x03\xe8") + frame(LAST | TEXT, b" " * 100_000))
    )


def limits():
    case("limits", "one byte too many, by its head")(
        refused(1009, frame(LAST | TEXT, length=LONGEST + 1))
    )
    case("limits", "the same of a binary")(refused(1009, frame(LAST | BINARY, length=LONGEST + 1)))
    case("limits", "2^62 bytes, by its head")(refused((1002, 1009), frame(LAST | TEXT, length=1 << 62)))
    case("limits", "2^64 - 1 bytes, by its head")(refused((1002, 1009), frame(LAST | TEXT, length=(1 << 64) - 1)))
    case("limits", "pieces that are too long together")(
        refused(1009, frame(TEXT, b" " * LONGEST) + frame(CONTINUED, b" "))
    )
    case("limits", "many pieces of one byte, as long as may be")(
        lambda server: many_pieces(server, 5000),
    )
    case("limits", "too long, and all of it sent")(
        refused(1009, frame(LAST | TEXT, b" " * (LONGEST + 100_000)))
    )


def many_pieces(server, count):
    to = server.socket()
    asked = to.ask()
    frames = [frame(TEXT, asked)] + [frame(CONTINUED, b" ")] * count + [frame(LAST | CONTINUED)]
    to.say(b"".join(frames))
    to.is_answered()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("url", nargs="?", default="http://127.0.0.1:7700", help="a server that nobody needs")
    parser.add_argument("--only", default="", help="cases with this in their group or name")
    parser.add_argument("--verbose", action="store_true", help="a line for each case")
    arguments = parser.parse_args()
    for add in (handshakes, framing, pings, reserved_bits, opcodes, fragmentation, utf8, closes, limits):
        add()
    server = Server(arguments.url)
    sums, wrong = {}, []
    for group, name, test in CASES:
        if arguments.only not in f"{group}: {name}":
            continue
        passed = True
        try:
            test(server)
        except (Wrong, OSError, UnicodeDecodeError) as error:
            passed = False
            wrong.append(f"{group}: {name}: {error}")
        if arguments.verbose:
            print(f"{'ok   ' if passed else 'WRONG'} {group}: {name}", file=sys.stderr)
        cases, good = sums.get(group, (0, 0))
        sums[group] = (cases + 1, good + passed)
    print("| shapes | cases | kept |\n|---|---|---|")
    for group, (cases, good) in sums.items():
        print(f"| {group} | {cases} | {good} |")
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong or not sums else 0


if __name__ == "__main__":
    sys.exit(main())
