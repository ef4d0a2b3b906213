#!/usr/bin/env python3
"""Prints how much memory MeshLab's window holds after bakes that are cancelled, beside what it holds after as many
filters that fail before they begin: what it grows by then is its own.

Usage: window_memory.py FILTER_PLUGIN RENDER_PLUGIN PROGRAM [CYCLES]   (50 by default; some six minutes)"""
import re
import sys

from staged_meshlab import wait_until
from test_window import BAKE, RELIGHT, WindowTest, knot, ply

CYCLES = int(sys.argv[4]) if len(sys.argv) > 4 else 50
# 72,000 faces, about those of the Stanford bunny.
SEGMENTS, SIDES = 600, 60


class Window(WindowTest):
    def runTest(self):
        """Only what WindowTest does before and after is of use here."""

    def megabytes(self):
        with open(f"/proc/{self.meshlab.pid}/status", encoding="ascii") as status:
            return int(re.search(r"VmRSS:\s+(\d+) kB", status.read())[1]) / 1024

    def close_failure(self):
        failure = self.wait_for_window("Filter Failure")
        self.do("windowfocus", "--sync", failure)
        self.keys("Return")
        wait_until(lambda: not self.windows("Filter Failure"), 30, "the message to close")

    def cancel_a_bake(self):
        self.apply(self.open_filter(BAKE, "SH Bake Light Transfer"))
        wait_until(lambda: len(self.windows("SH Bake Light Transfer")) == 2, 30, "the progress window")
        self.do("windowfocus", "--sync", self.windows("SH Bake Light Transfer")[-1])
        self.keys("Escape")
        self.close_failure()

    def relight_what_is_not_baked(self):
        self.apply(self.open_filter(RELIGHT, "SH Relight"))
        self.close_failure()

    def measure(self, cycle):
        """Megabytes after each tenth of the cycles."""
        mesh = self.folder / "knot.ply"
        ply.write_mesh(mesh, *knot(SEGMENTS, SIDES))
        self.start(mesh)
        held = [self.megabytes()]
        for i in range(1, CYCLES + 1):
            cycle()
            if i % max(1, CYCLES // 10) == 0:
                held.append(self.megabytes())
        self.assert_alive()
        return held


def measured(cycle):
    window = Window()
    window.setUp()
    try:
        return window.measure(getattr(window, cycle))
    finally:
        window.doCleanups()


if __name__ == "__main__":
    cancelled, failed = measured("cancel_a_bake"), measured("relight_what_is_not_baked")
    for name, held in (("bakes cancelled", cancelled), ("filters failed", failed)):
        print(f"{name:16}", *(f"{m:4.0f}" for m in held), "MB")
    print(f"{CYCLES} cycles: {100 * (cancelled[-1] / failed[-1] - 1):+.1f} % beside MeshLab's own")
