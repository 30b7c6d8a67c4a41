"""NOTICE names everything that the program, its FMUs and its pages bring along.

    notice_test.py --source ROOT --bin build/release/bin --fmu-libraries build/release/lib/ballbot/fmu
"""
import argparse
import json
import re
import subprocess
import unittest
from pathlib import Path

parser = argparse.ArgumentParser()
parser.add_argument("--source", type=Path, required=True)
parser.add_argument("--bin", type=Path, required=True)
parser.add_argument("--fmu-libraries", type=Path, required=True)
given, others = parser.parse_known_args()

# The C and C++ runtime, which every Linux has and no FMU carries.
RUNTIME = {"libc", "libm", "libstdc++", "libgcc_s"}


def stem(library):
    """libfmt.so.9 -> libfmt; ballbot- in front is the name that copies in an FMU have."""
    return re.sub(r"\.so.*", "", library.removeprefix("ballbot-"))


def neededBy(program):
    text = subprocess.run(["readelf", "-d", program], stdout=subprocess.PIPE, text=True, check=True).stdout
    return {stem(name) for name in re.findall(r"\(NEEDED\).*\[(lib[^\]]*)\]", text)} - RUNTIME


class Notice(unittest.TestCase):
    words = set(re.split(r"[\s,]+", (given.source / "NOTICE").read_text()))

    def assertNamed(self, names):
        self.assertTrue(names)
        self.assertEqual(sorted(names - self.words), [], "not in NOTICE")

    def test_names_every_library_of_the_program(self):
        self.assertNamed(neededBy(given.bin / "ballbot"))

    def test_names_every_library_inside_an_fmu(self):
        for version in ("fmi2", "fmi3"):
            files = (given.fmu_libraries / version / "binaries").glob("ballbot-lib*")
            self.assertNamed({stem(path.name) for path in files})

    def test_names_every_package_of_the_pages(self):
        self.assertNamed(set(json.loads((given.source / "viewer/package.json").read_text())["dependencies"]))

    def test_goes_with_every_fmu(self):
        for version in ("fmi2", "fmi3"):
            for name in ("LICENSE", "NOTICE"):
                copy = given.fmu_libraries / version / "licenses" / f"ballbot-{name}.txt"
                self.assertEqual(copy.read_text(), (given.source / name).read_text())


if __name__ == "__main__":
    unittest.main(argv=["notice_test", "-v", *others])
