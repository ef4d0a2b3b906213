#!/usr/bin/env python3
"""The plugins in MeshLab's window, driven by mouse and keys: menu, dialog, progress, cancelling, preview, live view.

Usage: test_window.py FILTER_PLUGIN RENDER_PLUGIN PROGRAM [unittest arguments]
Where SHBAKE_SCREENSHOTS names a folder, pictures of the screen are left there."""
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

import ply
import staged_meshlab
from picture import Picture
from staged_meshlab import wait_until

FILTERS, RENDERER, PROGRAM = (pathlib.Path(p).resolve() for p in sys.argv[1:4])
SCREEN = (1280, 1024)
# What of the main window shows the mesh, whatever dialogs are open at its left.
VIEW = (520, 100, 320, 700)
# The filters' menus and entries in Debian's MeshLab, both counted upwards from the end.
BAKE, RELIGHT, REFINE = (9, 7), (9, 6), (13, 21)
# The buttons of a single layer that show its edges, and that give them one colour.
EDGES, ONE_COLOR = (1039, 114), (1191, 605)
# Bytes of a picture in which nothing has changed are the same; a blinking cursor is not in the view.
STILL = 0.01
# MeshLab shows and hides the thin lines of its trackball on its own: pictures that are the same but for these.
SAME = 0.2
# What a light that has turned must change at least, in the mean over all bytes of the view.
TURNED = 1.0


def knot(segments, sides):
    """A closed tube in a trefoil knot, which shadows itself: 2 * segments * sides triangles."""
    vertices, faces = [], []
    for i in range(segments):
        t = 2 * math.pi * i / segments
        # The curve winds around a torus, whose normal at each point stands on the curve.
        ring, turn = 2 + math.cos(3 * t), (math.cos(2 * t), math.sin(2 * t))
        center = (ring * turn[0], ring * turn[1], math.sin(3 * t))
        u = (math.cos(3 * t) * turn[0], math.cos(3 * t) * turn[1], math.sin(3 * t))
        along = (-2 * center[1] - 3 * math.sin(3 * t) * turn[0], 2 * center[0] - 3 * math.sin(3 * t) * turn[1],
                 3 * math.cos(3 * t))
        v = [along[(k + 1) % 3] * u[(k + 2) % 3] - along[(k + 2) % 3] * u[(k + 1) % 3] for k in range(3)]
        v = [c / math.hypot(*along) for c in v]
        for j in range(sides):
            a = 2 * math.pi * j / sides
            vertices.append(tuple(center[k] + 0.5 * (math.cos(a) * u[k] + math.sin(a) * v[k]) for k in range(3)))
    for i in range(segments):
        for j in range(sides):
            a, b = i * sides + j, i * sides + (j + 1) % sides
            c, d = (a + sides) % len(vertices), (b + sides) % len(vertices)
            faces += [(a, d, c), (a, b, d)]
    return vertices, faces


class WindowTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="shbake-window-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.prefix = staged_meshlab.stage(self.folder / "prefix", [FILTERS, RENDERER])
        self.screen = self.enterContext(staged_meshlab.Screen(*SCREEN))

    def start(self, mesh):
        """Opens MeshLab with a mesh, as large as the screen."""
        self.log = (self.folder / "log").open("w")
        self.addCleanup(self.log.close)
        try:
            self.launch(mesh)
        except AssertionError as failure:
            # Now and then MeshLab never shows its window.
            print(f"MeshLab is started again: {failure}", file=sys.stderr)
            self.stop()
            self.launch(mesh)
        wait_until(lambda: "All files opened" in self.logged(), 60, "the mesh")
        wait_until(self.fills_screen, 60, "the window to fill the screen")
        self.do("windowfocus", "--sync", self.window)
        self.settle()

    def launch(self, mesh):
        self.meshlab = subprocess.Popen([self.prefix / "bin/meshlab", mesh], env=self.screen.environment, cwd=self.folder,
                                        stdin=subprocess.DEVNULL, stdout=self.log, stderr=self.log)
        self.addCleanup(self.stop)
        self.window = self.wait_for_window("MeshLab 2020", 30)

    def fills_screen(self):
        """Makes the window as large as the screen; true once the lower right of the view has MeshLab's blue."""
        # Again and again: MeshLab chooses a size of its own when it has come up.
        self.do("windowsize", self.window, *SCREEN)
        time.sleep(0.5)
        left, top, width, height = VIEW
        red, _, blue = self.picture().part(left + width - 9, top + height - 9, 9, 9).mean()
        return 50 < blue - red < 120

    def stop(self):
        if self.meshlab.poll() is None:
            self.meshlab.kill()
        self.meshlab.wait()

    def assert_alive(self):
        self.assertIsNone(self.meshlab.poll(), f"MeshLab has ended:\n{self.logged()}")

    def logged(self):
        return (self.folder / "log").read_text(errors="replace")

    def do(self, *arguments):
        """Calls xdotool; what it prints."""
        return subprocess.run(["xdotool", *map(str, arguments)], env=self.screen.environment, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, timeout=60).stdout.decode()

    def windows(self, name):
        return self.do("search", "--onlyvisible", "--name", f"^{name}").split()

    def wait_for_window(self, name, seconds=30):
        return wait_until(lambda: self.windows(name), seconds, f"the window {name}")[-1]

    def geometry(self, window):
        values = dict(line.split("=") for line in self.do("getwindowgeometry", "--shell", window).split())
        return tuple(int(values[k]) for k in ("X", "Y", "WIDTH", "HEIGHT"))

    def click(self, x, y):
        self.do("mousemove", x, y, "click", 1)

    def keys(self, *names):
        self.do("key", "--delay", 30, *names)

    def picture(self):
        return Picture.of_screen(self.screen.folder / "Xvfb_screen0")

    def view(self):
        return self.picture().part(*VIEW)

    def settle(self, seconds=30):
        """Waits until the view has stopped changing; what it shows then."""
        last = [self.view()]

        def still():
            time.sleep(0.3)
            last.append(self.view())
            return last[-1].difference(last[-2]) < STILL

        wait_until(still, seconds, "the view to come to rest")
        return last[-1]

    def settle_changed(self, before, failure):
        """Waits until the view shows something else than before and has come to rest; what it shows then."""
        # A log or a key is ahead of the picture where the processor is busy.
        wait_until(lambda: self.view().difference(before) > TURNED, 30, failure)
        settled = self.settle()
        self.assertGreater(settled.difference(before), TURNED, failure)
        return settled

    def wait_for_view(self, picture):
        """Waits until the view shows this again."""
        wait_until(lambda: self.view().difference(picture) < SAME, 30, "the view to look as before")

    def keep(self, name):
        """Leaves a picture of the screen where SHBAKE_SCREENSHOTS says."""
        folder = os.environ.get("SHBAKE_SCREENSHOTS")
        if folder:
            self.picture().write_png(pathlib.Path(folder) / f"{name}.png")

    def open_filter(self, place, name):
        """Chooses a filter from the menu; its dialog."""
        menu, entry = place
        self.do("windowfocus", "--sync", self.window)
        self.click(121, 10)
        time.sleep(0.3)
        self.keys(*["Up"] * menu, "Right")
        time.sleep(0.2)
        self.keys(*["Up"] * entry)
        time.sleep(0.2)
        self.keep("menu")
        self.keys("Return")
        dialog = self.wait_for_window(name)
        time.sleep(0.5)
        self.do("windowfocus", "--sync", dialog)
        return dialog

    def apply(self, dialog):
        """Clicks Apply in the dialog of a filter."""
        left, top, width, height = self.geometry(dialog)
        self.click(left + width * 3 // 4, top + height - 23)

    def write_knot(self, segments, sides):
        mesh = self.folder / "knot.ply"
        ply.write_mesh(mesh, *knot(segments, sides))
        return mesh

    def baked_knot(self):
        baked = self.folder / "knot.shply"
        subprocess.run([PROGRAM, "bake", self.write_knot(160, 24), "-o", self.folder / "knot_sh.ply", "--rays", "256", "-q"],
                       check=True, timeout=120)
        (self.folder / "knot_sh.ply").rename(baked)
        return baked


class Bake(WindowTest):
    def test_menu_dialog_progress_and_colours(self):
        self.start(self.write_knot(500, 60))
        before = self.settle()
        dialog = self.open_filter(BAKE, "SH Bake Light Transfer")
        self.keep("dialog")
        self.apply(dialog)
        wait_until(lambda: len(self.windows("SH Bake Light Transfer")) == 2, 30, "the progress window")
        time.sleep(0.3)
        self.keep("progress")
        wait_until(lambda: "Applied filter SH Bake Light Transfer" in self.logged(), 120, "the bake")
        self.assertEqual(len(self.windows("SH Bake Light Transfer")), 1)
        self.settle_changed(before, "the bake's colours")
        self.keep("baked")
        self.assert_alive()

    def test_cancelling_again_and_again(self):
        self.start(self.write_knot(1000, 100))
        before = self.settle()
        for turn in range(5):
            # The dialog stays open after a failure; now and then a user chooses the filter anew.
            if turn in (0, 4):
                dialog = self.open_filter(BAKE, "SH Bake Light Transfer")
            self.apply(dialog)
            wait_until(lambda: len(self.windows("SH Bake Light Transfer")) == 2, 30, "the progress window")
            self.do("windowfocus", "--sync", self.windows("SH Bake Light Transfer")[-1])
            self.keys("Escape")
            failure = self.wait_for_window("Filter Failure")
            self.keep("cancelled")
            self.do("windowfocus", "--sync", failure)
            self.keys("Return")
            wait_until(lambda: not self.windows("Filter Failure"), 30, "the message to close")
            self.assert_alive()
        self.assertNotIn("Applied filter", self.logged())
        # The dialog is still open at the left of the view; the mesh is as it was.
        self.wait_for_view(before)

    def test_meshlab_cannot_be_left_during_a_bake(self):
        self.start(self.write_knot(500, 60))
        self.apply(self.open_filter(BAKE, "SH Bake Light Transfer"))
        wait_until(lambda: len(self.windows("SH Bake Light Transfer")) == 2, 30, "the progress window")
        # The progress window blocks the others: the wish to leave is not heard.
        self.do("windowfocus", "--sync", self.window)
        self.keys("ctrl+q")
        wait_until(lambda: "Applied filter SH Bake Light Transfer" in self.logged(), 120, "the bake")
        self.assert_alive()
        # It would have been heard without a bake.
        self.stop()
        self.start(self.folder / "knot.ply")
        self.keys("ctrl+q")
        wait_until(lambda: self.meshlab.poll() is not None, 30, "MeshLab to end")


class Refine(WindowTest):
    def test_the_layer_gets_vertices_and_loses_nothing(self):
        # A knot over a floor of two triangles, each vertex in a colour of its own.
        vertices, faces = knot(60, 12)
        first = len(vertices)
        vertices += [(4.0 * x, 4.0 * y, -2.0) for y in (-1, 1) for x in (-1, 1)]
        faces += [(first, first + 1, first + 3), (first, first + 3, first + 2)]
        colors = [tuple(int(127 + 120 * math.sin(c + k)) for k, c in enumerate(v)) for v in vertices]
        mesh = self.folder / "knot.ply"
        ply.write_mesh(mesh, vertices, faces, colors=colors)
        columns, knot_faces = ply.read_columns(mesh), faces[:-2]
        self.start(mesh)
        self.click(*EDGES)
        before = self.settle()
        dialog = self.open_filter(REFINE, "SH Refine Flat Regions")
        self.keep("refine")
        self.apply(dialog)
        wait_until(lambda: "Applied filter SH Refine Flat Regions" in self.logged(), 60, "the refinement")
        # MeshLab draws edges in the colours of their vertices once a filter has made some.
        self.click(*ONE_COLOR)
        self.settle_changed(before, "the refined mesh instead of the old one")
        self.keep("refined")
        # Saves the layer as the file that it came from.
        self.do("windowfocus", "--sync", self.window)
        self.keys("ctrl+e")
        options = self.wait_for_window("Choose Saving Options")
        self.do("windowfocus", "--sync", options)
        self.keys("Return")
        wait_until(lambda: "Saved Mesh" in self.logged(), 30, "the file")
        refined, refined_faces = ply.read_columns(mesh), ply.read_faces(mesh)
        self.assertGreater(len(refined["x"]), len(vertices) + 1000)
        for name, values in columns.items():
            self.assertEqual(refined[name][:len(vertices)], values, name)
        self.assertEqual(set(refined["z"][len(vertices):]), {-2.0})
        # The faces of the knot are all there, and those of the floor cover what its two triangles covered.
        self.assertLessEqual(set(knot_faces), set(refined_faces))
        floor = [f for f in refined_faces if all(refined["z"][i] == -2.0 for i in f)]
        self.assertEqual(len(floor), len(refined_faces) - len(knot_faces))
        x, y = refined["x"], refined["y"]
        area = sum((x[b] - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (y[b] - y[a]) for a, b, c in floor) / 2
        # Vertices within the floor cancel out, whatever their rounding; each product of doubles is at most 64.
        self.assertAlmostEqual(area, 64, delta=64 * 2**-52 * len(floor))
        self.assert_alive()


class Relight(WindowTest):
    def slider(self, dialog):
        """Where the handle of the dialog's first slider is: where its blue part ends."""
        left, top, width, height = self.geometry(dialog)
        pixels = self.picture().part(left, top, width, height)

        def is_blue(x, y):
            r, g, b = pixels.pixels[3 * (y * width + x):3 * (y * width + x) + 3]
            return b > 150 and b - r > 80 and r < 100

        for y in range(height - 3):
            # Taller than the frame of whatever has the focus.
            blue = [x for x in range(width) if all(is_blue(x, y + i) for i in range(3))]
            if len(blue) >= 40:
                return left + blue[-1] + 6, top + y + 1
        raise AssertionError("the dialog has no slider")

    def test_the_preview_follows_the_slider(self):
        self.start(self.baked_knot())
        before = self.settle()
        dialog = self.open_filter(RELIGHT, "SH Relight")
        left, top, _, height = self.geometry(dialog)
        self.click(left + 17, top + height - 83)  # Preview
        overcast = self.settle_changed(before, "Preview to show something")
        self.keys("Tab", "Down")  # the light: the clear sky
        clear = self.settle_changed(overcast, "another light to show something else")
        x, y = self.slider(dialog)
        self.do("mousemove", x, y, "mousedown", 1)
        pictures = [clear]
        for step in (25, 45):
            self.do("mousemove", x + step, y)
            pictures.append(self.settle_changed(pictures[-1], "the slider to turn something"))
            self.keep(f"preview_{step}")
            self.assertNotEqual(pictures[-1].mean(), pictures[-2].mean())
        self.do("mouseup", 1)
        self.assert_alive()
        # Without Preview the layer has its colours back.
        self.click(left + 17, top + height - 83)
        self.wait_for_view(before)


class LiveView(WindowTest):
    def test_the_light_turns_with_sliders_and_mouse(self):
        self.start(self.baked_knot())
        plain = self.settle()
        self.click(178, 10)
        time.sleep(0.3)
        self.keys("Down", "Right")
        time.sleep(0.2)
        self.keys("Up", "Return")  # the last of the shaders
        panel = self.wait_for_window("SH Relight")
        self.do("windowmove", "--sync", panel, 20, 120)
        self.do("windowfocus", "--sync", panel)
        overcast = self.settle_changed(plain, "the live view")
        self.keys("Down")  # the clear sky
        pictures = [self.settle_changed(overcast, "the clear sky")]
        self.keep("live")
        self.keys("Tab", "Tab", *["Next"] * 6)  # the slider of the rotation, in larger steps
        pictures.append(self.settle_changed(pictures[0], "the slider to turn something"))
        self.keep("live_turned")
        x, y = VIEW[0] + 100, VIEW[1] + 300
        self.do("keydown", "ctrl", "keydown", "shift", "mousemove", x, y, "mousedown", 1)
        for step in range(0, 100, 10):
            self.do("mousemove", x + step, y)
        self.do("mouseup", 1, "keyup", "shift", "keyup", "ctrl")
        pictures.append(self.settle_changed(pictures[1], "dragging to turn something"))
        self.assertEqual(len({p.mean() for p in pictures}), 3)
        # Leaving the live view gives MeshLab's own back.
        self.do("windowfocus", "--sync", self.window)
        self.click(178, 10)
        time.sleep(0.3)
        self.keys("Down", "Right", "Return")
        wait_until(lambda: not self.windows("SH Relight"), 30, "the panel to close")
        self.wait_for_view(plain)
        self.assert_alive()


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
