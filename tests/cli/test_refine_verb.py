#!/usr/bin/env python3
"""The verb refine as a user meets it: what it writes and tells, and what it refuses.

Usage: test_refine_verb.py PROGRAM SCENES [unittest arguments]"""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
SCENES = pathlib.Path(sys.argv[2]).resolve()


class RefineVerb(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="shbake-refine-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.room = SCENES / "room.obj"
        self.out = self.folder / "out.ply"

    def run_program(self, *arguments):
        return subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, timeout=120)

    def report(self, *arguments):
        result = self.run_program(*arguments, "--json", "-")
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def refused(self, code, *arguments, says=()):
        result = self.run_program("refine", *arguments)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        self.assertRegex(result.stderr, r"\Ashbake: [^\n]+\n\Z")
        for part in says:
            self.assertIn(part, result.stderr)
        self.assertFalse(self.out.exists())

    def test_a_room_gets_vertices_and_keeps_its_area(self):
        told = self.report("refine", self.room, "-o", self.out, "--length", 0.1)
        self.assertEqual(told["regions"], {"refined": told["regions"]["found"], "left": 0,
                                           "found": told["regions"]["found"]})
        self.assertGreater(told["vertices"]["after"], 3 * told["vertices"]["before"])
        self.assertAlmostEqual(told["area"]["after"] / told["area"]["before"], 1, delta=1e-6)
        # What is written is what was told, as closed as it was, and can be baked.
        before, after = (self.report("info", f)["mesh"] for f in (self.room, self.out))
        self.assertEqual(after["vertices"], told["vertices"]["after"])
        self.assertEqual(after["triangles"], told["faces"]["after"])
        self.assertEqual((after["parts"], after["box"]), (before["parts"], before["box"]))
        self.assertEqual(self.run_program("bake", self.out, "-o", "baked.ply", "--rays", 16).returncode, 0)

    def differences(self, *options):
        """The report on `bake` of what `refine` wrote against `bake --refine`, with the same options for both."""
        refined, steps, once = self.folder / "refined.ply", self.folder / "steps.ply", self.folder / "once.ply"
        shape = ("--crease", 40, "--flat", 2)
        self.report("refine", self.room, "-o", refined, "--length", 0.1, *shape)
        self.report("bake", refined, "-o", steps, *shape[:2], *options)
        told = self.report("bake", self.room, "-o", once, "--refine", 0.1, *shape, *options)
        before, after = (self.report("info", f)["mesh"] for f in (refined, once))
        self.assertEqual(after["triangles"], before["triangles"])
        self.assertGreater(told["output"]["vertices"], told["input"]["vertices"])
        compared = self.report("compare", steps, once)
        self.assertEqual(compared["vertices"], {"only_in_a": 0, "only_in_b": 0, "black": 0,
                                                "compared": told["output"]["vertices"]})
        return compared

    def test_bake_refines_as_refine_does(self):
        # What refine writes is rounded to float: 6e-8 of a coordinate, over edges of 0.05 and more, turns normals by 3e-6,
        # and no coefficient of 4 bands changes by more than 3 times that.
        compared = self.differences("--transfer", "unshadowed")
        self.assertLess(compared["difference"]["worst"], 1e-5)
        # The rays are the same, but for a few that this moves across an edge. Other rays would differ by their errors
        # added in squares, which are sqrt(2) times the stated one.
        compared = self.differences("--transfer", "shadowed", "--rays", 64, "--fit", "vertex")
        self.assertLess(compared["difference"]["rms"], min(compared["stated"]["rms_a"], compared["stated"]["rms_b"]))

    def test_the_bytes_do_not_depend_on_threads(self):
        files = []
        for threads in (1, 2):
            files.append(self.folder / f"{threads}.ply")
            self.report("refine", self.room, "-o", files[-1], "--length", 0.08, "--threads", threads)
        self.assertEqual(files[0].read_bytes(), files[1].read_bytes())

    def test_what_is_refused(self):
        self.refused(2, "-o", self.out, "--length", 1, says=["no mesh is named"])
        self.refused(2, self.room, "--length", 1, says=["no output is named"])
        self.refused(2, self.room, "-o", self.out, says=["no length is given"])
        self.refused(2, self.room, "-o", "out.obj", "--length", 1, says=["'.obj' is not a format"])
        self.refused(2, self.room, "-o", self.out, "--length", 0, says=["--length"])
        self.refused(2, self.room, "-o", self.out, "--length", 1, "--flat", 60, says=["--flat"])
        copy = self.folder / "copy.ply"
        self.report("refine", self.room, "-o", copy, "--length", 1)
        content = copy.read_bytes()
        self.refused(2, copy, "-o", copy, "--length", 0.1, says=["would replace"])
        self.assertEqual(copy.read_bytes(), content)

    def test_too_many_vertices_are_refused_with_a_length_that_fits(self):
        result = self.run_program("refine", self.room, "-o", self.out, "--length", 0.001, "--max-vertices", 5000)
        self.assertEqual(result.returncode, 1)
        self.assertFalse(self.out.exists())
        self.assertIn("a length of ", result.stderr)
        length = result.stderr.split("a length of ")[1].split()[0]
        told = self.report("refine", self.room, "-o", self.out, "--length", length, "--max-vertices", 5000)
        self.assertLessEqual(told["vertices"]["after"], 5000)

    def test_a_baked_file_is_refused(self):
        baked = self.folder / "baked.ply"
        self.assertEqual(self.run_program("bake", self.room, "-o", baked, "--rays", 16).returncode, 0)
        self.refused(1, baked, "-o", self.out, "--length", 0.1, says=["is baked", "refine the mesh"])


if __name__ == "__main__":
    del sys.argv[1:3]
    unittest.main()
