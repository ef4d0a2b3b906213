#!/usr/bin/env python3
"""The filter that bakes, called by meshlabserver: the bytes of the program, or a clear message.

Usage: test_bake_filter.py PLUGIN PROGRAM SHARED_DIR [unittest arguments]"""
import ply
import staged_meshlab
from filter_scripts import shipped_filter, stock_filter
from plugin_test import SHARED, PluginTest, main, rainbow, sphere_over_floor

# Transforms of a layer, row by row: a quarter turn about x, which keeps floats what they are, and one with a shift.
QUARTER_TURN = [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1]
TURN_AND_SHIFT = [1, 0, 0, 3, 0, 0, -1, 0, 0, 1, 0, -2, 0, 0, 0, 1]


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
            ({"albedo": 1, "albedo_uniform": "0.7, 0.33,0.1", "rays": 32}, ["--albedo", "0.7,0.33,0.1", "--rays", 32]),
            ({"albedo_uniform": "0.4", "surface_samples": 100, "rays": 32},
             ["--albedo", "0.4", "--surface-error", 100, "--rays", 32]),
            ({"max_distance": 0.9, "two_sided": True, "rays": 32, "order": 8},
             ["--max-distance", 0.9, "--two-sided", "--rays", 32, "--order", 8]),
        ]
        for values, options in cases:
            with self.subTest(values):
                self.assertEqual(self.bake_here(**values), self.bake_there("--normals", "smooth", *options))

    def test_as_many_bands_as_a_light_needs(self):
        self.program("light", "-o", "lamp.shlight", "--disc", "1,2,1,60,9,6,3", "--order", 8, "-q")
        lamp = self.folder / "lamp.shlight"
        orders = set()
        for light, values in [("overcast", {}), ("clear", {}), ("partly-cloudy", {}), ("white", {}), (lamp, {"tolerance": 0.2})]:
            with self.subTest(light):
                options = ["--tolerance", 0.2] if values else ["--rays", 64]
                there = self.bake_there("--normals", "smooth", "--light", light, *options)
                self.assertEqual(self.bake_here(light=light, **(values or {"rays": 64})), there)
                orders.add(sum(name.startswith("sh_") for name in ply.read_columns(self.folder / "here.ply")))
        self.assertGreater(len(orders), 1, "all lights need as many bands")

    def test_the_surface_error_is_told(self):
        code, text = self.apply(shipped_filter("bake", rays=32, surface_samples=100))
        self.assertEqual(code, 0, text)
        self.assertIn("surface error: ", text)

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


class BakeWrongValues(PluginTest):
    def test_single_values(self):
        cases = [("order", 0, "Order: 0 is out of range"), ("order", 9, "Order: 9"), ("rays", -1, "Rays: -1"),
                 ("rays", 1048577, "Rays: 1048577"), ("tolerance", 0.00001, "Tolerance: 1e-05"), ("tolerance", -1, "Tolerance: -1"), ("tolerance", 2, "Tolerance: 2"),
                 ("tolerance", "nan", "Tolerance: nan"), ("bounces", -2, "Reflections: -2"),
                 ("max_distance", -1, "Maximum distance: -1"), ("seed", -1, "Seed: -1"), ("transfer", 4, "Transfer: 4"),
                 ("fit", 4, "Fit: 4"), ("refine", 4, "Refine flat regions: 4"), ("flat", 46, "Flat angle: 46"),
                 ("max_vertices", 0, "Most vertices: 0"),
                 ("transfer", -1, "Transfer: -1"), ("albedo", 4, "Albedo from: 4"),
                 ("albedo_uniform", "0.3,1.5,0", "Uniform albedo: 1.5"),
                 ("albedo_uniform", "0.3,0.5", "Uniform albedo: '0.3,0.5' is not understood"),
                 ("albedo_uniform", "", "Uniform albedo: '' is not understood"),
                 ("albedo_uniform", "0.5,", "Uniform albedo: '0.5,' is not understood"),
                 ("albedo_uniform", "nan", "Uniform albedo: nan"), ("surface_samples", 15, "Surface samples: 15"),
                 ("surface_samples", -1, "Surface samples: -1"), ("surface_samples", 1048577, "Surface samples: 1048577"),
                 ("light", "sunny", "sunny: there is no such file"), ("normals", 7, "Normals: 7"),
                 ("crease", 181, "Crease angle: 181"), ("threads", -1, "Threads: -1"), ("threads", 5000, "Threads: 5000"),
                 ("memory", -1, "Memory: -1"), ("albedo", 2, "has no vertex colours"), ("albedo", 3, "has no face colours")]
        for name, value, message in cases:
            with self.subTest(f"{name}={value}"):
                self.assert_message(self.apply(shipped_filter("bake", **{name: value})), message)

    def test_lengths(self):
        for values, message in [({"refine_length": 0}, "Edge length: 0 is out of range"),
                                ({"refine_length": -1}, "Edge length: -1"),
                                ({"refine_length": 0.1, "max_vertices": 100}, "vertices")]:
            with self.subTest(values):
                self.assert_message(self.apply(shipped_filter("bake", refine=1, **values)), message)


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
    main()
