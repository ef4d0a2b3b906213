#!/usr/bin/env python3
"""The verbs relight and render as a user meets them.

Usage: test_view_program.py PROGRAM [unittest arguments]"""
import json
import math
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

import meshes

PROGRAM = pathlib.Path(sys.argv[1]).resolve()


def read_ascii_ply(path):
    """The header's comments and the vertices of an ASCII PLY file, each a dictionary of strings."""
    header, body = path.read_text().split("end_header\n")
    count = int(re.search(r"element vertex (\d+)", header)[1])
    names = re.findall(r"property \w+ (\w+)\n", header.split("element face")[0])
    rows = [dict(zip(names, line.split())) for line in body.splitlines()[:count]]
    return re.findall(r"comment (.*)\n", header), rows


def read_png(path):
    """Width, height and rows of 8-bit RGB bytes."""
    data = path.read_bytes()
    width, height, depth, kind = struct.unpack(">IIBB", data[16:26])
    assert (depth, kind) == (8, 2)
    packed, at = b"", 8
    while at < len(data):
        length, name = struct.unpack(">I4s", data[at:at + 8])
        if name == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += 12 + length
    raw, rows, stride = zlib.decompress(packed), [], 3 * width
    previous = bytes(stride)
    for y in range(height):
        kind, line = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for x in range(stride):
            a, b, c = line[x - 3] if x > 2 else 0, previous[x], previous[x - 3] if x > 2 else 0
            nearest = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
            line[x] = (line[x] + (0, a, b, (a + b) // 2, nearest)[kind]) & 255
        rows.append(bytes(line))
        previous = rows[-1]
    return width, height, rows


class ViewTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="shbake-view-"))
        self.addCleanup(shutil.rmtree, self.folder)
        meshes.write_obj(self.folder / "box.obj", *meshes.box_on_floor())
        self.ok("bake", "box.obj", "-o", "box.ply", "--transfer", "unshadowed", "--albedo", "0.8,0.4,0.2")

    def run_program(self, *arguments):
        return subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, timeout=120)

    def ok(self, *arguments):
        result = self.run_program(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def test_white_light_gives_open_points_their_albedo(self):
        self.ok("relight", "box.ply", "--light", "white", "--colors", "floats", "--ascii", "-o", "lit.ply")
        comments, rows = read_ascii_ply(self.folder / "lit.ply")
        for row in rows:
            for name, albedo in (("red", 0.8), ("green", 0.4), ("blue", 0.2)):
                self.assertAlmostEqual(float(row[name]), albedo, delta=1e-6)
            self.assertIn("sh_r_15", row)
        self.assertIn("relit: red green blue are linear radiance, under white light from everywhere", comments)

    def test_bytes_are_exposed_srgb_and_the_transfer_can_be_left_out(self):
        self.ok("relight", "box.ply", "--light", "white", "--exposure", "0", "--drop-sh", "--ascii", "-o", "lit.ply")
        comments, rows = read_ascii_ply(self.folder / "lit.ply")
        self.assertEqual({(r["red"], r["green"], r["blue"]) for r in rows}, {("231", "170", "124")})
        self.assertFalse([name for name in rows[0] if name.startswith("sh_")])
        self.assertFalse([c for c in comments if c.startswith("shbake ")])

    def test_relighting_leaves_the_transfer_as_it_was(self):
        self.ok("relight", "box.ply", "--light", "clear", "-o", "lit.ply")
        self.ok("relight", "lit.ply", "--light", "overcast", "-o", "again.ply")
        same = json.loads(self.ok("compare", "again.ply", "box.ply", "--json", "-").stdout)
        self.assertEqual(same["difference"]["rms"], 0)

    def test_a_light_file_an_image_and_a_sky_shine_alike(self):
        self.ok("light", "--sky", "clear", "--sun", "30,120", "--order", "4", "-o", "sky.shlight")
        colors = []
        for light in (["sky.shlight"], ["clear", "--sun", "30,120"]):
            self.ok("relight", "box.ply", "--light", *light, "--colors", "floats", "--ascii", "-o", "lit.ply")
            colors.append([row["green"] for row in read_ascii_ply(self.folder / "lit.ply")[1]])
        self.assertEqual(*colors)
        self.ok("render", "--light", "clear", "--sun", "30,120", "--exposure", "0", "--size", "16x256", "--captions",
                "none", "-o", "both.exr")

    def test_ringing_is_told_and_windowed(self):
        sun = ["relight", "box.ply", "--light", "overcast", "--zenith", "0", "--sun", "60,0", "--sun-irradiance", "3"]
        report = json.loads(self.ok(*sun, "-o", "lit.ply", "--json", "-").stdout)
        self.assertLess(report["negative"]["worst"], 0)
        self.assertGreater(report["negative"]["area_share"], 0)
        report = json.loads(self.ok(*sun, "--window", "auto", "-o", "lit.ply", "--json", "-").stdout)
        self.assertGreaterEqual(report["negative"]["worst"], -1e-6)

    def test_pictures_have_the_size_and_colour_asked_for(self):
        # Under white light every face has one radiance: the albedo.
        self.ok("render", "box.ply", "--light", "white", "--exposure", "0", "--view", "top", "--size", "90x60",
                "--background", "0,0,1", "-o", "top.png")
        width, height, rows = read_png(self.folder / "top.png")
        self.assertEqual((width, height), (90, 60))
        self.assertEqual(tuple(rows[30][135:138]), (231, 170, 124))
        self.assertEqual(tuple(rows[1][:3]), (0, 0, 255))

    def test_several_files_stand_side_by_side(self):
        self.ok("render", "box.ply", "box.ply", "-o", "two.png", "--size", "90x60", "--captions", "none")
        width, height, rows = read_png(self.folder / "two.png")
        self.assertEqual((width, height), (181, 60))
        self.assertTrue(all(row[:270] == row[273:] for row in rows))

    def test_a_turntable_is_a_full_turn(self):
        self.ok("render", "box.ply", "--light", "white", "--view", "front", "-o", "turn.png", "--turntable", "4", "--size",
                "64x64")
        frames = sorted(p.name for p in self.folder.glob("turn*"))
        self.assertEqual(frames, [f"turn_{i:04}.png" for i in (1, 2, 3, 4)])
        # The box on its floor looks the same from all four sides.
        pictures = [read_png(self.folder / f)[2] for f in frames]
        for picture in pictures[1:]:
            differing = sum(a != b for ra, rb in zip(picture, pictures[0]) for a, b in zip(ra, rb))
            self.assertLess(differing, 64 * 64 * 3 // 50)
        self.ok("render", "box.ply", "--view", "front", "-o", "light.png", "--turntable", "4", "--turn", "light",
                "--light", "clear", "--size", "64x64")
        self.assertNotEqual(read_png(self.folder / "light_0001.png"), read_png(self.folder / "light_0002.png"))

    def ground_pixel(self, *options):
        """Linear light of a plane of albedo 0.5 below a red box under white light, in front of the middle of its front.
        Seen from above, nearly in parallel: the box covers 0.7 of the picture."""
        vertices, faces = meshes.box_on_floor()
        meshes.write_obj(self.folder / "alone.obj", vertices[4:], [[v - 4 for v in f] for f in faces[1:]])
        self.ok("bake", "alone.obj", "-o", "alone.ply", "--albedo", "0.9,0.1,0.1", *options)
        self.ok("render", "alone.ply", "--light", "white", "--exposure", "0", "--size", "100x100", "--ground-plane",
                "0.5", "--view", "top", "--fov", "1", "-o", "ground.png")
        rows = read_png(self.folder / "ground.png")[2]
        linear = lambda byte: ((byte / 255 + 0.055) / 1.055) ** 2.4
        return [linear(v) for v in rows[91][150:153]]

    def test_a_ground_plane_is_lit_as_its_mesh_was_baked(self):
        # The share of the sky, weighted by the cosine, that the front hides from a point on the ground at a distance c:
        # twice that of half of the front, b wide and a high, from a point below its edge.
        a, b, c = 1, 0.5, 41.5 / 70 - 0.5
        x, y = a / b, c / b
        root = 1 / math.hypot(x, y)
        hidden = 2 / (2 * math.pi) * (math.atan(1 / y) - y * root * math.atan(root))
        # Half a step of 8 bits is 0.003 of light; 512 rays leave a standard error below 1 % of an open point's.
        step, close = 0.003, 0.003 + 3 * 0.01 * 0.5
        for value in self.ground_pixel("--transfer", "unshadowed"):
            self.assertAlmostEqual(value, 0.5, delta=step)
        for value in self.ground_pixel("--transfer", "shadowed"):
            self.assertAlmostEqual(value, 0.5 * (1 - hidden), delta=close)
        # The front sends back what it gets: from the upper half at least, and from all around at most.
        red, green, _ = self.ground_pixel()
        for value, albedo in ((red, 0.9), (green, 0.1)):
            self.assertGreater(value, 0.5 * (1 - hidden + hidden * albedo / 2) - close)
            self.assertLess(value, 0.5 * (1 - hidden + hidden * albedo) + close)
        # Seen from below there is no plane.
        self.ok("render", "alone.ply", "--view", "0,-40", "--ground-plane", "0.5", "--background", "0,0,1", "--size",
                "64x64", "-o", "below.png")
        self.assertEqual(tuple(read_png(self.folder / "below.png")[2][0][:3]), (0, 0, 255))

    def test_the_background_is_the_probe_itself_in_every_layout(self):
        # A cross whose faces have a colour each: right, left, up, down, front, back.
        colors = {(2, 1): (1, 0, 0), (0, 1): (0, 1, 0), (1, 0): (0, 0, 1), (1, 2): (1, 1, 0), (1, 1): (0, 1, 1),
                  (3, 1): (1, 0, 1)}
        pixels = b"".join(struct.pack("<3f", *colors.get((x // 8, 2 - y // 8), (0, 0, 0)))
                          for y in range(24) for x in range(32))
        (self.folder / "cross.pfm").write_bytes(b"PF\n32 24\n-1.0\n" + pixels)
        # Looking along +x one sees the front, along +y the left; with mirrored maps what is on the other side.
        cases = [("270,0", (), (0, 255, 255)), ("180,0", (), (0, 255, 0)), ("0,0", (), (255, 0, 0)),
                 ("90,0", (), (255, 0, 255)), ("0,-90", (), (0, 0, 255)), ("0,90", (), (255, 255, 0)),
                 ("180,0", ("--mirror",), (255, 0, 0)), ("270,0", ("--rotate", "90"), (255, 0, 0)),
                 ("270,0", ("--up", "y"), (0, 255, 255)), ("0,-90", ("--up", "y"), (0, 0, 255)),
                 ("270,0", ("--layout", "cross-horizontal", "--rotate", "180"), (255, 0, 255))]
        for view, options, color in cases:
            with self.subTest(view=view, options=options):
                self.ok("render", "box.ply", "--light", "cross.pfm", "--background", "light", "--exposure", "0", "--view",
                        view, "--fov", "60", "--size", "24x24", *options, "-o", "b.png")
                self.assertEqual(tuple(read_png(self.folder / "b.png")[2][0][:3]), color)

    def test_a_rig_lights_each_vertex_from_where_it_is(self):
        for name, value in (("low", "1"), ("high", "3,2,1")):
            self.ok("light", "--constant", value, "-o", name + ".shlight")
        self.ok("light", "--sample", "0,0,0,low.shlight", "--sample", "0,0,2,high.shlight", "--blend", "barycentric",
                "-o", "rig.shlight")
        self.ok("relight", "box.ply", "--light", "rig.shlight", "--colors", "floats", "--ascii", "-o", "lit.ply")
        comments, rows = read_ascii_ply(self.folder / "lit.ply")
        self.assertTrue(any("under rig.shlight (2 local lights, barycentric)" in c for c in comments))
        for row in rows:
            share = float(row["z"]) / 2  # of the upper sample: half way up at the top of the box
            for name, expected in (("red", 0.8 * (1 + 2 * share)), ("green", 0.4 * (1 + share)), ("blue", 0.2)):
                self.assertAlmostEqual(float(row[name]), expected, delta=1e-5)
        # Turned about the origin and stated with y up, the same rig lights the same way.
        self.ok("light", "--sample", "0,0,0,low.shlight", "--sample", "0,2,0,high.shlight", "--up", "y", "--blend",
                "barycentric", "--rotate", "70", "-o", "up.shlight")
        self.ok("relight", "box.ply", "--light", "up.shlight", "--colors", "floats", "--ascii", "-o", "up.ply")
        for a, b in zip(rows, read_ascii_ply(self.folder / "up.ply")[1]):
            self.assertAlmostEqual(float(a["red"]), float(b["red"]), delta=1e-5)
        self.ok("render", "box.ply", "--light", "rig.shlight", "--size", "64x64", "--background", "light", "-o", "a.png",
                "--turntable", "2", "--turn", "light")
        self.ok("render", "rig.shlight", "--size", "64x64", "--exposure", "0", "--captions", "none", "-o", "rig.png")
        width, height, pixels = read_png(self.folder / "rig.png")
        self.assertEqual((width, height), (257, 64))
        self.assertEqual(tuple(pixels[30][:3]), (255, 255, 255))
        result = self.run_program("sh", "rig.shlight")
        self.assertEqual(result.returncode, 1)
        self.assertIn("samples", result.stderr)

    def test_output_does_not_depend_on_threads(self):
        for verb, out in (("render", "a.png"), ("render", "a.exr"), ("relight", "a.ply")):
            seen = set()
            for threads in (1, 3):
                self.ok(verb, "box.ply", "--light", "clear", "-o", out, "--threads", threads)
                seen.add((self.folder / out).read_bytes())
            self.assertEqual(len(seen), 1, out)

    def test_wrong_usage_is_told_in_one_line(self):
        self.ok("render", "-o", "probe.png", "--size", "64x32")
        cases = [
            (["relight"], 2, "no baked file"),
            (["relight", "box.ply"], 2, "no output"),
            (["relight", "box.ply", "-o", "box.ply"], 2, "--force"),
            (["relight", "box.obj", "-o", "lit.ply"], 1, "box.obj"),
            (["relight", "box.ply", "--light", "missing.exr", "-o", "lit.ply"], 1, "missing.exr"),
            (["relight", "box.ply", "--zenith", "-1", "-o", "lit.ply"], 2, "--zenith"),
            (["render", "box.ply"], 2, "no output"),
            (["render", "box.ply", "--light", "probe.png", "-o", "probe.png"], 2, "--force"),
            (["render", "box.ply", "-o", "a.gif"], 2, ".png or .exr"),
            (["render", "box.ply", "-o", "a.png", "--view", "frnt"], 2, "front"),
            (["render", "box.ply", "-o", "a.png", "--size", "64"], 2, "WIDTHxHEIGHT"),
            (["render", "box.ply", "-o", "a.png", "--view", "0,95"], 2, "elevation"),
            (["render", "box.ply", "-o", "a.png", "--captions", "a,b"], 2, "captions"),
            (["render", "-o", "a.png", "--turntable", "3"], 2, "--turntable"),
            (["render", "-o", "a.png", "--ground-plane", "0.5"], 2, "--ground-plane"),
            (["render", "box.ply", "-o", "a.png", "--ground-plane", "2"], 2, "--ground-plane"),
            (["light", "--sample", "0,0,low.shlight", "-o", "a.shlight"], 2, "--sample"),
        ]
        for arguments, code, part in cases:
            with self.subTest(" ".join(arguments)):
                result = self.run_program(*arguments)
                self.assertEqual(result.returncode, code, result.stderr)
                self.assertRegex(result.stderr, r"\Ashbake: [^\n]+\n\Z")
                self.assertIn(part, result.stderr)
                self.assertFalse(list(self.folder.glob("a.*")) + list(self.folder.glob("lit*")))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:], verbosity=1)
