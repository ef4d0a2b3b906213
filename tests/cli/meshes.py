"""Small meshes for tests of the program, good and bad, written by hand."""
import math
import struct


def write_obj(path, vertices, faces):
    lines = ["v %r %r %r" % tuple(v) for v in vertices] + ["f " + " ".join(str(i + 1) for i in f) for f in faces]
    path.write_text("\n".join(lines) + "\n")


def box_on_floor():
    """A unit box standing on a floor of side 4: shadows, reflections and a crease."""
    vertices = [(x, y, 0.0) for y in (-2, 2) for x in (-2, 2)]
    vertices += [(x, y, z) for z in (0.0, 1.0) for y in (-0.5, 0.5) for x in (-0.5, 0.5)]
    faces = [(0, 1, 3, 2), (8, 9, 11, 10), (4, 5, 9, 8), (5, 7, 11, 9), (7, 6, 10, 11), (6, 4, 8, 10)]
    return vertices, faces


def bowl(rings, segments):
    """The lower half of a unit sphere, open at the top: light goes to and fro inside."""
    vertices, faces = [], []
    for i in range(rings + 1):
        theta = math.pi - 0.5 * math.pi * i / rings
        for j in range(segments):
            phi = 2 * math.pi * j / segments
            vertices.append((math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta)))
    for i in range(rings):
        for j in range(segments):
            a, b = i * segments + j, i * segments + (j + 1) % segments
            faces.append((a, a + segments, b + segments, b))
    return vertices, faces


def ply_header(vertices, faces, form="binary_little_endian"):
    return (f"ply\nformat {form} 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\n"
            f"element face {faces}\nproperty list uchar int vertex_indices\nend_header\n").encode()


def binary_ply(vertices, faces):
    return (ply_header(len(vertices), len(faces)) + b"".join(struct.pack("<3f", *v) for v in vertices) +
            b"".join(struct.pack(f"<B{len(f)}i", len(f), *f) for f in faces))


def bad_files():
    """Names of bad files, their bytes, and a word that the complaint about each must hold."""
    good = binary_ply(*box_on_floor())
    ascii_face = b"0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
    return {
        "empty.ply": (b"", "empty"),
        "empty.obj": (b"", "empty"),
        "cut.ply": (good[:-20], "ends"),
        "cut_header.ply": (good[:60], "header"),
        "billions.ply": (ply_header(4_000_000_000, 4_000_000_000) + b"\0" * 1000, ""),
        "billions_text.ply": (ply_header(4_000_000_000, 1, "ascii") + ascii_face, ""),
        "nan.ply": (ply_header(3, 1, "ascii") + ascii_face.replace(b"1 0 0", b"nan 0 0"), "vertex 1"),
        "infinite.obj": (b"v 0 0 0\nv 1e999 0 0\nv 0 1 0\nf 1 2 3\n", "line 2"),
        "index.ply": (ply_header(3, 1, "ascii") + ascii_face.replace(b"3 0 1 2", b"3 0 1 7"), "face 0"),
        "negative.ply": (ply_header(3, 1, "ascii") + ascii_face.replace(b"3 0 1 2", b"3 0 1 -2"), "face 0"),
        "index.obj": (b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "9"),
        "points.ply": (ply_header(3, 0, "ascii") + b"0 0 0\n1 0 0\n0 1 0\n", "face"),
        "noise.ply": (bytes((i * 7919) % 256 for i in range(4096)), ""),
        "picture.obj": (b"\x89PNG\r\n\x1a\n" + b"\0" * 200, ""),
        "text.ply": (b"once upon a time\n", ""),
    }
