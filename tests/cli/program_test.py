"""The shbake program under test: what the tests of its behaviour share. The first argument of a test is the program,
all others are those of unittest."""
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

import meshes

PROGRAM = pathlib.Path(sys.argv[1]).resolve()


def restore_signals():
    """Ctrl-C may be ignored in what runs the tests; the program would inherit that."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


class ProgramTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="shbake-program-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.box = self.folder / "box.obj"
        meshes.write_obj(self.box, *meshes.box_on_floor())
        self.out = self.folder / "out.ply"

    def start(self, *arguments, prepare=None, **options):
        def prepare_child():
            restore_signals()
            if prepare:
                prepare()

        settings = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **options}
        return subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=self.folder, preexec_fn=prepare_child, **settings)

    def run_program(self, *arguments, prepare=None):
        """Runs the program to its end; the result has .code, .stdout and .stderr."""
        process = self.start(*arguments, prepare=prepare)
        out, err = process.communicate(timeout=120)
        result = subprocess.CompletedProcess(arguments, process.returncode, out.decode(), err.decode())
        result.code = process.returncode
        return result

    def run_measured(self, *arguments):
        """As run_program, with the peak memory of this one process as .memory; for programs that print little."""
        process = self.start(*arguments)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        out, err = process.stdout.read().decode(), process.stderr.read().decode()
        process.stdout.close()
        process.stderr.close()
        result = subprocess.CompletedProcess(arguments, process.returncode, out, err)
        result.code, result.memory = process.returncode, usage.ru_maxrss * 1024
        return result

    def bake(self, *arguments, output=None):
        result = self.run_program("bake", self.box, "-o", output or self.out, *arguments)
        self.assertEqual(result.code, 0, result.stderr)
        return result

    def assert_one_line(self, text, *parts):
        """`text` is one line "shbake: ..." that holds `parts`."""
        self.assertRegex(text, r"\Ashbake: [^\n]+\n\Z")
        for part in parts:
            self.assertIn(part, text)

    def assert_left(self, *names):
        """Nothing is in the folder but the box and `names`."""
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), sorted(["box.obj", *names]))


def main():
    unittest.main(argv=sys.argv[:1] + sys.argv[2:], verbosity=1)
