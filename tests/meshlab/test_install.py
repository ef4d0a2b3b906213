#!/usr/bin/env python3
"""The installed plugins, the packages, and ./shbake meshlab.

Usage: test_install.py BUILD_FOLDER CMAKE PROGRAM [unittest arguments]"""
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

BUILD, CMAKE, PROGRAM = (pathlib.Path(p).resolve() for p in sys.argv[1:4])
ROOT = pathlib.Path(__file__).resolve().parents[2]
PLUGINS = f"lib/{staged_meshlab.ARCHITECTURE}/meshlab/plugins"
MODULE = f"lib/{staged_meshlab.ARCHITECTURE}/meshlab/lib/shbake/libshbake_map_file.so"


class Installing(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="shbake-install-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.prefix = self.folder / "prefix"

    def install(self):
        subprocess.run([CMAKE, "--install", BUILD, "--component", "meshlab", "--prefix", self.prefix], check=True,
                       stdout=subprocess.DEVNULL)

    def test_installed_plugins_work_with_the_module_installed_beside_them(self):
        staged = staged_meshlab.stage(self.folder / "staged", [])
        subprocess.run([CMAKE, "--install", BUILD, "--component", "meshlab", "--prefix", staged], check=True,
                       stdout=subprocess.DEVNULL)
        self.assertTrue((staged / PLUGINS / "librender_shrelight.so").is_file())
        mesh, image = self.folder / "mesh.ply", self.folder / "light.hdr"
        ply.write_mesh(mesh, [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
        image.write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n" + bytes([128, 128, 128, 129]) * 32)
        script = filter_scripts.write_script(self.folder / "script.mlx", shipped_filter("bake", rays=16),
                                             shipped_filter("relight", light=5, light_file=image))
        with staged_meshlab.Screen() as screen:
            screen.environment["LD_DEBUG"] = "files"
            code, text = staged_meshlab.run_server(staged, screen, "-i", mesh, "-s", script)
        self.assertEqual(code, 0)
        self.assertIn(f"calling init: {staged / MODULE}", text)
        self.assertNotIn("Problem with filter", text)

    def test_uninstalling_leaves_nothing(self):
        (self.prefix / "lib").mkdir(parents=True)
        self.install()
        self.assertTrue((self.prefix / MODULE).is_file())
        subprocess.run([ROOT / "shbake", "meshlab", "uninstall", "--prefix", self.prefix], check=True,
                       stderr=subprocess.DEVNULL)
        self.assertEqual([p for p in self.prefix.rglob("*") if not p.is_dir()], [])
        again = subprocess.run([ROOT / "shbake", "meshlab", "uninstall", "--prefix", self.prefix], text=True,
                               stderr=subprocess.PIPE, stdout=subprocess.PIPE)
        self.assertEqual(again.returncode, 1)
        self.assertIn("there are no plugins", again.stderr)

    def test_wrong_usage(self):
        for arguments, message in [([], "no action"), (["frob"], "unknown action frob"), (["build", "x"], "argument x"),
                                   (["install", "--prefix"], "--prefix needs")]:
            with self.subTest(arguments):
                result = subprocess.run([ROOT / "shbake", "meshlab", *arguments], text=True, stderr=subprocess.PIPE,
                                        stdout=subprocess.PIPE)
                self.assertEqual(result.returncode, 2)
                self.assertIn(message, result.stderr)

    def test_packages(self):
        subprocess.run([CMAKE.with_name("cpack"), "--config", BUILD / "CPackConfig.cmake", "-B", self.folder / "packages"],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        packages = {p.name.split("_")[0]: p for p in (self.folder / "packages").glob("*.deb")}
        self.assertEqual(sorted(packages), ["meshlab-plugin-shbake", "shbake"])

        def told(package, field):
            return subprocess.check_output(["dpkg-deb", "-f", packages[package], field], text=True).strip()

        def files(package):
            lines = subprocess.check_output(["dpkg-deb", "-c", packages[package]], text=True).splitlines()
            return [line.split()[5].removeprefix(".") for line in lines]

        self.assertIn("meshlab (>= 2020.09), meshlab (<< 2020.10)", told("meshlab-plugin-shbake", "Depends"))
        self.assertIn("libembree3", told("shbake", "Depends"))
        for name in (f"/usr/{PLUGINS}/libfilter_shbake.so", f"/usr/{PLUGINS}/librender_shrelight.so", f"/usr/{MODULE}"):
            self.assertIn(name, files("meshlab-plugin-shbake"))
        self.assertIn("/usr/bin/shbake", files("shbake"))
        self.assertIn("/usr/lib/shbake/libshbake_map_file.so", files("shbake"))
        # Both can be installed at once.
        both = [f for f in files("shbake") if f in files("meshlab-plugin-shbake") and not f.endswith("/")]
        self.assertEqual(both, [])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
