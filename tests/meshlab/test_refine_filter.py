#!/usr/bin/env python3
"""The filter that refines flat regions, and bakes that refine, called by meshlabserver: what the program makes.

Usage: test_refine_filter.py PLUGIN PROGRAM SHARED_DIR [unittest arguments]"""
import ply
from filter_scripts import shipped_filter
from plugin_test import PluginTest, main, rainbow, sphere_over_floor


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

    def test_wrong_values(self):
        cases = [("length", 0, "Edge length: 0 is out of range"), ("length", "nan", "Edge length: nan"),
                 ("flat", -1, "Flat angle: -1"), ("crease", 181, "Crease angle: 181"),
                 ("max_vertices", 0, "Most vertices: 0"), ("threads", -1, "Threads: -1")]
        for name, value, message in cases:
            with self.subTest(f"{name}={value}"):
                self.assert_message(self.apply(shipped_filter("refine", **{name: value})), message)


if __name__ == "__main__":
    main()
