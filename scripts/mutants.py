#!/usr/bin/env python3
"""Makes deliberate mistakes in the library, one at a time, and sees whether the tests notice.

Usage: mutants.py --check             each mistake still fits the code exactly once, and its tests exist
       mutants.py [NAME...]           make all of them, or those named, and run their tests
                  [--scratch FOLDER]  where the copy of the project and its build are kept (default: a new one, removed
                                      at the end); given again, a build is not begun anew

The mistakes are listed in mutants.toml beside this file. They are made in a copy of the project, never in the project
itself. Exits with 1 when a mistake survives its tests, does not fit, does not compile, or its tests fail without it.
Behind each verdict stands the CPU time that it took, of all cores together."""
import argparse
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
LIST = pathlib.Path(__file__).resolve().with_name("mutants.toml")
# What a build needs; other folders of the project are copied too where the build includes them.
LEFT_OUT = shutil.ignore_patterns(".git", "build", "images", "__pycache__")


def load():
    return tomllib.loads(LIST.read_text())["mutant"]


def cases_of(layer):
    """The names of all test cases of a layer, as they stand in its sources."""
    names = set()
    for path in (ROOT / "tests" / layer).glob("*.cpp"):
        # A name may be broken into several literals.
        for literals in re.findall(r'TEST_CASE\(\s*((?:"(?:[^"\\]|\\.)*"\s*)+)', path.read_text()):
            names.add("".join(re.findall(r'"((?:[^"\\]|\\.)*)"', literals)))
    return names


def faults_of(mutant):
    """What keeps a mutant from being made, one sentence each."""
    path = ROOT / mutant["file"]
    if not path.is_file():
        return [f"{mutant['file']} does not exist"]
    faults = []
    found = path.read_text().count(mutant["find"])
    if found != 1:
        faults.append(f"its text stands {found} times in {mutant['file']}, not once")
    if mutant["find"] == mutant["replace"]:
        faults.append("it changes nothing")
    for test in mutant["tests"]:
        layer, _, name = test.partition(": ")
        if name not in cases_of(layer):
            faults.append(f"there is no test '{test}'")
    if not mutant["tests"]:
        faults.append("it names no test")
    return faults


def check(mutants):
    bad = 0
    names = [m["name"] for m in mutants]
    for mutant in mutants:
        faults = faults_of(mutant)
        if names.count(mutant["name"]) != 1:
            faults.append("another has its name")
        for fault in faults:
            print(f"{mutant['name']}: {fault}")
        bad += bool(faults)
    print(f"mutants: {len(mutants)} listed, {bad} do not fit")
    return 1 if bad or not mutants else 0


class Workshop:
    """A copy of the project with a build of its own."""

    def __init__(self, folder):
        self.tree, self.build = folder / "tree", folder / "build"
        self.jobs = str(os.cpu_count() or 1)

    def prepare(self):
        self.copy()
        subprocess.run(["cmake", "-S", self.tree, "-B", self.build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        f"-DSHBAKE_SHARED_DIR={ROOT.parent / 'shared'}"], check=True, stdout=subprocess.DEVNULL)

    def copy(self):
        """Brings the copy up to date; files that are the same keep their time, so that they are not compiled again."""
        wanted = set()
        with tempfile.TemporaryDirectory(prefix="shbake-mutants-copy-") as fresh:
            source = pathlib.Path(fresh) / "tree"
            shutil.copytree(ROOT, source, ignore=LEFT_OUT)
            for path in source.rglob("*"):
                if not path.is_file():
                    continue
                target = self.tree / path.relative_to(source)
                wanted.add(target)
                if target.is_file() and target.read_bytes() == path.read_bytes():
                    continue
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(path, target)
        for path in list(self.tree.rglob("*")):
            if path.is_file() and path not in wanted:
                path.unlink()

    def make(self, layers):
        """Builds the test programs of some layers; the compiler's last words where that fails."""
        result = subprocess.run(["ninja", "-C", self.build, "-j", self.jobs, *[f"test_{layer}" for layer in layers]],
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        return None if result.returncode == 0 else result.stdout[-2000:]

    def passes(self, test):
        """Whether a test case passes; a test that does not end, as a mistake may make it, does not."""
        layer, _, name = test.partition(": ")
        pattern = re.sub(r'([\\,\[\]"])', r"\\\1", name)
        program = self.build / "tests" / layer / f"test_{layer}"
        try:
            result = subprocess.run([program, pattern, "--warn", "NoTests"], stdout=subprocess.DEVNULL,
                                    stderr=subprocess.DEVNULL, cwd=self.build, timeout=600, check=False)
        except subprocess.TimeoutExpired:
            return False
        return result.returncode == 0

    def verdict(self, mutant):
        """What is wrong with a mutant, or None where each of its tests fails. What it changed is changed back, but not
        built again: the next build does that along with its own."""
        path = self.tree / mutant["file"]
        right = path.read_text()
        try:
            path.write_text(right.replace(mutant["find"], mutant["replace"]))
            failure = self.make(layers_of([mutant]))
            if failure:
                return "does not compile:\n" + failure
            survived = [test for test in mutant["tests"] if self.passes(test)]
            return "survived " + ", ".join(f"'{test}'" for test in survived) if survived else None
        finally:
            path.write_text(right)


def layers_of(mutants):
    return sorted({test.partition(": ")[0] for mutant in mutants for test in mutant["tests"]})


def cpu_seconds():
    """What all programs that have ended took so far, on all cores together."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def run(mutants, folder):
    workshop = Workshop(folder)
    workshop.prepare()
    faults = {mutant["name"]: faults_of(mutant) for mutant in mutants}
    fitting = [mutant for mutant in mutants if not faults[mutant["name"]]]
    failure = workshop.make(layers_of(fitting)) if fitting else None
    if failure:
        print("mutants: the tests cannot be built, even without a mistake:\n" + failure)
        return 1
    failing = {test for mutant in fitting for test in mutant["tests"] if not workshop.passes(test)}
    width = max(len(m["name"]) for m in mutants)
    state = "tests fail" if failing else "tests pass"
    print(f"{'without a mistake':{width}}  {state}, {cpu_seconds():.0f} s", flush=True)
    bad = 0
    for mutant in mutants:
        before = cpu_seconds()
        faults[mutant["name"]] += [f"'{test}' fails without it" for test in mutant["tests"] if test in failing]
        problem = "; ".join(faults[mutant["name"]]) or workshop.verdict(mutant)
        bad += problem is not None
        print(f"{mutant['name']:{width}}  {problem or 'killed'}, {cpu_seconds() - before:.0f} s", flush=True)
    print(f"mutants: {len(mutants) - bad} of {len(mutants)} killed, {cpu_seconds() / 60:.1f} min of CPU time")
    return 1 if bad else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--scratch", type=pathlib.Path)
    options = parser.parse_args()
    mutants = load()
    unknown = set(options.names) - {m["name"] for m in mutants}
    if unknown:
        parser.error(f"no mutant is called {', '.join(sorted(unknown))}")
    if options.names:
        mutants = [m for m in mutants if m["name"] in options.names]
    if options.check:
        return check(mutants)
    if options.scratch:
        if options.scratch.resolve().is_relative_to(ROOT):
            parser.error("the scratch folder must lie outside of the project")
        options.scratch.mkdir(parents=True, exist_ok=True)
        return run(mutants, options.scratch.resolve())
    with tempfile.TemporaryDirectory(prefix="shbake-mutants-") as folder:
        return run(mutants, pathlib.Path(folder))


if __name__ == "__main__":
    sys.exit(main())
