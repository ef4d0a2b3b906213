#!/usr/bin/env python3
"""What the program answers to wrong usage, and to questions for help.

Usage: test_usage.py PROGRAM [unittest arguments]"""
import re

import program_test


class Usage(program_test.ProgramTest):
    def test_wrong_usage_ends_with_2_and_one_line(self):
        cases = [
            (["bkae"], "unknown verb bkae", "did you mean bake?"),
            (["--frobnicate"], "unknown option --frobnicate"),
            (["bake"], "no mesh"),
            (["bake", "box.obj"], "no output"),
            (["bake", "box.obj", "-o", "out.ply", "--ordre", "3"], "--ordre", "did you mean --order?"),
            (["bake", "box.obj", "-o", "out.ply", "--order=99"], "--order: 99 is out of range"),
            (["bake", "box.obj", "-o", "out.ply", "--order", "0"], "--order: 0 is out of range"),
            (["bake", "box.obj", "-o", "out.ply", "--order", "four"], "'four' is not a whole number"),
            (["bake", "box.obj", "-o", "out.ply", "--order"], "--order needs a value"),
            (["bake", "box.obj", "-o", "out.ply", "--rays", "-5"], "--rays: -5 is out of range"),
            (["bake", "box.obj", "-o", "out.ply", "--rays", "1e9"], "'1e9' is not a whole number"),
            (["bake", "box.obj", "-o", "out.ply", "--tolerance", "0"], "--tolerance: 0 is out of range"),
            (["bake", "box.obj", "-o", "out.ply", "--bounces", "some"], "'some' is not a whole number"),
            (["bake", "box.obj", "-o", "out.ply", "--albedo", "2"], "--albedo: 2 is out of range"),
            (["bake", "box.obj", "-o", "out.ply", "--albedo", "red"], "'red' is not a colour"),
            (["bake", "box.obj", "-o", "out.ply", "--normals", "flt"], "did you mean flat?"),
            (["bake", "box.obj", "-o", "out.ply", "--memory", "lots"], "'lots' is not a size"),
            (["bake", "box.obj", "-o", "out.ply", "--max-distance", "0"], "--max-distance: 0 is out of range"),
            (["bake", "box.obj", "-o", "out.ply", "--threads", "-1"], "--threads: -1 is out of range"),
            (["bake", "box.obj", "-o", "out.ply", "--seed", "-1"], "--seed: -1 is out of range"),
            (["bake", "box.obj", "-o", "out.ply", "-q", "-v"], "contradict"),
            (["bake", "box.obj", "more.obj", "-o", "out.ply"], "'more.obj' is one argument too many"),
            (["bake", "--blockers", "box.obj", "-o", "out.ply"], "no mesh", "before --blockers"),
            (["bake", "box.obj", "-o", "out.obj"], "out.obj", ".ply"),
            (["bake", "box.obj", "-o", ""], "no output"),
            (["info"], "no file"),
            (["compare", "a.ply"], "two files"),
            (["bake", "-o", "out.ply", "--surface-error", "box.obj"], "'box.obj' is not a number of samples",
             "before the option"),
            (["bake", "box.obj", "-o", "out.ply", "--surface-error", "7"], "--surface-error: 7 is out of range"),
            (["compare", "a.ply", "b.ply", "--surface"], "one file", "usage: shbake compare A --surface"),
            (["compare", "--surface", "a.ply"], "'a.ply' is not a number of samples"),
        ]
        for arguments, *parts in cases:
            with self.subTest(" ".join(arguments)):
                result = self.run_program(*arguments)
                self.assertEqual(result.code, 2, result.stderr)
                self.assert_one_line(result.stderr, *parts)
                self.assertEqual(result.stdout, "")
        self.assert_left()

    def test_no_arguments_print_the_help_as_an_error(self):
        result = self.run_program()
        self.assertEqual((result.code, result.stdout), (2, ""))
        self.assertIn("Usage: shbake VERB", result.stderr)

    def test_help_and_version_go_to_stdout(self):
        self.assertRegex(self.run_program("--version").stdout, r"\Ashbake \d+\.\d+\.\d+\n\Z")
        result = self.run_program("--help")
        self.assertEqual((result.code, result.stderr), (0, ""))
        self.assertEqual(result.stdout, self.run_program("-h").stdout)

    def test_help_of_every_verb_tells_defaults_and_fits_80_columns(self):
        verbs = re.findall(r"^  (\w+)  +\w", self.run_program("--help").stdout, re.M)
        self.assertIn("bake", verbs)
        # What these name or add is absent unless they are given.
        without_default = {"--help", "--output", "--json", "--blockers", "--disc", "--parallel", "--constant",
                           "--gradient", "--sample", "--turn", "--shadow", "--multiply", "--at", "--length", "--family"}
        for verb in verbs:
            with self.subTest(verb):
                result = self.run_program(verb, "--help")
                self.assertEqual((result.code, result.stderr), (0, ""))
                self.assertLessEqual(max(map(len, result.stdout.splitlines())), 80)
                options = re.split(r"\n(?=  -)", result.stdout.split("\nOptions:\n")[1])
                self.assertGreater(len(options), 4)
                for option in options:
                    name = re.search(r"--[a-z-]+", option)[0]
                    if name not in without_default:
                        self.assertIn("(default:", " ".join(option.split()), name)


if __name__ == "__main__":
    program_test.main()
