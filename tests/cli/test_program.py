#!/usr/bin/env python3
"""The shbake program as a user meets it: exit codes, messages, output that is whole or absent, Ctrl-C, determinism.

Usage: test_program.py PROGRAM [unittest arguments]"""
import json
import os
import pathlib
import pty
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import meshes

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
SANITIZED = b"__asan_init" in PROGRAM.read_bytes()
MEGABYTE = 1 << 20
# What the program and its libraries take when they do next to nothing; sanitizers keep shadow memory beside it.
SMALL_MEMORY = (1024 if SANITIZED else 150) * MEGABYTE


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


class Usage(ProgramTest):
    def test_wrong_usage_ends_with_2_and_one_line(self):
        cases = [
            (["bkae"], "unknown verb bkae", "did you mean bake?"),
            (["--frobnicate"], "unknown option --frobnicate"),
            (["bake"], "no mesh"),
            (["bake", "box.obj"], "no output"),
            (["bake", "box.obj", "-o", "out.ply", "--ordre", "3"], "--ordre", "did you mean --order?"),
            (["bake", "box.obj", "-o", "out.ply", "--order=99"], "--order: 99 is out of range"),
            (["bake", "box.obj", "-o", "out.ply", "--order", "0"], "--order: 0 is out of range"),
            (["bake", "box.obj", "-o", "out.ply", "--order", "four"], "'four' is not a whole number"),
            (["bake", "box.obj", "-o", "out.ply", "--order"], "--order needs a value"),
            (["bake", "box.obj", "-o", "out.ply", "--rays", "-5"], "--rays: -5 is out of range"),
            (["bake", "box.obj", "-o", "out.ply", "--rays", "1e9"], "'1e9' is not a whole number"),
            (["bake", "box.obj", "-o", "out.ply", "--tolerance", "0"], "--tolerance: 0 is out of range"),
            (["bake", "box.obj", "-o", "out.ply", "--bounces", "some"], "'some' is not a whole number"),
            (["bake", "box.obj", "-o", "out.ply", "--albedo", "2"], "--albedo: 2 is out of range"),
            (["bake", "box.obj", "-o", "out.ply", "--albedo", "red"], "'red' is not a colour"),
            (["bake", "box.obj", "-o", "out.ply", "--normals", "flt"], "did you mean flat?"),
            (["bake", "box.obj", "-o", "out.ply", "--memory", "lots"], "'lots' is not a size"),
            (["bake", "box.obj", "-o", "out.ply", "--max-distance", "0"], "--max-distance: 0 is out of range"),
            (["bake", "box.obj", "-o", "out.ply", "--threads", "-1"], "--threads: -1 is out of range"),
            (["bake", "box.obj", "-o", "out.ply", "--seed", "-1"], "--seed: -1 is out of range"),
            (["bake", "box.obj", "-o", "out.ply", "-q", "-v"], "contradict"),
            (["bake", "box.obj", "more.obj", "-o", "out.ply"], "'more.obj' is one argument too many"),
            (["bake", "--blockers", "box.obj", "-o", "out.ply"], "no mesh", "before --blockers"),
            (["bake", "box.obj", "-o", "out.obj"], "out.obj", ".ply"),
            (["bake", "box.obj", "-o", ""], "no output"),
            (["info"], "no file"),
            (["compare", "a.ply"], "two files"),
            (["bake", "-o", "out.ply", "--surface-error", "box.obj"], "'box.obj' is not a number of samples",
             "before the option"),
            (["bake", "box.obj", "-o", "out.ply", "--surface-error", "7"], "--surface-error: 7 is out of range"),
            (["compare", "a.ply", "b.ply", "--surface"], "one file", "usage: shbake compare A --surface"),
            (["compare", "--surface", "a.ply"], "'a.ply' is not a number of samples"),
        ]
        for arguments, *parts in cases:
            with self.subTest(" ".join(arguments)):
                result = self.run_program(*arguments)
                self.assertEqual(result.code, 2, result.stderr)
                self.assert_one_line(result.stderr, *parts)
                self.assertEqual(result.stdout, "")
        self.assert_left()

    def test_no_arguments_print_the_help_as_an_error(self):
        result = self.run_program()
        self.assertEqual((result.code, result.stdout), (2, ""))
        self.assertIn("Usage: shbake VERB", result.stderr)

    def test_help_and_version_go_to_stdout(self):
        self.assertRegex(self.run_program("--version").stdout, r"\Ashbake \d+\.\d+\.\d+\n\Z")
        result = self.run_program("--help")
        self.assertEqual((result.code, result.stderr), (0, ""))
        self.assertEqual(result.stdout, self.run_program("-h").stdout)

    def test_help_of_every_verb_tells_defaults_and_fits_80_columns(self):
        verbs = re.findall(r"^  (\w+)  +\w", self.run_program("--help").stdout, re.M)
        self.assertIn("bake", verbs)
        # What these name or add is absent unless they are given.
        without_default = {"--help", "--output", "--json", "--blockers", "--disc", "--parallel", "--constant",
                           "--gradient", "--sample", "--turn", "--shadow", "--multiply", "--at", "--length", "--family"}
        for verb in verbs:
            with self.subTest(verb):
                result = self.run_program(verb, "--help")
                self.assertEqual((result.code, result.stderr), (0, ""))
                self.assertLessEqual(max(map(len, result.stdout.splitlines())), 80)
                options = re.split(r"\n(?=  -)", result.stdout.split("\nOptions:\n")[1])
                self.assertGreater(len(options), 4)
                for option in options:
                    name = re.search(r"--[a-z-]+", option)[0]
                    if name not in without_default:
                        self.assertIn("(default:", " ".join(option.split()), name)


class BadInput(ProgramTest):
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


class Output(ProgramTest):
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
        result = subprocess.run(["unshare", "-m", "sh", "-c", script, "sh", small, PROGRAM], cwd=self.folder, text=True,
                                capture_output=True, timeout=60)
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


class Reports(ProgramTest):
    def test_json_holds_what_the_text_says(self):
        result = self.bake("--json", "report.json")
        report = json.loads((self.folder / "report.json").read_text())
        self.assertEqual(report["verb"], "bake")
        self.assertEqual(report["input"]["vertices"], 12)
        self.assertEqual(report["output"]["bytes"], self.out.stat().st_size)
        self.assertGreater(report["error"]["rms"], 0)
        self.assertGreaterEqual(report["error"]["max"], report["error"]["rms"])
        self.assertIn("points", result.stdout)
        self.assertEqual(result.stderr, "")  # a short work shows no progress where there is no terminal

    def test_json_on_stdout_is_alone_there(self):
        for arguments in (["bake", "box.obj", "-o", "out.ply"], ["info", "box.obj"], ["info", "out.ply"],
                          ["compare", "out.ply", "out.ply"]):
            with self.subTest(arguments[0]):
                result = self.run_program(*arguments, "--json", "-")
                self.assertEqual(result.code, 0, result.stderr)
                self.assertEqual(json.loads(result.stdout)["verb"], arguments[0])

    def test_quiet_is_silent_and_verbose_tells_stages(self):
        result = self.bake("-q")
        self.assertEqual((result.stdout, result.stderr), ("", ""))
        result = self.bake("-v")
        self.assertRegex(result.stderr, r"shbake: tracing: [\d,]+ rays in [\d.]+ s")

    def test_options_without_effect_are_warned_of(self):
        result = self.bake("--transfer", "unshadowed", "--rays", "64", "--bounces", "3", "--json", "report.json")
        for option in ("--rays", "--bounces"):
            self.assertIn(f"shbake: warning: {option} has no effect with --transfer unshadowed\n", result.stderr)
        self.assertEqual(len(json.loads((self.folder / "report.json").read_text())["warnings"]), 2)

    def test_a_full_stdout_is_an_error(self):
        with open("/dev/full", "w") as full:
            process = self.start("info", "box.obj", stdout=full)
            _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 1)
        self.assert_one_line(err.decode(), "standard output: cannot be written")

    def test_the_bar_goes_to_a_terminal_and_is_erased(self):
        mesh = self.folder / "bowl.obj"
        meshes.write_obj(mesh, *meshes.bowl(40, 60))
        ours, theirs = pty.openpty()
        process = self.start("bake", mesh, "-o", self.out, "--rays", "8192", "--threads", "1", stderr=theirs)
        os.close(theirs)
        text = b""
        try:
            while chunk := os.read(ours, 4096):
                text += chunk
        except OSError:  # the other end is closed
            os.close(ours)
        out, _ = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 0)
        self.assertIn(b"tracing  [#", text)
        self.assertTrue(text.endswith(b"\r\x1b[K"), text[-80:])
        self.assertIn(b"points", out)

    def test_info_and_compare_agree_with_the_bake(self):
        self.bake("--order", "3", "--albedo", "0.9,0.5,0.2", "--json", "bake.json")
        baked = json.loads((self.folder / "bake.json").read_text())
        info = json.loads(self.run_program("info", "out.ply", "--json", "-").stdout)
        self.assertEqual(info["transfer"]["order"], 3)
        self.assertEqual(info["transfer"]["channels"], 3)
        self.assertEqual(info["mesh"]["vertices"], baked["output"]["vertices"])
        self.bake("--order", "3", "--albedo", "0.9,0.5,0.2", "--ascii", output=self.folder / "text.ply")
        same = json.loads(self.run_program("compare", "out.ply", "text.ply", "--json", "-").stdout)
        self.assertEqual(same["difference"]["rms"], 0)
        self.bake("--order", "3", "--albedo", "0.9,0.5,0.2", "--seed", "2", output=self.folder / "other.ply")
        other = json.loads(self.run_program("compare", "out.ply", "other.ply", "--json", "-").stdout)
        self.assertGreater(other["difference"]["rms"], 0)

    def test_the_fit_is_told(self):
        options = ("--rays", 64, "--seed", 3)
        files = {kind: self.folder / f"{kind}.ply" for kind in ("vertex", "surface", "auto")}
        told = {kind: json.loads(self.bake("--fit", kind, *options, "--json", "-", output=file).stdout)
                for kind, file in files.items()}
        self.assertNotIn("fit", told["vertex"])
        self.assertNotIn(b" fit=", files["vertex"].read_bytes())
        self.assertEqual(told["surface"]["fit"]["reason"], "asked for")
        self.assertEqual(told["surface"]["fit"]["smoothed_points"], 0)
        self.assertGreater(told["surface"]["fit"]["points"], 0)
        self.assertLess(told["surface"]["fit"]["error_after"], told["surface"]["fit"]["error_before"])
        self.assertIn(b" fit=surface", files["surface"].read_bytes())
        # What was chosen, and that it is what was written.
        self.assertIn("samples show", told["auto"]["fit"]["reason"])
        self.assertEqual(told["auto"]["choices"]["fit"]["reason"], told["auto"]["fit"]["reason"])
        self.assertIn(b" fit=" + told["auto"]["choices"]["fit"]["value"].encode(), files["auto"].read_bytes())

    def test_the_surface_error_is_told_by_bake_info_and_compare(self):
        self.bake("--rays", "64", "--surface-error", "200", "--json", "bake.json")
        baked = json.loads((self.folder / "bake.json").read_text())["surface"]
        self.assertEqual(baked["samples"], 200)
        self.assertLess(baked["low"], baked["rms"])
        self.assertLess(baked["rms"], baked["high"])
        self.assertLess(baked["high"], baked["worst"])
        self.assertIn(b"comment shbake surface_samples=200 ", self.out.read_bytes())
        info = self.run_program("info", "out.ply", "--json", "-").stdout
        self.assertEqual(json.loads(info)["surface"], baked)
        self.assertIn("RMS between the vertices", self.run_program("info", "out.ply").stdout)
        compared = self.run_program("compare", "out.ply", "--surface=200", "--json", "-").stdout
        self.assertEqual(json.loads(compared)["surface"], baked)
        bare = self.run_program("compare", "out.ply", "--surface")
        self.assertIn("of 1,024 samples", bare.stdout, bare.stderr)
        self.bake("--rays", "64")
        self.assertNotIn(b"surface_", self.out.read_bytes())


class Stopping(ProgramTest):
    def setUp(self):
        super().setUp()
        self.bowl = self.folder / "bowl.obj"
        meshes.write_obj(self.bowl, *meshes.bowl(60, 120))
        self.out.write_text("old")
        self.endless = ["bake", self.bowl, "-o", self.out, "--rays", "1048576"]

    def stop(self, process, *signals, after):
        """Sends signals 20 ms apart and returns how long the program took to end from the first on."""
        time.sleep(after)
        self.assertIsNone(process.poll(), "the work was over before it could be stopped")
        begin = time.monotonic()
        for number in signals:
            process.send_signal(number)
            time.sleep(0.02)
        process.wait(timeout=30)
        return time.monotonic() - begin

    def assert_stopped(self, process, code):
        out, err = process.communicate()
        self.assertEqual(process.returncode, code)
        self.assertEqual(out, b"")
        self.assertTrue(err.endswith(b"shbake: stopped\n"), err)
        self.assertEqual(err.count(b"stopped"), 1)
        self.assertEqual(self.out.read_text(), "old")
        self.assert_left("bowl.obj", "out.ply")

    def test_ctrl_c_ends_the_work_within_a_fifth_of_a_second(self):
        taken = []
        for after in (0.01, 0.1, 0.5, 1.0):  # starting, reading, tracing
            process = self.start(*self.endless)
            if after < 0.05:
                time.sleep(0.05)  # until the signals are waited for
            taken.append(self.stop(process, signal.SIGINT, after=after))
            self.assert_stopped(process, 130)
        # The machine may be busy with other tests: all must be quick, and the best shows what the program needs.
        self.assertLess(min(taken), 0.2)
        self.assertLess(max(taken), 2)

    def test_a_second_ctrl_c_ends_it_too(self):
        process = self.start(*self.endless)
        self.stop(process, signal.SIGINT, signal.SIGINT, after=0.5)
        self.assert_stopped(process, 130)

    def test_a_request_to_terminate_is_heeded_like_ctrl_c(self):
        process = self.start(*self.endless)
        self.stop(process, signal.SIGTERM, after=0.5)
        self.assert_stopped(process, 143)

    def test_a_stop_while_the_file_is_written_leaves_the_old_one(self):
        os.mkfifo(self.folder / "pipe")
        # Nobody reads the pipe: writing to it, as to a disk that hangs, cannot report progress.
        (self.folder / "link.ply").symlink_to("pipe")
        process = self.start("bake", "box.obj", "-o", "link.ply", "--rays", "16")
        taken = self.stop(process, signal.SIGINT, after=1.0)
        self.assertEqual(process.returncode, 130)
        self.assertTrue(process.stderr.read().endswith(b"shbake: stopped\n"))
        self.assertLess(taken, 2)
        process.communicate()

    def test_an_ignored_ctrl_c_stays_ignored(self):
        def ignore():
            signal.signal(signal.SIGINT, signal.SIG_IGN)

        process = self.start(*self.endless, prepare=ignore)
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        time.sleep(0.4)
        self.assertIsNone(process.poll())
        self.stop(process, signal.SIGTERM, after=0)
        self.assert_stopped(process, 143)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:], verbosity=1)
