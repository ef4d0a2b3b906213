#!/usr/bin/env python3
"""What the program tells of its work, in words and as JSON.

Usage: test_reports.py PROGRAM [unittest arguments]"""
import json
import os
import pty

import meshes
import program_test


class Reports(program_test.ProgramTest):
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


if __name__ == "__main__":
    program_test.main()
