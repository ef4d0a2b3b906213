#!/usr/bin/env python3
"""An installed program works, and goes on working when its folder is moved.

Usage: test_install.py CMAKE BUILD_FOLDER [unittest arguments]"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

CMAKE, BUILD = sys.argv[1:3]


class InstallTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="shbake-install-"))
        self.addCleanup(shutil.rmtree, self.folder)
        subprocess.run([CMAKE, "--install", BUILD, "--component", "program", "--prefix", self.folder / "first"], check=True,
                       stdout=subprocess.DEVNULL)
        self.prefix = self.folder / "moved" / "deeper"
        self.prefix.parent.mkdir()
        (self.folder / "first").rename(self.prefix)

    def run_program(self, *arguments, program=None):
        """Runs the program in another folder; its messages, and the modules that the loader opened for it."""
        environment = dict(os.environ, LD_DEBUG="files", LD_DEBUG_OUTPUT=str(self.folder / "loader"))
        result = subprocess.run([program or self.prefix / "bin/shbake", *arguments], cwd=self.folder, env=environment,
                                capture_output=True, text=True, timeout=120)
        self.assertEqual(result.returncode, 0, result.stderr)
        opened = set()
        for log in self.folder.glob("loader*"):
            opened |= set(re.findall(r"file=(\S+libshbake_\w+\.so)", log.read_text(errors="replace")))
            log.unlink()
        return opened

    def test_a_moved_program_loads_its_own_modules(self):
        opened = self.run_program("render", "--light", "clear", "--size", "64x32", "--exposure", "0", "--captions", "none",
                                  "-o", "light.exr")
        self.assertEqual({os.path.dirname(p) for p in opened}, {str(next(self.prefix.glob("lib*/**/shbake")))})
        opened = self.run_program("light", "light.exr", "--layout", "lat-long", "-o", "a.shlight")
        self.assertEqual({os.path.dirname(p) for p in opened}, {str(next(self.prefix.glob("lib*/**/shbake")))})

    def test_modules_beside_the_program_are_found_first_also_through_links(self):
        beside = self.folder / "beside"
        beside.mkdir()
        for part in [self.prefix / "bin/shbake", *self.prefix.glob("lib*/**/*.so")]:
            shutil.copy2(part, beside)
        (self.folder / "link").symlink_to(beside / "shbake")
        opened = self.run_program("render", "--light", "white", "--size", "64x32", "-o", "a.png",
                                  program=self.folder / "link")
        self.assertEqual({os.path.dirname(p) for p in opened}, {str(beside)})

    def test_nothing_but_the_program_its_modules_and_words_is_installed(self):
        files = sorted(str(p.relative_to(self.prefix)) for p in self.prefix.rglob("*") if p.is_file())
        kinds = [r"bin/shbake", r"lib.*/shbake/libshbake_map_file\.so", r"lib.*/shbake/libshbake_picture\.so",
                 r"share/doc/shbake/(CHANGELOG\.md|LICENSE|README\.md|docs/.*)"]
        for name in files:
            self.assertTrue(any(re.fullmatch(kind, name) for kind in kinds), name)
        for kind in kinds:
            self.assertTrue(any(re.fullmatch(kind, name) for name in files), kind)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
