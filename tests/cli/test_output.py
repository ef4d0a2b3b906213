#!/usr/bin/env python3
"""Output that is whole or absent, and the same in every run.

Usage: test_output.py PROGRAM [unittest arguments]"""
import os
import resource
import subprocess
import unittest

import meshes
import program_test


class Output(program_test.ProgramTest):
    def test_unwritable_outputs_fail_before_the_mesh_is_even_read(self):
        (self.folder / "sub").mkdir()
        cases = {"nowhere/out.ply": "create its folder", "sub": "is a folder", "box.obj/out.ply": "Not a directory"}
        for output, part in cases.items():
            with self.subTest(output):
                result = self.run_program("bake", "missing.obj", "-o", output)
                self.assertEqual(result.code, 1)
                self.assert_one_line(result.stderr, f"shbake: {output}: ", part)
                result = self.run_program("bake", "missing.obj", "-o", "out.ply", "--json", output)
                self.assertEqual(result.code, 1)
                self.assert_one_line(result.stderr, f"shbake: {output}: ", part)
        self.assert_left("sub")

    def test_a_full_disk_is_told(self):
        self.out.symlink_to("/dev/full")
        result = self.run_program("bake", "box.obj", "-o", "out.ply")
        self.assertEqual(result.code, 1)
        self.assert_one_line(result.stderr, "shbake: out.ply: ", "No space left", "free some space")
        self.assertTrue(self.out.is_symlink())

    @unittest.skipUnless(os.geteuid() == 0, "mounting a small file system takes root")
    def test_a_disk_that_fills_up_is_left_as_it_was(self):
        small = self.folder / "small"
        small.mkdir()
        script = ('mount -t tmpfs -o size=16k none "$1" || exit 77; echo old >"$1/out.ply"; "$2" bake box.obj -o '
                  '"$1/out.ply" --order 8 --albedo 0.9,0.5,0.2 --rays 16; code=$?; ls "$1" >&2; cat "$1/out.ply" >&2; exit $code')
        result = subprocess.run(["unshare", "-m", "sh", "-c", script, "sh", small, program_test.PROGRAM],
                                cwd=self.folder, text=True, capture_output=True, timeout=60)
        if result.returncode == 77 or "unshare failed" in result.stderr:
            self.skipTest("this container may not mount")
        self.assertEqual(result.returncode, 1)
        message, listing = result.stderr.split("\n", 1)
        self.assert_one_line(message + "\n", "out.ply: ", "No space left")
        self.assertEqual(listing, "out.ply\nold\n")

    def test_a_limit_on_file_sizes_is_told_and_the_old_file_stays(self):
        self.out.write_text("old")
        result = self.run_program("bake", "box.obj", "-o", "out.ply", "--order", "8", "--rays", "16",
                                  prepare=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096)))
        self.assertEqual(result.code, 1)
        self.assert_one_line(result.stderr, "shbake: out.ply: ", "ulimit -f")
        self.assertEqual(self.out.read_text(), "old")
        self.assert_left("out.ply")

    def test_the_input_is_not_replaced_without_force(self):
        self.bake()
        before = self.out.read_bytes()
        for output in ("out.ply", "./out.ply"):
            result = self.run_program("bake", "out.ply", "-o", output)
            self.assertEqual(result.code, 2)
            self.assert_one_line(result.stderr, "--force")
        result = self.run_program("bake", "box.obj", "--blockers", "out.ply", "-o", "out.ply")
        self.assertEqual(result.code, 2)
        self.assertEqual(self.out.read_bytes(), before)
        result = self.run_program("bake", "out.ply", "-o", "out.ply", "--force", "--order", "2")
        self.assertEqual(result.code, 0, result.stderr)
        self.assertNotEqual(self.out.read_bytes(), before)

    def test_a_pipe_gets_the_same_bytes_as_a_file(self):
        self.bake("-q")
        result = self.start("bake", "box.obj", "-o", "/dev/stdout", "-q")
        out, err = result.communicate(timeout=60)
        self.assertEqual((result.returncode, err), (0, b""))
        self.assertEqual(out, self.out.read_bytes())

    def test_output_depends_on_neither_threads_nor_the_run(self):
        mesh = self.folder / "bowl.obj"
        meshes.write_obj(mesh, *meshes.bowl(20, 40))
        for options in ([], ["--transfer", "shadowed"], ["--bounces", "3"], ["--ascii", "--albedo", "0.9,0.5,0.2"]):
            results = []
            for threads in (1, 2, 3, 2):
                result = self.run_program("bake", mesh, "-o", self.out, "--rays", "64", "--threads", threads, *options)
                self.assertEqual(result.code, 0, result.stderr)
                results.append(self.out.read_bytes())
            with self.subTest(options=options):
                self.assertTrue(all(r == results[0] for r in results))

    def test_another_seed_is_another_sample(self):
        self.bake("--rays", "64", "--seed", "1")
        one = self.out.read_bytes()
        self.bake("--rays", "64", "--seed", "2")
        self.assertNotEqual(one, self.out.read_bytes())


if __name__ == "__main__":
    program_test.main()
