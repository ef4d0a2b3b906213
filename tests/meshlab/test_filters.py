#!/usr/bin/env python3
"""The filters and the format of the plugin, called by meshlabserver: the same bytes as the program, or a clear message.

Usage: test_filters.py PLUGIN PROGRAM SHARED_DIR [unittest arguments]"""
import math
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

import filter_scripts
import ply
import staged_meshlab
from filter_scripts import shipped_filter, stock_filter

PLUGIN, PROGRAM, SHARED = (pathlib.Path(p).resolve() for p in sys.argv[1:4])

# Transforms of a layer, row by row: a quarter turn about x, which keeps floats what they are, and one with a shift.
QUARTER_TURN = [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1]
TURN_AND_SHIFT = [1, 0, 0, 3, 0, 0, -1, 0, 0, 1, 0, -2, 0, 0, 0, 1]


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


class Bake(PluginTest):
    def test_filters_are_listed(self):
        code, text = staged_meshlab.run_server(self.prefix, self.screen, "-d", self.folder / "dump.txt")
        self.assertEqual(code, 0, text)
        dump = (self.folder / "dump.txt").read_text(errors="replace")
        for name in ("SH Bake Light Transfer", "SH Refine Flat Regions", "SH Relight", "SH Save Baked PLY"):
            self.assertIn(name, dump)

    def test_same_bytes_as_the_program(self):
        cases = [
            ({}, []),
            ({"transfer": 0}, ["--transfer", "unshadowed"]),
            ({"transfer": 1, "order": 3, "rays": 64, "seed": 7},
             ["--transfer", "shadowed", "--order", 3, "--rays", 64, "--seed", 7]),
            ({"normals": 2, "rays": 32}, ["--normals", "flat", "--rays", 32]),
            ({"crease": 20.5, "rays": 32}, ["--crease", "20.5", "--rays", 32]),
            ({"bounces": 2, "rays": 32}, ["--bounces", 2, "--rays", 32]),
            ({"fit": 1, "rays": 32}, ["--fit", "surface", "--rays", 32]),
            ({"fit": 2, "rays": 32}, ["--fit", "auto", "--rays", 32]),
            ({"albedo": 1, "albedo_red": 0.7, "albedo_green": 0.33, "albedo_blue": 0.1, "rays": 32},
             ["--albedo", "0.7,0.33,0.1", "--rays", 32]),
            ({"max_distance": 0.9, "two_sided": True, "rays": 32, "order": 8},
             ["--max-distance", 0.9, "--two-sided", "--rays", 32, "--order", 8]),
        ]
        for values, options in cases:
            with self.subTest(values):
                self.assertEqual(self.bake_here(**values), self.bake_there("--normals", "smooth", *options))

    def test_threads_and_memory_do_not_change_the_bytes(self):
        self.assertEqual(self.bake_here(threads=1, memory=1, rays=64), self.bake_here(threads=2, rays=64))

    def test_colours_are_albedo_and_are_kept(self):
        vertices, faces = sphere_over_floor()
        ply.write_mesh(self.mesh, vertices, faces, colors=rainbow(vertices))
        there = self.bake_there("--normals", "smooth", "--rays", 32)
        self.assertEqual(self.bake_here(rays=32), there)
        # Neither the grey that a bake shows nor what a light shows may pass for the albedo of the next bake.
        again = self.bake_here(shipped_filter("bake", rays=16), shipped_filter("relight", light=1), rays=32)
        self.assertEqual(again, there)
        linear = self.bake_there("--normals", "smooth", "--rays", 32, "--albedo-space", "linear")
        self.assertEqual(self.bake_here(rays=32, linear_colors=True), linear)

    def test_normals_of_the_layer(self):
        vertices, faces = sphere_over_floor()
        # Neither of unit length nor those of the faces.
        ply.write_mesh(self.mesh, vertices, faces, normals=[(0.25 * v[0], 0.5 * v[1], 2.5) for v in vertices])
        self.assertEqual(self.bake_here(normals=0, rays=32), self.bake_there("--rays", 32))

    def test_the_other_layers_cast_shadows(self):
        roof = self.folder / "roof.ply"
        ply.write_mesh(roof, [(-3, -3, 3), (3, -3, 3), (3, 3, 3)], [(0, 1, 2)])
        there = self.bake_there("--normals", "smooth", "--rays", 32, "--blockers", roof)
        # The last mesh that is opened is the current one.
        self.assertEqual(self.bake_here(meshes=[roof, self.mesh], rays=32), there)
        alone = self.bake_there("--normals", "smooth", "--rays", 32)
        self.assertNotEqual(alone, there)
        self.assertEqual(self.bake_here(meshes=[roof, self.mesh], rays=32, other_layers=False), alone)

    def test_text(self):
        self.bake_here(rays=16)
        saved = self.folder / "text.ply"
        code, text = self.apply(shipped_filter("bake", rays=16), shipped_filter("save", file=saved, ascii=True))
        self.assertEqual(code, 0, text)
        self.assertEqual(saved.read_bytes(), self.bake_there("--normals", "smooth", "--rays", 16, "--ascii"))


class Refine(PluginTest):
    def refined_here(self, *before, options=("-m", "vc", "fc"), **values):
        """The file that MeshLab writes after the filter, and what it printed."""
        out = self.folder / "refined.ply"
        code, text = self.apply(*before, shipped_filter("refine", **values), options=["-o", out, *options])
        self.assertEqual(code, 0, text)
        return out, text

    def refined_there(self, *options):
        self.program("refine", self.mesh, "-o", "refined_there.ply", "-q", *options)
        return self.folder / "refined_there.ply"

    def test_same_vertices_and_faces_as_the_program(self):
        vertices, faces = sphere_over_floor()
        ply.write_mesh(self.mesh, vertices, faces, colors=rainbow(vertices))
        for values, options in [({"length": 0.5}, ["--length", 0.5]),
                                ({"length": 0.3, "flat": 45, "crease": 20}, ["--length", 0.3, "--flat", 45, "--crease", 20])]:
            with self.subTest(values):
                here, text = self.refined_here(**values)
                there = self.refined_there(*options)
                columns = ply.read_columns(here)
                expected = ply.read_columns(there)
                self.assertGreater(len(columns["x"]), len(vertices) + 20, text)
                for name in ("x", "y", "z", "red", "green", "blue"):
                    self.assertEqual(columns[name], expected[name], name)
                self.assertEqual(ply.read_faces(here), ply.read_faces(there))
                self.assertIn("refined", text)

    def test_nothing_flat_changes_nothing(self):
        vertices, faces = sphere_over_floor()
        ply.write_mesh(self.mesh, vertices[4:], [[i - 4 for i in f] for f in faces[2:]])
        here, text = self.refined_here(length=0.1)
        self.assertIn("the layer is as it was", text)
        self.assertEqual(len(ply.read_columns(here)["x"]), len(vertices) - 4)

    def test_a_bake_is_dropped_with_a_word(self):
        self.assert_message(self.apply(shipped_filter("bake", rays=16), shipped_filter("refine", length=0.5),
                                       shipped_filter("relight")),
                            "the light that was baked has been dropped", "holds no baked light transfer")

    def test_a_bake_after_it_has_the_transfer_of_the_refined_mesh(self):
        here = self.bake_here(shipped_filter("refine", length=0.5), rays=32)
        columns = ply.read_columns(self.folder / "here.ply")
        self.program("bake", self.refined_there("--length", 0.5), "-o", "there.ply", "-q", "--normals", "smooth", "--rays", 32)
        self.assertEqual(columns, ply.read_columns(self.folder / "there.ply"))
        self.assertIn(b"sh_15", here)

    def test_the_bake_refines_as_the_program_does(self):
        cases = [({"refine": 1, "refine_length": 0.7, "rays": 32}, ["--refine", 0.7, "--rays", 32]),
                 ({"refine": 2, "rays": 64, "flat": 2}, ["--refine", "auto", "--rays", 64, "--flat", 2]),
                 ({"refine": 0, "fit": 0, "tolerance": 0.3}, ["--tolerance", 0.3, "--refine", "no", "--fit", "vertex"]),
                 ({"tolerance": 0.1}, ["--tolerance", 0.1])]
        for values, options in cases:
            with self.subTest(values):
                self.assertEqual(self.bake_here(**values), self.bake_there("--normals", "smooth", *options))
        refined = ply.read_columns(self.folder / "here.ply")
        self.assertIn(-1, refined["source_vertex"])

    def test_a_refining_bake_of_a_coloured_layer(self):
        vertices, faces = sphere_over_floor()
        ply.write_mesh(self.mesh, vertices, faces, colors=rainbow(vertices))
        there = self.bake_there("--normals", "smooth", "--rays", 32, "--refine", 0.7)
        self.assertEqual(self.bake_here(rays=32, refine=1, refine_length=0.7), there)

    def test_choices_are_told(self):
        saved = self.folder / "here.ply"
        code, text = self.apply(shipped_filter("bake", tolerance=0.1), shipped_filter("save", file=saved))
        self.assertEqual(code, 0, text)
        for part in ("chosen: transfer interreflected", "chosen: refine ", "chosen: rays ", "chosen: fit ", "surface error: "):
            self.assertIn(part, text)

    def test_a_convex_mesh_needs_no_rays_for_its_tolerance(self):
        vertices, faces = sphere_over_floor()
        ply.write_mesh(self.mesh, vertices[4:], [[i - 4 for i in f] for f in faces[2:]])
        self.assertEqual(self.bake_here(tolerance=0.1), self.bake_there("--normals", "smooth", "--tolerance", 0.1))
        self.assertIn(b"transfer=unshadowed", (self.folder / "here.ply").read_bytes())


class Layers(PluginTest):
    def test_deleted_vertices_and_faces(self):
        """meshlabserver leaves deleted vertices in place, unlike the window."""
        delete = [stock_filter("Conditional Vertex Selection", ("RichString", "condSelect", {"value": "z > 1.9"})),
                  stock_filter("Delete Selected Vertices")]
        vertices, faces = sphere_over_floor()
        kept = [i for i, v in enumerate(vertices) if v[2] <= 1.9]
        number = {old: new for new, old in enumerate(kept)}
        self.assertLess(len(kept), len(vertices))
        there = self.folder / "kept" / "mesh.ply"
        there.parent.mkdir()
        ply.write_mesh(there, [vertices[i] for i in kept],
                       [[number[i] for i in f] for f in faces if all(i in number for i in f)])
        self.assertEqual(self.bake_here(*delete, rays=32), self.bake_there("--normals", "smooth", "--rays", 32, mesh=there))

    def test_vertices_deleted_after_the_bake_take_their_transfer_along(self):
        delete = [stock_filter("Conditional Vertex Selection", ("RichString", "condSelect", {"value": "z > 1.9"})),
                  stock_filter("Delete Selected Vertices")]
        self.bake_here(rays=32)
        whole = ply.read_columns(self.folder / "here.ply")
        self.bake_here(then=delete, rays=32)
        left = ply.read_columns(self.folder / "here.ply")
        kept = [i for i, z in enumerate(whole["z"]) if z <= 1.9]
        for name in ("x", "z", "nx", "sh_0", "sh_15", "quality", "sh_error"):
            self.assertEqual(left[name], [whole[name][i] for i in kept], name)

    def transform(self, matrix, freeze=False):
        """Gives the layer a transform, by a filter of MeshLab's own."""
        return stock_filter(
            "Matrix: Set/Copy Transformation",
            ("RichMatrix44f", "TransformMatrix", {f"val{i}": str(v) for i, v in enumerate(matrix)}),
            ("RichBool", "compose", {"value": "false"}), ("RichBool", "Freeze", {"value": str(freeze).lower()}),
            ("RichBool", "allLayers", {"value": "false"}))

    def test_a_layer_is_baked_where_its_transform_puts_it(self):
        vertices, faces = sphere_over_floor()
        self.bake_here(self.transform(QUARTER_TURN), rays=64)
        here = ply.read_columns(self.folder / "here.ply")
        there = self.folder / "turned" / "mesh.ply"
        there.parent.mkdir()
        ply.write_mesh(there, [(x, -z, y) for x, y, z in vertices], faces)
        self.bake_there("--normals", "smooth", "--rays", 64, mesh=there)
        expected = ply.read_columns(self.folder / "there.ply")
        self.assertEqual(here, expected)

    def test_a_layer_turned_after_the_bake_is_lit_from_where_the_light_is(self):
        """Turning the layer, or freezing the turn, gives the colours that a bake of the turned layer has."""
        light = shipped_filter("relight", light=4, sun_altitude=20, sun_azimuth=70, disc_angle=30, auto_exposure=False)
        colors = {}
        for name, filters in {
                "baked turned": [self.transform(TURN_AND_SHIFT), shipped_filter("bake", rays=256)],
                "turned later": [shipped_filter("bake", rays=256), self.transform(TURN_AND_SHIFT)],
                "not turned": [shipped_filter("bake", rays=256)]}.items():
            out = self.folder / "colors.ply"
            code, text = self.apply(*filters, light, options=["-o", out, "-m", "vc"])
            self.assertEqual(code, 0, text)
            colors[name] = ply.read_columns(out)
        difference = {
            name: sum(abs(a - b) for a, b in zip(colors[name]["red"], colors["baked turned"]["red"], strict=True)) /
            len(colors[name]["red"]) for name in colors}
        # Both bakes state errors below one per cent: 2.55 of 255 in linear light, and less than 13 times that in sRGB
        # where it is steepest, at black; the mean over the layer is far below.
        self.assertLess(difference["turned later"], 2.55)
        self.assertGreater(difference["not turned"], 10)

    def test_a_layer_frozen_after_a_turn_must_be_baked_again(self):
        saved = self.folder / "out.ply"
        result = self.apply(shipped_filter("bake", rays=16), self.transform(TURN_AND_SHIFT, freeze=True),
                            shipped_filter("save", file=saved))
        self.assert_message(result, "has been turned or reshaped since it was baked", "bake it again")
        self.assertFalse(saved.exists())

    def test_no_faces(self):
        ply.write_mesh(self.mesh, [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [])
        self.assert_message(self.apply(shipped_filter("bake")), "the mesh has no faces")

    def test_a_layer_without_vertices(self):
        empty = [stock_filter("Conditional Vertex Selection", ("RichString", "condSelect", {"value": "1"})),
                 stock_filter("Delete Selected Vertices")]
        self.assert_message(self.apply(*empty, shipped_filter("bake")), "has no vertices")

    def test_a_layer_that_is_not_baked(self):
        self.assert_message(self.apply(shipped_filter("relight")), "holds no baked light transfer")
        self.assert_message(self.apply(shipped_filter("save", file=self.folder / "out.ply")),
                            "holds no baked light transfer")

    def test_vertices_added_after_the_bake(self):
        divide = stock_filter("Subdivision Surfaces: Midpoint", ("RichInt", "Iterations", {"value": "1"}),
                              ("RichAbsPerc", "Threshold", {"value": "0", "min": "0", "max": "10"}),
                              ("RichBool", "Selected", {"value": "false"}))
        self.assert_message(self.apply(shipped_filter("bake", rays=16), divide, shipped_filter("relight")),
                            "has got vertices since it was baked")


class Relight(PluginTest):
    def relit_here(self, **values):
        out = self.folder / "lit_here.ply"
        code, text = self.apply(shipped_filter("bake", rays=64), shipped_filter("relight", **values),
                                options=["-o", out, "-m", "vc"])
        self.assertEqual(code, 0, text)
        return {c: ply.read_columns(out)[c] for c in ("red", "green", "blue")}

    def relit_there(self, *options):
        self.bake_there("--normals", "smooth", "--rays", 64)
        self.program("relight", "there.ply", "-o", "lit_there.ply", "-q", *options)
        return {c: ply.read_columns(self.folder / "lit_there.ply")[c] for c in ("red", "green", "blue")}

    def test_same_colours_as_the_program(self):
        cases = [
            ({"light": 3}, ["--light", "white"]),
            ({}, ["--light", "overcast"]),
            ({"light": 1, "sun_altitude": 30, "sun_azimuth": 120, "sun_irradiance": 2.5, "ground": 0.2, "rotation": 40},
             ["--light", "clear", "--sun", "30,120", "--sun-irradiance", 2.5, "--ground", 0.2, "--rotate", 40]),
            ({"light": 2, "up": 1, "window": 1, "tone": 2, "auto_exposure": False, "exposure": -0.5},
             ["--light", "partly-cloudy", "--up", "y", "--window", "hann", "--tone", "filmic", "--exposure", -0.5]),
        ]
        for values, options in cases:
            with self.subTest(values):
                self.assertEqual(self.relit_here(**values), self.relit_there(*options))

    def test_light_files(self):
        self.program("light", "-o", "lamp.shlight", "--disc", "1,2,1,20,9,6,3", "--order", 3, "-q")
        lamp = self.folder / "lamp.shlight"
        self.assertEqual(self.relit_here(light=5, light_file=lamp, rotation=-30),
                         self.relit_there("--light", lamp, "--rotate", -30))

    def test_a_probe(self):
        probe = SHARED / "probes/probulator_uffizi.hdr"
        if not probe.exists():
            self.skipTest(f"no probes in {SHARED}")
        self.assertEqual(self.relit_here(light=5, light_file=probe, window=4),
                         self.relit_there("--light", probe, "--window", "auto"))

    def test_the_saved_colours_are_those_asked_for(self):
        code, text = self.apply(shipped_filter("bake", rays=16), shipped_filter("relight", light=1, sun_irradiance=3),
                                shipped_filter("save", file=self.folder / "own.ply"),
                                shipped_filter("save", file=self.folder / "shown.ply", colors=1),
                                options=["-o", self.folder / "lit.ply", "-m", "vc"])
        self.assertEqual(code, 0, text)
        self.assertNotIn("red", ply.read_columns(self.folder / "own.ply"))
        self.assertEqual(ply.read_columns(self.folder / "shown.ply")["red"], ply.read_columns(self.folder / "lit.ply")["red"])


class Format(PluginTest):
    def test_a_baked_layer_survives_a_save_and_a_load(self):
        there = self.bake_there("--normals", "smooth", "--rays", 32)
        kept = self.folder / "kept.shply"
        code, text = self.apply(shipped_filter("bake", rays=32), options=["-o", kept])
        self.assertEqual(code, 0, text)
        self.assertEqual(kept.read_bytes(), there)
        saved = self.folder / "again.ply"
        code, text = self.apply(shipped_filter("save", file=saved), meshes=[kept])
        self.assertEqual(code, 0, text)
        self.assertEqual(saved.read_bytes(), there)

    def test_a_file_of_the_program_opens_here(self):
        self.bake_there("--normals", "smooth", "--rays", 32, "--albedo", "0.9,0.5,0.2")
        shutil.copy(self.folder / "there.ply", self.folder / "there.shply")
        saved = self.folder / "again.ply"
        code, text = self.apply(shipped_filter("save", file=saved), meshes=[self.folder / "there.shply"])
        self.assertEqual(code, 0, text)
        self.assertEqual(saved.read_bytes(), (self.folder / "there.ply").read_bytes())

    def test_bad_files(self):
        good = self.bake_there("--rays", 16)
        for name, data in {"plain": self.mesh.read_bytes(), "cut": good[:-100], "empty": b"", "noise": b"\x00\xff" * 99}.items():
            with self.subTest(name):
                bad = self.folder / f"{name}.shply"
                bad.write_bytes(data)
                code, text = self.apply(shipped_filter("relight"), meshes=[bad])
                self.assertGreaterEqual(code, 0, text)
                self.assertIn(f"{bad}: ", text)

    def test_saving_a_layer_that_is_not_baked(self):
        kept = self.folder / "kept.shply"
        code, text = staged_meshlab.run_server(self.prefix, self.screen, "-i", self.mesh, "-o", kept)
        self.assertGreaterEqual(code, 0, text)
        self.assertIn("holds no baked light transfer", text)
        self.assertFalse(kept.exists())


class WrongValues(PluginTest):
    def test_bake(self):
        cases = [("order", 0, "Order: 0 is out of range"), ("order", 9, "Order: 9"), ("rays", -1, "Rays: -1"),
                 ("rays", 1048577, "Rays: 1048577"), ("tolerance", 0.00001, "Tolerance: 1e-05"), ("tolerance", -1, "Tolerance: -1"), ("tolerance", 2, "Tolerance: 2"),
                 ("tolerance", "nan", "Tolerance: nan"), ("bounces", -2, "Reflections: -2"),
                 ("max_distance", -1, "Maximum distance: -1"), ("seed", -1, "Seed: -1"), ("transfer", 4, "Transfer: 4"),
                 ("fit", 4, "Fit: 4"), ("refine", 4, "Refine flat regions: 4"), ("flat", 46, "Flat angle: 46"),
                 ("max_vertices", 0, "Most vertices: 0"),
                 ("transfer", -1, "Transfer: -1"), ("albedo", 4, "Albedo from: 4"),
                 ("albedo_green", 1.5, "Uniform albedo, green: 1.5"), ("normals", 7, "Normals: 7"),
                 ("crease", 181, "Crease angle: 181"), ("threads", -1, "Threads: -1"), ("threads", 5000, "Threads: 5000"),
                 ("memory", -1, "Memory: -1"), ("albedo", 2, "has no vertex colours"), ("albedo", 3, "has no face colours")]
        for name, value, message in cases:
            with self.subTest(f"{name}={value}"):
                self.assert_message(self.apply(shipped_filter("bake", **{name: value})), message)

    def test_bake_to_a_length(self):
        for values, message in [({"refine_length": 0}, "Edge length: 0 is out of range"),
                                ({"refine_length": -1}, "Edge length: -1"),
                                ({"refine_length": 0.1, "max_vertices": 100}, "vertices")]:
            with self.subTest(values):
                self.assert_message(self.apply(shipped_filter("bake", refine=1, **values)), message)

    def test_refine(self):
        cases = [("length", 0, "Edge length: 0 is out of range"), ("length", "nan", "Edge length: nan"),
                 ("flat", -1, "Flat angle: -1"), ("crease", 181, "Crease angle: 181"),
                 ("max_vertices", 0, "Most vertices: 0"), ("threads", -1, "Threads: -1")]
        for name, value, message in cases:
            with self.subTest(f"{name}={value}"):
                self.assert_message(self.apply(shipped_filter("refine", **{name: value})), message)

    def test_relight(self):
        self.bake_there("--rays", 16)
        baked = self.folder / "there.shply"
        shutil.copy(self.folder / "there.ply", baked)
        (self.folder / "bad.shlight").write_text("{}")
        (self.folder / "bad.hdr").write_text("no image")
        cases = [({"light": 6}, "Light: 6 is out of range"), ({"light": 5}, "no file is named"),
                 ({"light": 5, "light_file": "/nowhere.hdr"}, "there is no such file"),
                 ({"light": 5, "light_file": self.folder / "bad.hdr"}, "bad.hdr"),
                 ({"light": 5, "light_file": self.folder / "bad.shlight"}, "shbake_light"),
                 ({"rotation": 1000}, "Rotation: 1000"), ({"exposure": 500}, "Exposure: 500"),
                 ({"sun_altitude": 91}, "Sun altitude: 91"), ({"sun_irradiance": -1}, "Sun irradiance: -1"),
                 ({"disc_angle": 91}, "Disc half angle: 91"), ({"ground": 2}, "Ground albedo: 2"), ({"up": 2}, "Up axis: 2"),
                 ({"tone": 3}, "Tone curve: 3"), ({"window": 5}, "Window: 5")]
        for values, message in cases:
            with self.subTest(values):
                self.assert_message(self.apply(shipped_filter("relight", **values), meshes=[baked]), message)

    def test_save(self):
        for values, message in [({"file": ""}, "no file is named"), ({"file": "/nowhere/x.ply"}, "/nowhere"),
                                ({"file": self.folder}, str(self.folder)), ({"colors": 3}, "Vertex colours: 3")]:
            with self.subTest(values):
                self.assert_message(self.apply(shipped_filter("bake", rays=16), shipped_filter("save", **values)), message)


class RealMeshes(PluginTest):
    def test_the_bunny(self):
        source = SHARED / "meshes/stanford-bunny.obj"
        if not source.exists():
            self.skipTest(f"no meshes in {SHARED}")
        bunny = self.folder / "bunny.ply"
        ply.write_mesh(bunny, *ply.read_obj(source))
        there = self.bake_there("--normals", "smooth", "--rays", 64, mesh=bunny)
        self.assertEqual(self.bake_here(meshes=[bunny], rays=64), there)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
