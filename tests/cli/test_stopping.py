#!/usr/bin/env python3
"""Ctrl-C and requests to terminate.

Usage: test_stopping.py PROGRAM [unittest arguments]"""
import os
import signal
import time

import meshes
import program_test


class Stopping(program_test.ProgramTest):
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
    program_test.main()
