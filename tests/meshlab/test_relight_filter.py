#!/usr/bin/env python3
"""The filters that relight and save, and the format, called by meshlabserver: what the program makes, or a clear message.

Usage: test_relight_filter.py PLUGIN PROGRAM SHARED_DIR [unittest arguments]"""
import shutil

import ply
import staged_meshlab
from filter_scripts import shipped_filter
from plugin_test import SHARED, PluginTest, main


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

    def test_wrong_values(self):
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

    def test_wrong_values_of_a_save(self):
        for values, message in [({"file": ""}, "no file is named"), ({"file": "/nowhere/x.ply"}, "/nowhere"),
                                ({"file": self.folder}, str(self.folder)), ({"colors": 3}, "Vertex colours: 3")]:
            with self.subTest(values):
                self.assert_message(self.apply(shipped_filter("bake", rays=16), shipped_filter("save", **values)), message)


if __name__ == "__main__":
    main()
