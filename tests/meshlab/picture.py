"""Pictures of a screen: what Xvfb draws, as pixels and as PNG files."""
import operator
import struct
import zlib


class Picture:
    """Rows of red, green, blue bytes."""

    def __init__(self, width, height, pixels):
        self.width, self.height, self.pixels = width, height, pixels

    @classmethod
    def of_screen(cls, path):
        """Reads the file that Xvfb keeps its screen in: the format of xwd, 32 bits a pixel."""
        data = path.read_bytes()
        header = struct.unpack(">25I", data[:100])
        size, width, height, order, bits, line, colors = (header[i] for i in (0, 4, 5, 7, 11, 12, 19))
        if bits != 32 or order != 0:
            raise ValueError(f"a screen of {bits} bits a pixel in byte order {order} is not what was asked for")
        start = size + 12 * colors
        pixels = bytearray(3 * width * height)
        for y in range(height):
            row = data[start + y * line:start + y * line + 4 * width]
            to = slice(3 * width * y, 3 * width * (y + 1))
            out = bytearray(3 * width)
            out[0::3], out[1::3], out[2::3] = row[2::4], row[1::4], row[0::4]
            pixels[to] = out
        return cls(width, height, bytes(pixels))

    def part(self, x, y, width, height):
        rows = [self.pixels[3 * ((y + i) * self.width + x):3 * ((y + i) * self.width + x + width)] for i in range(height)]
        return Picture(width, height, b"".join(rows))

    def mean(self):
        """The mean of red, green and blue."""
        return tuple(sum(self.pixels[c::3]) / (self.width * self.height) for c in range(3))

    def difference(self, other):
        """The mean absolute difference of all bytes."""
        if len(self.pixels) != len(other.pixels):
            raise ValueError("pictures of different sizes")
        # Mostly nothing has changed; a loop in Python would take a good part of the time of a test.
        if self.pixels == other.pixels:
            return 0.0
        return sum(map(abs, map(operator.sub, self.pixels, other.pixels))) / len(self.pixels)

    def write_png(self, path):
        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

        rows = b"".join(b"\0" + self.pixels[3 * self.width * y:3 * self.width * (y + 1)] for y in range(self.height))
        path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", self.width, self.height, 8, 2, 0, 0, 0)) +
                         chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))
