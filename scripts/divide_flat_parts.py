#!/usr/bin/env python3
"""Cuts the triangles of an OBJ file into four, again and again, where that changes no shape and no normal.

Usage: divide_flat_parts.py IN.obj OUT.obj TIMES

A part (faces that share vertices) is cut when all its neighbouring faces lie in one plane or meet at a crease of more
than 50 degrees; curved parts stay as they are, since the middle of their edges has no normal of its own. Light changes
over a large flat face faster than its corners tell: this gives it vertices there."""
import math
import sys
from collections import defaultdict


def normal(points, face):
    a, b, c = (points[v] for v in face)
    u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
    n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    length = math.hypot(*n) or 1
    return [x / length for x in n]


def parts_of(vertex_count, faces):
    """A number for each vertex that those of one part share."""
    parent = list(range(vertex_count))

    def root(v):
        while parent[v] != v:
            parent[v] = parent[parent[v]]
            v = parent[v]
        return v

    for a, b, c in faces:
        parent[root(a)] = root(b)
        parent[root(c)] = root(b)
    return [root(v) for v in range(vertex_count)]


def curved_parts(points, faces, part):
    around = defaultdict(list)
    for face in faces:
        n = normal(points, face)
        for a, b in zip(face, face[1:] + face[:1]):
            around[min(a, b), max(a, b)].append(n)
    curved = set()
    for (a, _), normals in around.items():
        for n in normals[1:]:
            cosine = sum(x * y for x, y in zip(n, normals[0]))
            if math.cos(math.radians(50)) <= cosine < math.cos(math.radians(0.5)):
                curved.add(part[a])
    return curved


def divide(points, face, middles):
    def middle(a, b):
        key = min(a, b), max(a, b)
        if key not in middles:
            middles[key] = len(points)
            points.append([(p + q) / 2 for p, q in zip(points[a], points[b])])
        return middles[key]

    a, b, c = face
    ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
    return [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]


def main():
    source, target, times = sys.argv[1], sys.argv[2], int(sys.argv[3])
    points, lines = [], []  # a line is a list of faces, or text to be kept
    for text in open(source):
        words = text.split()
        if words[:1] == ["v"]:
            points.append([float(x) for x in words[1:4]])
        elif words[:1] == ["f"]:
            lines.append([[int(x) - 1 for x in words[1:4]]])
        else:
            lines.append(text)
    faces = [line[0] for line in lines if isinstance(line, list)]
    part = parts_of(len(points), faces)
    curved = curved_parts(points, faces, part)
    for _ in range(times):
        middles = {}
        for i, line in enumerate(lines):
            if isinstance(line, list) and part[line[0][0]] not in curved:
                first = part[line[0][0]]
                lines[i] = [d for face in line for d in divide(points, face, middles)]
                part += [first] * (len(points) - len(part))
    with open(target, "w") as out:
        out.writelines("v %.9g %.9g %.9g\n" % tuple(p) for p in points)
        for line in lines:
            out.writelines(line if isinstance(line, str) else ("f %d %d %d\n" % tuple(v + 1 for v in f) for f in line))


if __name__ == "__main__":
    main()
