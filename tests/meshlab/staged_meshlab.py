"""A private MeshLab with shbake's plugins, and a screen without hardware to run it on. Nothing needs root."""
import os
import pathlib
import shutil
import subprocess
import sysconfig
import tempfile
import time

ARCHITECTURE = sysconfig.get_config_var("MULTIARCH")
SYSTEM_LIBRARIES = pathlib.Path("/usr/lib") / ARCHITECTURE / "meshlab"


def stage(prefix, plugins):
    """Makes `prefix` hold MeshLab with its own plugins and `plugins`.

    MeshLab looks for plugins beside the folder of its executable, and follows links to find that: the executables have
    to be copies, all else is linked."""
    library = prefix / "lib" / ARCHITECTURE / "meshlab"
    (library / "plugins").mkdir(parents=True)
    (prefix / "bin").mkdir()
    (prefix / "share").mkdir()
    for program in ("meshlab", "meshlabserver"):
        shutil.copy(f"/usr/bin/{program}", prefix / "bin")
    (prefix / "share/meshlab").symlink_to("/usr/share/meshlab")
    (library / "libmeshlab-common.so").symlink_to(SYSTEM_LIBRARIES / "libmeshlab-common.so")
    for plugin in [*(SYSTEM_LIBRARIES / "plugins").glob("*.so"), *plugins]:
        # A plugin of this name may be installed; the one under test wins.
        if not (library / "plugins" / plugin.name).is_symlink() or plugin in plugins:
            (library / "plugins" / plugin.name).unlink(missing_ok=True)
            (library / "plugins" / plugin.name).symlink_to(plugin.resolve())
    return prefix


class Screen:
    """An X server without hardware, alive inside a `with` block. Its picture is read from the file it draws to."""

    def __init__(self, width=1280, height=1024):
        self.size = (width, height)

    def __enter__(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="shbake-screen-"))
        read, write = os.pipe()
        width, height = self.size
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{width}x{height}x24", "-nolisten", "tcp", "-fbdir",
             self.folder], pass_fds=[write], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as pipe:
            number = pipe.readline().strip()
        if not number:
            raise RuntimeError("Xvfb did not start")
        self.environment = {
            **os.environ, "DISPLAY": f":{number}", "QT_QPA_PLATFORM": "xcb", "LIBGL_ALWAYS_SOFTWARE": "1",
            "HOME": str(self.folder), "XDG_CONFIG_HOME": str(self.folder), "XDG_RUNTIME_DIR": str(self.folder)}
        self.folder.chmod(0o700)
        return self

    def __exit__(self, *_):
        self.server.terminate()
        self.server.wait()
        # Programs that are just ending may still write their settings.
        shutil.rmtree(self.folder, ignore_errors=True)


def run_server(prefix, screen, *arguments, cwd=None, timeout=120):
    """Runs meshlabserver; its return code and all that it printed."""
    result = subprocess.run([prefix / "bin/meshlabserver", *map(str, arguments)], env=screen.environment, cwd=cwd,
                            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            timeout=timeout)
    return result.returncode, result.stdout.decode(errors="replace")


def wait_until(condition, seconds, what):
    """Polls until `condition()` is true and returns its value; fails with `what` when it takes longer."""
    end = time.monotonic() + seconds
    while True:
        value = condition()
        if value:
            return value
        if time.monotonic() > end:
            raise AssertionError(f"waited {seconds} s in vain for {what}")
        time.sleep(0.05)
