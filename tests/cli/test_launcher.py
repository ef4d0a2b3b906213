#!/usr/bin/env python3
"""./shbake itself: what it installs, when it builds, what it says. Runs a copy of the script in a made-up project where
apt-get, cmake and ninja are stand-ins that note how they were called."""
import os
import pathlib
import pty
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
# The tools that the scripts may count on in any Debian system (packages marked essential, and bash itself).
ESSENTIAL = ["bash", "cat", "comm", "dirname", "env", "find", "flock", "grep", "mkdir", "mv", "paste", "readlink", "rm",
             "sed", "sort", "tail", "touch", "chmod", "cp"]
PROGRAM = '#!/usr/bin/env bash\nprintf "%s|" program "$PWD" "$@"\n'


class Launcher(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="shbake-launcher-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.project = self.folder / "my project"  # a blank in the path must not matter
        for name in ("core", "stability", "chart", "cli", "tests/support", "cmake", "scripts"):
            (self.project / name).mkdir(parents=True)
        for name in ("shbake", "scripts/setup.sh", "CMakeLists.txt", "CMakePresets.json"):
            shutil.copy(ROOT / name, self.project / name)
        (self.project / "packages.txt").write_text("# needed\ng++\ncmake # builds\n\ncatch2\n")
        (self.project / "core/a.cpp").write_text("int a;\n")
        self.bin = self.folder / "bin"
        self.bin.mkdir()
        for tool in ESSENTIAL:
            os.symlink(shutil.which(tool), self.bin / tool)
        self.calls = self.folder / "calls"
        self.calls.write_text("")
        self.installed = self.folder / "installed"
        self.installed.write_text("g++\ncmake\ncatch2\n")
        self.stub("id", "echo 0")
        self.stub("dpkg-query", f"while read -r p; do echo \"$p installed\"; done <'{self.installed}'")
        self.stub("apt-get", f"for a in \"$@\"; do case $a in g++|cmake|catch2) echo $a >>'{self.installed}';; esac; done")
        self.stub("cmake", "mkdir -p build/release; echo configured")
        (self.folder / "program").write_text(PROGRAM)
        self.stub("ninja", f"echo '[1/2] step'; mkdir -p \"$2/cli\"; cp '{self.folder}/program' \"$2/cli/shbake\"; "
                           "chmod +x \"$2/cli/shbake\"")

    def stub(self, name, script):
        path = self.bin / name
        path.write_text(f"#!/usr/bin/env bash\nprintf '%s\\n' \"{name} $*\" >>'{self.calls}'\n{script}\n")
        path.chmod(0o755)

    def called(self, *tools):
        """The calls of `tools` so far, which are then forgotten."""
        lines = self.calls.read_text().splitlines()
        self.calls.write_text("")
        return [line for line in lines if line.split()[0] in tools]

    def run_script(self, *arguments, script=None, cwd=None):
        return subprocess.run([script or self.project / "shbake", *arguments], cwd=cwd or self.folder, text=True,
                              env={"PATH": str(self.bin), "HOME": "/nowhere"}, stdin=subprocess.DEVNULL,
                              capture_output=True, timeout=60)

    def run_on_terminal(self, answer):
        """Runs the script with stdin and stderr on a terminal where `answer` is typed; returns exit code and text."""
        ours, theirs = pty.openpty()
        process = subprocess.Popen([self.project / "shbake"], cwd=self.folder, stdin=theirs, stderr=theirs,
                                   stdout=subprocess.DEVNULL, env={"PATH": str(self.bin)})
        os.close(theirs)
        os.write(ours, answer.encode())
        text = b""
        while True:
            try:
                chunk = os.read(ours, 4096)
            except OSError:  # the other end is closed
                break
            if not chunk:
                break
            text += chunk
        os.close(ours)
        return process.wait(timeout=60), text.decode()

    def age_sources(self):
        """Makes all sources older than the stamp, whatever the clock's resolution."""
        past = time.time() - 10
        for path in [self.project, *self.project.rglob("*")]:
            if "build" not in path.relative_to(self.project).parts:
                os.utime(path, (past, past))

    def test_first_start_builds_and_hands_arguments_on(self):
        result = self.run_script("bake", "a b.obj", "-o", "*.ply")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout, f"program|{self.folder}|bake|a b.obj|-o|*.ply|")
        self.assertIn("build/release.log", result.stderr)
        self.assertEqual(len(self.called("cmake")), 1)

    def test_second_start_calls_no_tools_and_says_nothing(self):
        self.age_sources()
        self.run_script()
        self.called()
        result = self.run_script("info")
        self.assertEqual(result.stdout, f"program|{self.folder}|info|")
        self.assertEqual(result.stderr, "")
        self.assertEqual(self.called("cmake", "ninja", "dpkg-query", "apt-get"), [])

    def test_every_kind_of_change_is_noticed(self):
        def touch():
            os.utime(self.project / "core/a.cpp")

        changes = {"edited": touch, "added": lambda: (self.project / "cli/b.cpp").write_text(""),
                   "selftest": lambda: (self.project / "stability/c.cpp").write_text(""),
                   "chart": lambda: (self.project / "chart/d.cpp").write_text(""),
                   "removed": lambda: (self.project / "core/a.cpp").unlink(),
                   "packages": lambda: os.utime(self.project / "packages.txt"),
                   "program": lambda: (self.project / "build/release/cli/shbake").unlink()}
        self.run_script()
        for name, change in changes.items():
            with self.subTest(name):
                self.age_sources()
                self.called()
                self.run_script()
                self.assertEqual(self.called("ninja"), [])
                time.sleep(0.02)  # file times are stamped by a clock that ticks every few milliseconds
                change()
                self.run_script()
                self.assertEqual(len(self.called("ninja")), 1)

    def test_works_through_a_link_and_from_anywhere(self):
        link = self.folder / "link"
        os.symlink(self.project / "shbake", link)
        elsewhere = self.folder / "elsewhere"
        elsewhere.mkdir()
        result = self.run_script("x", script=link, cwd=elsewhere)
        self.assertEqual(result.stdout, f"program|{elsewhere}|x|")
        self.assertEqual(list(elsewhere.iterdir()), [])

    def test_missing_packages_are_named_then_installed(self):
        self.installed.write_text("cmake\n")
        result = self.run_script()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("needs these Debian packages: catch2 g++\n", result.stderr)
        apt = self.called("apt-get")
        self.assertEqual(len(apt), 2)
        self.assertIn("update", apt[0])
        self.assertTrue(apt[1].endswith("install -y --no-install-recommends catch2 g++"), apt[1])

    def test_users_go_through_sudo(self):
        self.installed.write_text("cmake\n")
        self.stub("id", "echo 1000")
        self.stub("sudo", 'exec "$@"')
        self.assertEqual(self.run_script().returncode, 0)
        self.assertEqual(len(self.called("sudo")), 2)

    def test_without_root_and_sudo_it_says_what_to_run(self):
        self.installed.write_text("cmake\n")
        self.stub("id", "echo 1000")
        result = self.run_script()
        self.assertEqual(result.returncode, 1)
        self.assertIn("as root, run: apt-get install --no-install-recommends catch2 g++\n", result.stderr)
        self.assertEqual(self.called("apt-get", "cmake"), [])

    def test_on_other_systems_it_says_what_is_needed(self):
        (self.bin / "apt-get").unlink()
        result = self.run_script()
        self.assertEqual(result.returncode, 1)
        self.assertIn("not Debian", result.stderr)
        self.assertIn("g++ cmake catch2\n", result.stderr)
        self.assertEqual(self.called("cmake"), [])

    def test_failed_installation_shows_the_log(self):
        self.installed.write_text("cmake\n")
        self.stub("apt-get", "echo 'E: no such package' >&2; exit 100")
        result = self.run_script()
        self.assertEqual(result.returncode, 1)
        self.assertIn("E: no such package", result.stderr)
        self.assertIn(str(self.project / "build/packages.log"), result.stderr)

    def test_failed_builds_show_the_log_and_are_tried_again(self):
        good = (self.bin / "ninja").read_text()
        self.stub("ninja", "echo '[1/2] step'; echo 'a.cpp:1: error: no semicolon'; exit 1")
        result = self.run_script()
        self.assertEqual(result.returncode, 1)
        self.assertIn("a.cpp:1: error: no semicolon", result.stderr)
        self.assertIn("building failed; the whole log is " + str(self.project / "build/release.log"), result.stderr)
        self.assertEqual(result.stdout, "")
        (self.bin / "ninja").write_text(good)
        self.assertEqual(self.run_script().returncode, 0)

    def test_failed_configuring_shows_the_log(self):
        self.stub("cmake", "echo 'CMake Error: no generator'; exit 1")
        result = self.run_script()
        self.assertEqual(result.returncode, 1)
        self.assertIn("CMake Error: no generator", result.stderr)
        self.assertIn("configuring failed", result.stderr)

    def test_a_moved_project_starts_its_build_afresh(self):
        self.run_script()
        cache = self.project / "build/release/CMakeCache.txt"
        cache.write_text("CMAKE_HOME_DIRECTORY:INTERNAL=/somewhere/else\n")
        os.utime(self.project / "core/a.cpp", (time.time() + 5, time.time() + 5))
        self.assertEqual(self.run_script().returncode, 0)
        self.assertFalse(cache.exists())

    def test_two_first_starts_at_once_build_once(self):
        self.age_sources()
        slow = (self.bin / "ninja").read_text().replace("echo '[1/2] step'", "read -r -t 0.5 <> <(:) || true")
        (self.bin / "ninja").write_text(slow)
        environment = {"PATH": str(self.bin)}
        both = [subprocess.Popen([self.project / "shbake"], env=environment, stdin=subprocess.DEVNULL,
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE) for _ in range(2)]
        for process in both:
            self.assertIn(b"program|", process.communicate(timeout=60)[0])
        self.assertEqual(len(self.called("ninja")), 1)

    def test_on_a_terminal_it_asks_once(self):
        self.installed.write_text("cmake\n")
        code, text = self.run_on_terminal("n\n")
        self.assertEqual(code, 1)
        self.assertEqual(text.count("[Y/n]"), 1)
        self.assertIn("apt-get install --no-install-recommends catch2 g++", text)
        self.assertEqual(self.called("apt-get"), [])
        code, text = self.run_on_terminal("\n")
        self.assertEqual(code, 0, text)
        self.assertEqual(len(self.called("apt-get")), 2)

    def test_nothing_is_written_outside_the_build_folder(self):
        before = sorted(p for p in self.project.rglob("*"))
        self.run_script()
        after = sorted(p for p in self.project.rglob("*") if "build" not in p.relative_to(self.project).parts)
        self.assertEqual(before, after)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
