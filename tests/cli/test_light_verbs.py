#!/usr/bin/env python3
"""The verbs light and sh as a user meets them: files made, values told, messages and exit codes.

Usage: test_light_verbs.py PROGRAM [unittest arguments]"""
import json
import math
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(sys.argv[1]).resolve()


def write_radiance(path, width, height, pixel):
    """A Radiance HDR file without run-length coding; pixel(x, y) gives one of the powers of two, 0 or a triple of them."""
    rows = bytearray(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width))
    for y in range(height):
        for x in range(width):
            value = pixel(x, y)
            exponent = 0 if value == 0 else round(math.log2(value)) + 129
            rows += struct.pack("4B", *([128 if value else 0] * 3), exponent)
    path.write_bytes(rows)


class LightVerbs(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="shbake-light-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.out = self.folder / "out.shlight"

    def run_program(self, *arguments):
        return subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, timeout=120)

    def done(self, *arguments):
        result = self.run_program(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def report(self, *arguments):
        return json.loads(self.done(*arguments, "--json", "-").stdout)

    def refused(self, code, *arguments, says=()):
        result = self.run_program(*arguments)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        self.assertRegex(result.stderr, r"\Ashbake: [^\n]+\n\Z")
        for part in says:
            self.assertIn(part, result.stderr)
        self.assertFalse(self.out.exists())

    def assert_close(self, found, expected, tolerance=1e-9):
        self.assertEqual(len(found), len(expected))
        for f, e in zip(found, expected):
            self.assertAlmostEqual(f, e, delta=tolerance)

    def test_a_constant_probe_is_constant_light(self):
        write_radiance(self.folder / "grey.hdr", 16, 8, lambda x, y: 0.5)
        report = self.report("light", "grey.hdr", "-o", self.out, "--order", 3)
        self.assert_close(report["radiance"]["mean"], [0.5] * 3, 1e-12)
        file = json.loads(self.out.read_text())
        self.assertEqual([file["shbake_light"], file["order"], file["axes"]], [1, 3, "z-up"])
        self.assertEqual(len(file["radiance"]), 9)
        self.assertEqual(file["sources"], ["grey.hdr: lat-long 16x8"])

    def test_a_sun_lies_where_the_map_and_its_options_put_it(self):
        # One bright pixel above and right of the centre: azimuth between 0 and -y.
        write_radiance(self.folder / "sun.hdr", 32, 16, lambda x, y: 1024 if (x, y) == (20, 5) else 0)
        phi, theta = math.pi * (1 - 2 * 20.5 / 32), math.pi * 5.5 / 16
        x, y, z = math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta)
        cases = {(): (x, y, z), ("--rotate", "90"): (-y, x, z), ("--rotate", "-90"): (y, -x, z),
                 ("--mirror",): (x, -y, z), ("--up", "y"): (x, z, -y), ("--turn", "1,0,0,90"): (x, -z, y)}
        for options, expected in cases.items():
            with self.subTest(options=options):
                report = self.report("light", "sun.hdr", "-o", self.out, *options)
                # The mean direction of a pixel differs from its centre by less than its height squared.
                self.assert_close(report["direction"], expected, 0.01)

    def test_sums_have_weights_and_exposure(self):
        self.done("light", "--constant", 1, "-o", "one.shlight")
        report = self.report("light", "one.shlight@0.5", "one.shlight@1,2,3", "--constant", "0,0,1", "--exposure", -1,
                             "-o", self.out)
        self.assert_close(report["radiance"]["mean"], [0.75, 1.25, 2.25])

    def test_a_light_file_of_other_axes_is_turned(self):
        # What lies along +z, up, where z is up lies along +y where y is.
        self.done("light", "--disc", "0.6,0,0.8,20,1", "-o", "z.shlight")
        report = self.report("light", "z.shlight", "--up", "y", "-o", "y.shlight")
        self.assert_close(report["direction"], [0.6, 0.8, 0])
        self.assertEqual(json.loads((self.folder / "y.shlight").read_text())["axes"], "y-up")
        self.assert_close(self.report("light", "y.shlight", "-o", self.out)["direction"], [0.6, 0, 0.8])

    def test_skies_and_discs(self):
        report = self.report("light", "--sky", "overcast", "-o", self.out)
        told = self.report("sh", self.out, "--order", 2, "--at", "0,0,1")
        # Irradiance by two bands, A_0 L_00 y_00 + A_1 L_10 y_10, from the integrals of (1 + 2z) / 3 and z (1 + 2z) / 3.
        mean, first = 2 * math.pi * (1 / 3 + 1 / 3) / (4 * math.pi), 2 * math.pi * (1 / 6 + 2 / 9)
        self.assert_close(report["radiance"]["mean"], [mean] * 3)
        self.assert_close(told["at"][0]["irradiance"], [math.pi * mean + 2 * math.pi / 3 * 3 / (4 * math.pi) * first] * 3)
        report = self.report("light", "--disc", "0,3,4,60,2", "-o", self.out)
        self.assert_close(report["direction"], [0, 0.6, 0.8])
        self.assertAlmostEqual(report["r1_over_r0"], 0.75)
        self.done("light", "--parallel", "0,0,1,3,2,1", "-o", self.out)
        self.assert_close(self.report("sh", self.out, "--at", "0,0,1")["at"][0]["irradiance"], [3, 2, 1])

    def test_shadows_and_windows(self):
        report = self.report("light", "--constant", 1, "--shadow", "0,0,1,90", "-o", self.out)
        self.assert_close(report["radiance"]["mean"], [0.5] * 3)
        self.assertLess(report["radiance"]["min"], 0)
        report = self.report("light", "--constant", 1, "--shadow", "0,0,1,90", "--window", "auto", "-o", self.out)
        self.assertGreaterEqual(report["radiance"]["min"], -1e-9)
        self.assertGreater(report["window"]["lambda"], 0)

    def test_coefficient_lists_and_conventions(self):
        (self.folder / "list.txt").write_text("# an order of 2\n1, 0.5\n0.25 -0.125\n")
        self.assertEqual(self.report("sh", "list.txt", "--print")["coefficients"],
                         [v for v in (1, 0.5, 0.25, -0.125) for _ in range(3)])
        flipped = self.report("sh", "list.txt", "--from", "condon-shortley", "--print")["coefficients"]
        self.assertEqual(flipped[::3], [1, -0.5, 0.25, 0.125])
        geodesy = self.report("sh", "list.txt", "--to", "geodesy", "--print")["coefficients"]
        self.assert_close(geodesy[::3], [v / math.sqrt(4 * math.pi) for v in (1, 0.5, 0.25, -0.125)])
        turned = self.report("sh", "list.txt", "--turn", "0,0,1,90", "--print")["coefficients"]
        self.assert_close(turned[::3], [1, -0.125, 0.25, -0.5])
        self.assertEqual(self.report("sh", "list.txt", "--mirror", "z", "--print")["coefficients"][::3],
                         [1, 0.5, -0.25, -0.125])

    def test_hazels_form_goes_both_ways(self):
        # Radiance 2 + x: mean 2, mean of R d = (1/3, 0, 0). Its irradiance over pi at +x is R0 + 2 R1 = 2 + 2/3.
        (self.folder / "grey.txt").write_text("2  0.3333333333333333 0 0  0 0 0 0 0 0\n")
        told = self.report("sh", "grey.txt", "--from", "hazel", "--at", "1,0,0", "--at", "0,-1,0", "-o", self.out)
        self.assert_close(told["at"][0]["radiance"], [3] * 3)
        self.assert_close(told["at"][1]["radiance"], [2] * 3)
        self.assert_close(told["at"][0]["irradiance"], [math.pi * (2 + 2 / 3)] * 3)
        # Three channels of which each points another way: radiance 1 + 3 R1.d + 15/2 d.R2 d.
        rows = [[1, 0, 0.1, 0, 0.02, -0.03, 0.01, 0, 0, 0], [1, 0, 0, 0.2, 0, 0, 0, 0.04, 0, 0],
                [1, 0.3, 0, 0, 0, 0, 0, 0, 0.05, -0.06]]
        (self.folder / "rgb.txt").write_text("\n".join(" ".join(map(str, row)) for row in rows))
        for d in ((1, 0, 0), (0, 1, 0), (0, 0, 1), (0.6, 0.8, 0), (0, 0.6, -0.8), (-0.8, 0, 0.6)):
            told = self.report("sh", "rgb.txt", "--from", "hazel", "--at", ",".join(map(str, d)))
            x, y, z = d
            expected = [r[0] + 3 * (r[1] * x + r[2] * y + r[3] * z) + 7.5 * (r[4] * x * x + r[5] * y * y + r[6] * z * z +
                        2 * (r[7] * x * y + r[8] * x * z + r[9] * y * z)) for r in rows]
            self.assert_close(told["at"][0]["radiance"], expected)
        back = self.report("sh", "rgb.txt", "--from", "hazel", "--print", "--to", "hazel")["hazel"]
        for name, row in zip(("red", "green", "blue"), rows):
            self.assert_close(back[name], row)
        (self.folder / "trace.txt").write_text("1 0 0 0 0.1 0 0 0 0 0")
        result = self.run_program("sh", "trace.txt", "--from", "hazel")
        self.assertEqual(result.returncode, 1)
        self.assertIn("R2", result.stderr)

    def test_axes_are_read_and_written(self):
        # Radiance 1 + z + x / 2 where z points up, and the same scene where y does: 1 + y + x / 2.
        norm = math.sqrt(4 * math.pi)
        c0, c1 = norm, norm / math.sqrt(3)
        (self.folder / "z.txt").write_text(f"{c0!r} 0 {c1!r} {c1 / 2!r}")
        (self.folder / "y.txt").write_text(f"{c0!r} {c1!r} 0 {c1 / 2!r}")
        for source, options in (("y.txt", ["--from-up", "y", "--to-up", "z"]), ("z.txt", ["--to-up", "z"]),
                                ("z.txt", [])):
            told = self.report("sh", source, *options, "--at", "0,0,1", "--at", "1,0,0", "--at", "0,1,0")
            self.assert_close([at["radiance"][0] for at in told["at"]], [2, 1.5, 1])
        told = self.report("sh", "z.txt", "--to-up", "y", "--at", "0,1,0", "--at", "0,0,1", "-o", self.out)
        self.assert_close([at["radiance"][0] for at in told["at"]], [2, 1])
        self.assertEqual(json.loads(self.out.read_text())["axes"], "y-up")
        told = self.report("sh", self.out, "--to-up", "z", "--print")
        self.assert_close(told["coefficients"][::3], [c0, 0, c1, c1 / 2])
        # A factor in other axes is turned to those of the first file: (1 + z)^2 at the top is 4 of 1 + z there.
        square = self.report("sh", "z.txt", "--multiply", self.out, "--order", 3, "--at", "0,0,1")
        self.assert_close(square["at"][0]["radiance"], [4] * 3)
        self.assertEqual(self.run_program("sh", self.out, "--from-up", "y").returncode, 2)

    def test_products_are_of_functions(self):
        y00 = 1 / math.sqrt(4 * math.pi)
        (self.folder / "z.txt").write_text("0 0 1 0")
        square = self.report("sh", "z.txt", "--multiply", "z.txt", "--order", 3, "--print")["coefficients"][::3]
        # (sqrt(3) y00 z)^2 = 3 y00^2 z^2, z^2 = (1 + 2 P_2) / 3.
        self.assert_close(square, [y00, 0, 0, 0, 0, 0, 2 * y00 / math.sqrt(5), 0, 0])

    def test_bad_pixels_are_told(self):
        header = b"PF\n4 2\n-1.0\n"
        pixels = [1.0] * 24
        pixels[5] = math.nan
        (self.folder / "bad.pfm").write_bytes(header + struct.pack("<24f", *pixels))
        result = self.run_program("light", "bad.pfm", "-o", self.out)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("warning: bad.pfm: 1 pixels are not a number", result.stderr)

    def test_wrong_usage(self):
        self.refused(2, "light", "-o", self.out, says=["nothing to make light from"])
        self.refused(2, "light", "--constant", 1, says=["no output is named"])
        self.refused(2, "light", "--constant", 1, "-o", "out.json", says=["out.json", ".shlight"])
        self.refused(2, "light", "--constant", "red", "-o", self.out, says=["--constant", "red"])
        self.refused(2, "light", "--disc", "0,0,1,10", "-o", self.out, says=["--disc"])
        self.refused(2, "light", "--disc", "0,0,0,10,1", "-o", self.out, says=["direction"])
        self.refused(2, "light", "--sky", "cloudy", "-o", self.out, says=["--sky", "partly-cloudy"])
        self.refused(2, "light", "--sky", "clear", "--sun", "95,0", "-o", self.out, says=["altitude"])
        self.refused(2, "light", "--constant", 1, "--order", 99, "-o", self.out, says=["--order", "64"])
        self.refused(2, "sh", says=["no file is named"])

    def test_bad_files(self):
        write_radiance(self.folder / "odd.hdr", 10, 7, lambda x, y: 1)
        self.refused(1, "light", "odd.hdr", "-o", self.out, says=["odd.hdr", "10x7", "name the layout"])
        self.refused(1, "light", "none.hdr", "-o", self.out, says=["none.hdr", "no such file"])
        (self.folder / "bad.shlight").write_text('{"shbake_light": 1, "gain": 2}')
        self.refused(1, "sh", "bad.shlight", says=["bad.shlight", '"gain"'])
        (self.folder / "five.txt").write_text("1 2 3 4 5")
        self.refused(1, "sh", "five.txt", says=["five.txt", "5 numbers"])
        (self.folder / "word.txt").write_text("1 2\n3 four")
        self.refused(1, "sh", "word.txt", says=["word.txt: line 2", "four"])

    def test_the_output_does_not_replace_an_input_unasked(self):
        self.done("light", "--constant", 1, "-o", "a.shlight")
        before = (self.folder / "a.shlight").read_bytes()
        result = self.run_program("light", "a.shlight@2", "-o", "a.shlight")
        self.assertEqual(result.returncode, 2)
        self.assertEqual((self.folder / "a.shlight").read_bytes(), before)
        self.refused(2, "sh", "a.shlight", "--mirror", "z", "-o", "a.shlight", says=["--force"])
        self.assertEqual((self.folder / "a.shlight").read_bytes(), before)
        self.done("light", "a.shlight@2", "-o", "a.shlight", "--force")
        self.assertNotEqual((self.folder / "a.shlight").read_bytes(), before)

    def test_threads_change_no_byte(self):
        write_radiance(self.folder / "map.hdr", 64, 32, lambda x, y: 2.0 ** ((x * 7 + y * 13) % 5))
        texts = set()
        for threads in (1, 2, 4):
            self.done("light", "map.hdr", "-o", self.out, "--threads", threads)
            texts.add(self.out.read_bytes())
        self.assertEqual(len(texts), 1)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
