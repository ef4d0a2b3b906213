"""What the tests of filters share: a MeshLab with the plugin, meshlabserver, and the program to compare with.

The test that imports this is called with PLUGIN PROGRAM SHARED_DIR [unittest arguments]."""
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import filter_scripts
import ply
import staged_meshlab
from filter_scripts import shipped_filter

PLUGIN, PROGRAM, SHARED = (pathlib.Path(p).resolve() for p in sys.argv[1:4])


def sphere_over_floor():
    """A coarse sphere above a floor, all triangles: shadows, reflections, vertices of many faces, no degenerate face."""
    vertices = [(x, y, 0.0) for y in (-2.0, 2.0) for x in (-2.0, 2.0)]
    faces = [(0, 1, 3), (0, 3, 2)]
    rings, segments, base = 6, 10, len(vertices)
    for i in range(1, rings):
        for j in range(segments):
            theta, phi = math.pi * i / rings, 2 * math.pi * j / segments
            vertices.append((math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), 1.25 + math.cos(theta)))
    north, south = len(vertices), len(vertices) + 1
    vertices += [(0.0, 0.0, 2.25), (0.0, 0.0, 0.25)]
    for j in range(segments):
        k = (j + 1) % segments
        faces.append((north, base + j, base + k))
        last = base + (rings - 2) * segments
        faces.append((south, last + k, last + j))
        for i in range(rings - 2):
            a = base + i * segments
            faces += [(a + j, a + j + segments, a + k + segments), (a + j, a + k + segments, a + k)]
    return vertices, faces


def rainbow(vertices):
    """Colours that depend on the place."""
    return [tuple(int(127 + 120 * math.sin(3 * c + k)) for k, c in enumerate(v)) for v in vertices]


class PluginTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stage_folder = pathlib.Path(tempfile.mkdtemp(prefix="shbake-meshlab-"))
        cls.addClassCleanup(shutil.rmtree, cls.stage_folder)
        cls.prefix = staged_meshlab.stage(cls.stage_folder / "prefix", [PLUGIN])
        cls.screen = cls.enterClassContext(staged_meshlab.Screen())

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="shbake-filters-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.mesh = self.folder / "mesh.ply"
        ply.write_mesh(self.mesh, *sphere_over_floor())

    def apply(self, *filters, meshes=None, options=()):
        """Opens meshes in MeshLab and applies filters. Returns (return code, what was printed)."""
        script = filter_scripts.write_script(self.folder / "script.mlx", *filters)
        opened = [a for m in meshes or [self.mesh] for a in ("-i", m)]
        return staged_meshlab.run_server(self.prefix, self.screen, *opened, *options, "-s", script, cwd=self.folder)

    def bake_here(self, *before, meshes=None, then=(), **values):
        """Bakes within MeshLab and saves; the bytes of the file."""
        saved = self.folder / "here.ply"
        saved.unlink(missing_ok=True)
        code, text = self.apply(*before, shipped_filter("bake", **values), *then, shipped_filter("save", file=saved),
                                meshes=meshes)
        self.assertEqual(code, 0, text)
        self.assertTrue(saved.exists(), text)
        return saved.read_bytes()

    def program(self, *arguments):
        result = subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=120)
        self.assertEqual(result.returncode, 0, result.stdout.decode())

    def bake_there(self, *options, mesh=None):
        """Bakes with the program; the bytes of the file."""
        self.program("bake", mesh or self.mesh, "-o", "there.ply", "-q", *options)
        return (self.folder / "there.ply").read_bytes()

    def assert_message(self, result, *parts):
        """The filter failed and said why; MeshLab lives: neither an abort nor a crash."""
        code, text = result
        self.assertGreaterEqual(code, 0, text)
        self.assertIn("Problem with filter", text)
        for part in parts:
            self.assertIn(part, text)


def main():
    unittest.main(module="__main__", argv=[sys.argv[0], *sys.argv[4:]])
