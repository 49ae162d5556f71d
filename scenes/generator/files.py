"""Writers of the few file formats that the scenes need.

Everything is written uncompressed: the bytes then depend on the numbers alone, not on a version of zlib, and a
test can demand the very same files again.
"""

import struct
import zlib


def write_png(path, width, height, pixel):
    """8-bit RGB; pixel(x, y) gives three floats in [0, 1], already sRGB-encoded."""
    raw = bytearray()
    for y in range(height):
        raw.append(0)  # no row filter
        for x in range(width):
            raw.extend(min(255, max(0, int(c * 255 + 0.5))) for c in pixel(x, y))
    stored = bytearray(b"\x78\x01")  # zlib stream of stored blocks
    for start in range(0, len(raw), 65535):
        block = raw[start:start + 65535]
        last = start + 65535 >= len(raw)
        stored += struct.pack("<BHH", last, len(block), len(block) ^ 0xFFFF) + block
    stored += struct.pack(">I", zlib.adler32(bytes(raw)))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", bytes(stored)) + chunk(b"IEND", b""))


def write_exr(path, width, height, pixel):
    """Half-float RGB OpenEXR, one scanline per block; pixel(x, y) gives three linear floats."""
    def attribute(name, kind, data):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<I", len(data)) + data

    channels = b"".join(name + b"\0" + struct.pack("<iIii", 1, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    header = struct.pack("<II", 20000630, 2)
    header += attribute("channels", "chlist", channels)
    header += attribute("compression", "compression", b"\0")
    header += attribute("dataWindow", "box2i", window)
    header += attribute("displayWindow", "box2i", window)
    header += attribute("lineOrder", "lineOrder", b"\0")
    header += attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    header += attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0))
    header += attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0"
    line_bytes = 6 * width
    first = len(header) + 8 * height
    offsets = b"".join(struct.pack("<Q", first + y * (8 + line_bytes)) for y in range(height))
    body = bytearray()
    for y in range(height):
        row = [pixel(x, y) for x in range(width)]
        body += struct.pack("<ii", y, line_bytes)
        for c in (2, 1, 0):
            body += struct.pack(f"<{width}e", *(p[c] for p in row))
    path.write_bytes(header + offsets + bytes(body))


def write_ply(path, mesh):
    """Binary little-endian PLY of a Mesh: triangles, or quads (p00 p10 p11 p01) that pbrt reads as bilinear patches."""
    header = "ply\nformat binary_little_endian 1.0\n"
    header += f"element vertex {len(mesh.positions)}\n"
    header += "".join(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz", "u", "v"))
    header += f"element face {len(mesh.faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    body = bytearray(header.encode())
    for position, normal, uv in zip(mesh.positions, mesh.normals(), mesh.uvs):
        body += struct.pack("<8f", *position, *normal, *uv)
    for face in mesh.faces:
        body += struct.pack(f"<B{len(face)}i", len(face), *face)
    path.write_bytes(bytes(body))
