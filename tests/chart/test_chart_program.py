#!/usr/bin/env python3
"""The verb chart as a user meets it: formats, messages, budget, cache, Ctrl-C.

Usage: test_chart_program.py PROGRAM [unittest arguments]"""
import html.parser
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "cli"))
import meshes  # noqa: E402

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
HAS_GNUPLOT = shutil.which("gnuplot") is not None


def restore_signals():
    """Ctrl-C may be ignored in what runs the tests; the program would inherit that."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


class Tags(html.parser.HTMLParser):
    """Counts the tags of a page and finds those left open."""
    VOID = {"meta", "br", "path", "use", "circle", "rect", "polygon", "line", "feFlood", "feComposite"}

    def __init__(self):
        super().__init__()
        self.count, self.open, self.faults = {}, [], []

    def handle_starttag(self, tag, attributes):
        self.count[tag] = self.count.get(tag, 0) + 1
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.count[tag] = self.count.get(tag, 0) + 1

    def handle_endtag(self, tag):
        if tag in self.VOID:
            return
        if not self.open or self.open.pop() != tag:
            self.faults.append(tag)


class Chart(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="shbake-chart-"))
        self.addCleanup(shutil.rmtree, self.folder)
        meshes.write_obj(self.folder / "box.obj", *meshes.box_on_floor())

    def run_program(self, *arguments, **options):
        return subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              timeout=120, **options)

    def chart(self, output, *arguments, budget=3):
        result = self.run_program("chart", "box.obj", "-o", output, "--budget", str(budget), *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def test_json_has_all_parts_and_the_cache_is_used_again(self):
        self.chart("box.json", "--light", "clear")
        chart = json.loads((self.folder / "box.json").read_text())
        self.assertEqual(chart["shbake_chart"], 1)
        self.assertEqual(chart["mesh"], "box.obj")
        self.assertIn("clear", chart["light"])
        for method in chart["methods"]:
            rays = [p["rays"] for p in method["points"]]
            self.assertEqual(rays, sorted(rays))
            self.assertGreater(len(rays), 0)
        self.assertEqual([o["order"] for o in chart["orders"]], list(range(1, 9)))
        self.assertEqual(len(chart["advice"]), 4)
        cache = self.folder / "box.json.reference"
        kept = cache.read_bytes()
        self.chart("box.json", budget=1)
        self.assertEqual(cache.read_bytes(), kept)
        cache.write_bytes(kept[:-3])
        result = self.chart("box.json")
        self.assertIn("made anew", result.stdout)
        self.assertEqual(cache.read_bytes(), kept)
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["box.json", "box.json.places", "box.json.reference", "box.obj"])

    @unittest.skipUnless(HAS_GNUPLOT, "gnuplot is not installed")
    def test_pictures_and_pages(self):
        self.chart("box.png", budget=1)
        self.assertEqual((self.folder / "box.png").read_bytes()[:4], b"\x89PNG")
        self.chart("box.html")
        page = (self.folder / "box.html").read_text()
        self.assertGreaterEqual(page.count("<svg"), 3)
        self.assertNotIn("<img", page)
        tags = Tags()
        tags.feed(page)
        self.assertEqual((tags.open, tags.faults), ([], []))
        self.assertGreaterEqual(tags.count["table"], 4)
        # What a method is stands in words; numbers are aligned as such.
        self.assertIn('<th class="words">what it is</th>', page)
        self.assertNotRegex(page, r'class="words">[-0-9]')

    def test_wrong_usage_is_told_before_any_work(self):
        for arguments, words in ((["chart"], "no mesh"), (["chart", "box.obj"], "no output"),
                                 (["chart", "box.obj", "-o", "a.gif"], ".html, .svg, .png or .json"),
                                 (["chart", "box.obj", "-o", "a.json", "--budget", "0"], "--budget"),
                                 (["chart", "box.obj", "-o", "a.json", "--order", "9"], "--order")):
            with self.subTest(arguments):
                result = self.run_program(*arguments)
                self.assertEqual(result.returncode, 2, result.stderr)
                self.assertIn(words, result.stderr)
        result = self.run_program("chart", "box.obj", "-o", "missing/a.json")
        self.assertEqual(result.returncode, 1)

    def test_without_gnuplot_pictures_are_refused_and_json_works(self):
        nowhere = {**os.environ, "PATH": str(self.folder)}
        result = self.run_program("chart", "box.obj", "-o", "a.png", "--budget", "1", env=nowhere)
        self.assertEqual(result.returncode, 1)
        self.assertIn("gnuplot-nox", result.stderr)
        self.assertEqual([p.name for p in self.folder.iterdir()], ["box.obj"])
        result = self.run_program("chart", "box.obj", "-o", "a.json", "--budget", "1", env=nowhere)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_ctrl_c_leaves_no_half_file_and_work_goes_on(self):
        meshes.write_obj(self.folder / "bowl.obj", *meshes.bowl(60, 120))
        process = subprocess.Popen([PROGRAM, "chart", "bowl.obj", "-o", "bowl.json", "--budget", "300"], cwd=self.folder,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=restore_signals)
        cache = self.folder / "bowl.json.reference"
        for _ in range(600):  # until the first part of the reference is kept
            if cache.exists():
                break
            time.sleep(0.1)
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=30)
        self.assertEqual(process.returncode, 130)
        self.assertTrue(err.endswith(b"shbake: stopped\n"), err)
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["bowl.json.reference", "bowl.obj", "box.obj"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:], verbosity=1)
