#!/usr/bin/env python3
"""side_by_side.py OUT.png A.png B.png ...: joins 8-bit RGB pictures of one height from left to right."""

import struct
import sys
import zlib
from pathlib import Path

GAP = 4  # white pixels between two pictures


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def unfilter(kind, line, above):
    """Undoes one row's filter (PNG specification, section 9), three bytes per pixel."""
    for i in range(len(line)):
        left, up, corner = (line[i - 3] if i >= 3 else 0), above[i], (above[i - 3] if i >= 3 else 0)
        if kind == 1:
            line[i] = (line[i] + left) & 255
        elif kind == 2:
            line[i] = (line[i] + up) & 255
        elif kind == 3:
            line[i] = (line[i] + (left + up) // 2) & 255
        elif kind == 4:
            guess = left + up - corner
            line[i] = (line[i] + min((left, up, corner), key=lambda c: abs(guess - c))) & 255


def read_rows(path):
    data = Path(path).read_bytes()
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        sys.exit(f"error: {path} is not a PNG")
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, colour, _, _, interlace = struct.unpack(">IIBBBBB", body)
            if (depth, colour, interlace) != (8, 2, 0):
                sys.exit(f"error: {path} is not 8-bit RGB without interlace")
        elif kind == b"IDAT":
            packed += body
        at += size + 12
    raw, stride, rows = zlib.decompress(packed), 3 * width, []
    for y in range(height):
        line = bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        unfilter(raw[y * (stride + 1)], line, rows[-1] if rows else bytes(stride))
        rows.append(line)
    return rows


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    pictures = [read_rows(path) for path in sys.argv[2:]]
    if len({len(rows) for rows in pictures}) != 1:
        sys.exit("error: the pictures differ in height")
    joined = [(b"\xff" * (3 * GAP)).join(bytes(row) for row in rows) for rows in zip(*pictures)]
    header = struct.pack(">IIBBBBB", len(joined[0]) // 3, len(joined), 8, 2, 0, 0, 0)
    filtered = (b"\1" + row[:3] + bytes((b - a) & 255 for a, b in zip(row, row[3:])) for row in joined)  # by the left
    packed = zlib.compress(b"".join(filtered), 9)
    Path(sys.argv[1]).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", packed) + chunk(b"IEND", b""))


main()
