#!/usr/bin/env python3
"""`shbake selftest` as a user meets it: lines, report, table, exit codes.

Usage: test_selftest.py PROGRAM [unittest arguments]"""
import json
import pathlib
import subprocess
import sys
import unittest

PROGRAM = pathlib.Path(sys.argv[1]).resolve()


def selftest(*arguments):
    return subprocess.run([PROGRAM, "selftest", "--short", *arguments], capture_output=True, text=True, check=False)


class Selftest(unittest.TestCase):
    def test_a_line_a_row_and_a_summary(self):
        result = selftest("--family", "light")
        self.assertEqual(result.returncode, 0, result.stderr)
        lines = result.stdout.splitlines()
        rows = [line for line in lines if " naive " in line]
        self.assertEqual(len(rows), 4)
        self.assertEqual(len({line.index(" naive ") for line in rows}), 1, "rows are not aligned")
        for line in rows:
            self.assertRegex(line, r"^[a-z-]+ +ok +0 of [\d,]+ +naive [\d,]+ of [\d,]+ \([\d.]+ %\)$")
        self.assertEqual(lines[-1].split(maxsplit=1), ["rows", "4 of 4 rows within their bounds"])

    def test_verbose_explains_each_row(self):
        result = selftest("--family", "light", "-v")
        self.assertEqual(result.stdout.count("shbake: "), 4)
        self.assertIn("suns of one pixel: a scene without its sun", result.stdout)

    def test_the_report_has_the_counts(self):
        result = selftest("--family", "light", "--json", "-")
        report = json.loads(result.stdout)
        self.assertEqual((report["run"], report["failed"]), (4, 0))
        row = report["rows"]["overflow"]
        self.assertEqual(row["family"], "light")
        self.assertEqual(row["verdict"], "ok")
        self.assertEqual(row["own"], {"cases": 10, "failures": 0})
        self.assertEqual(row["naive"], {"cases": 10, "failures": 10})

    def test_the_table_is_markdown_alone(self):
        lines = selftest("--family", "light", "--markdown").stdout.splitlines()
        self.assertEqual(lines[0], "### light")
        table = lines[2:]
        self.assertEqual(len(table), 6)
        for line in table:
            self.assertEqual(line.count("|"), 10, line)

    def test_an_unknown_family_is_wrong_usage(self):
        result = selftest("--family", "lihgt")
        self.assertEqual(result.returncode, 2)
        self.assertIn("'lihgt'", result.stderr)
        self.assertIn("contact", result.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
