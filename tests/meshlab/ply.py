"""As much of PLY and OBJ as the tests need."""
import struct

TYPES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f", "double": "d"}


def write_mesh(path, vertices, faces, normals=None, colors=None):
    """A binary file of triangles with float positions, as MeshLab and shbake read it alike."""
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(vertices)}"]
    header += [f"property float {c}" for c in "xyz"]
    rows = [struct.pack("<3f", *v) for v in vertices]
    if normals:
        header += [f"property float n{c}" for c in "xyz"]
        rows = [row + struct.pack("<3f", *n) for row, n in zip(rows, normals, strict=True)]
    if colors:
        header += [f"property uchar {c}" for c in ("red", "green", "blue")]
        rows = [row + bytes(c) for row, c in zip(rows, colors, strict=True)]
    header += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header\n"]
    rows += [struct.pack("<B3i", 3, *f) for f in faces]
    path.write_bytes("\n".join(header).encode() + b"".join(rows))


def read_columns(path):
    """The scalar properties of the vertices of a binary file, each as a list."""
    data = path.read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    names, row, count, element = [], "<", 0, ""
    for line in data[:end].decode().splitlines():
        words = line.split()
        if words[0] == "element":
            element = words[1]
            count = int(words[2]) if element == "vertex" else count
        elif words[0] == "property" and element == "vertex":
            names.append(words[2])
            row += TYPES[words[1]]
    rows = struct.iter_unpack(row, data[end:end + count * struct.calcsize(row)])
    return dict(zip(names, map(list, zip(*rows)), strict=True))


def read_faces(path):
    """The triangles of a binary file whose faces have nothing before their list of vertices."""
    data = path.read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    formats, counts, element = {"vertex": "<", "face": "<B3i"}, {}, ""
    for line in data[:end].decode().splitlines():
        words = line.split()
        if words[0] == "element":
            element = words[1]
            counts[element] = int(words[2])
        elif words[0] == "property" and words[1] != "list":
            formats[element] += TYPES[words[1]]
    start = end + counts["vertex"] * struct.calcsize(formats["vertex"])
    rows = data[start:start + counts["face"] * struct.calcsize(formats["face"])]
    return [row[1:4] for row in struct.iter_unpack(formats["face"], rows)]


def read_obj(path):
    """Positions and triangles of an OBJ file; polygons become fans."""
    vertices, faces = [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append(tuple(map(float, words[1:4])))
        elif words[:1] == ["f"]:
            corners = [int(w.split("/")[0]) - 1 for w in words[1:]]
            faces += [(corners[0], corners[i], corners[i + 1]) for i in range(1, len(corners) - 1)]
    return vertices, faces
