#!/usr/bin/env python3
"""Lists the test cases of a Catch2 program as ctest tests: discover_tests.py PROGRAM LAYER OUTPUT.

Catch2's own CMake module passes names through CMake lists, where a semicolon or a bracket in a name cuts it or joins it
with others; such a test then runs nothing and passes."""
import pathlib
import re
import subprocess
import sys


def as_filter(name):
    """The filter that matches exactly this test case: Catch2 gives a meaning to some characters unless escaped."""
    return re.sub(r'([\\,\[\]"])', r"\\\1", name)


def quoted(text):
    """A CMake bracket argument, in which nothing has a meaning."""
    return f"[====[{text}]====]"


def main():
    program, layer, output = sys.argv[1:]
    # The exit code of this option is the number of test cases.
    listing = subprocess.run([program, "--list-test-names-only"], stdout=subprocess.PIPE, text=True, check=False).stdout
    names = listing.splitlines()
    if not names:
        sys.exit(f"{program}: lists no test cases; does it start?")
    lines = [f"add_test({quoted(f'{layer}: {name}')} {quoted(program)} {quoted(as_filter(name))} --warn NoTests)\n"
             for name in names]
    pathlib.Path(output).write_text("".join(lines))


if __name__ == "__main__":
    main()
