#!/usr/bin/env python3
"""Files that are damaged, absent or no meshes.

Usage: test_bad_input.py PROGRAM [unittest arguments]"""
import meshes
import program_test

MEGABYTE = 1 << 20
SANITIZED = b"__asan_init" in program_test.PROGRAM.read_bytes()
# What the program and its libraries take when they do next to nothing; sanitizers keep shadow memory beside it.
SMALL_MEMORY = (1024 if SANITIZED else 150) * MEGABYTE


class BadInput(program_test.ProgramTest):
    def test_every_bad_file_gets_one_clear_line_and_little_memory(self):
        for name, (content, part) in meshes.bad_files().items():
            path = self.folder / name
            path.write_bytes(content)
            for verb in (["bake", name, "-o", "out.ply"], ["info", name]):
                if verb[0] == "info" and name == "points.ply":
                    continue  # a mesh without faces can be looked at
                with self.subTest(f"{verb[0]} {name}"):
                    result = self.run_measured(*verb)
                    self.assertEqual(result.code, 1, result.stderr)
                    self.assert_one_line(result.stderr, f"shbake: {name}: ", part)
                    self.assertLess(result.memory, SMALL_MEMORY)
                    self.assertFalse(self.out.exists())
            path.unlink()

    def test_missing_files_and_folders(self):
        for name in ("missing.obj", ".", "box.obj/inner.obj"):
            with self.subTest(name):
                result = self.run_program("bake", name, "-o", "out.ply")
                self.assertEqual(result.code, 1)
                self.assert_one_line(result.stderr, f"shbake: {name}: ")
        self.assert_left()

    def test_a_bad_blocker_is_named(self):
        (self.folder / "bad.ply").write_bytes(b"")
        result = self.run_program("bake", "box.obj", "-o", "out.ply", "--blockers", "bad.ply")
        self.assertEqual(result.code, 1)
        self.assert_one_line(result.stderr, "shbake: bad.ply: ")
        self.assert_left("bad.ply")

    def test_names_with_control_characters_stay_on_one_line(self):
        result = self.run_program("info", "two\nlines\x1b[31m.obj")
        self.assertEqual(result.code, 1)
        self.assert_one_line(result.stderr, "two?lines?[31m.obj")


if __name__ == "__main__":
    program_test.main()
