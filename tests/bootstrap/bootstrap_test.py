"""./bootstrap with stand-ins for the programs it calls: what does each verb install, configure, build?

    bootstrap_test.py --source ROOT
"""
import argparse
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

parser = argparse.ArgumentParser()
parser.add_argument("--source", type=Path, required=True)
given, others = parser.parse_known_args()

CONFIGURED_WITHOUT_TESTS = "BALLBOT_BUILD_TESTS:BOOL=OFF\n"
CONFIGURED_WITH_TESTS = "BALLBOT_BUILD_TESTS:BOOL=ON\n"


class Bootstrap(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="ballbot-bootstrap-"))
        self.addCleanup(shutil.rmtree, self.folder)
        for name in ("bootstrap", "packages.txt"):
            shutil.copy(given.source / name, self.folder)
        self.log = self.folder / "log"
        self.standIn("bin/dpkg-query", "exit 1")  # nothing is installed
        for name in ("apt-get", "cmake", "ctest"):
            self.standIn(f"bin/{name}", f'echo {name} "$@" >>{self.log}')
        self.standIn("bin/id", "echo 0")
        self.standIn("build/release/bin/ballbot", f'echo ballbot "$@" >>{self.log}')

    def standIn(self, name, does):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f"#!/bin/sh\n{does}\n")
        path.chmod(0o755)

    def configure(self, cache):
        (self.folder / "build/release/build.ninja").touch()
        (self.folder / "build/release/CMakeCache.txt").write_text(cache)

    def calls(self, *verb):
        """What ./bootstrap VERB calls, one line a call."""
        environment = dict(os.environ, PATH=f"{self.folder}/bin:/usr/bin:/bin")
        subprocess.run([self.folder / "bootstrap", *verb], env=environment, check=True, stderr=subprocess.DEVNULL)
        return [c for c in self.log.read_text().splitlines() if not c.endswith("--version")]

    def test_a_run_installs_no_package_of_the_tests(self):
        installed = next(c for c in self.calls("run") if "install" in c)
        self.assertIn(" libsimbody-dev", installed)
        for word in ("gtest", "benchmark", "mujoco", "slurm", "chromium", "python3-can", "@test"):
            self.assertNotIn(word, installed)

    def test_the_tests_install_all_packages(self):
        installed = next(c for c in self.calls("test") if "install" in c)
        for word in (" libsimbody-dev", " libgtest-dev", " libbenchmark-dev", " libmujoco-dev", " slurm-wlm"):
            self.assertIn(word, installed)
        self.assertNotIn("@test", installed)

    def test_a_run_configures_and_builds_the_program_alone(self):
        calls = [c for c in self.calls("run", "S.yaml", "--seed", "7") if not c.startswith("apt-get")]
        self.assertEqual(calls, [
            "cmake --preset release -DBALLBOT_BUILD_TESTS=OFF -DBALLBOT_BUILD_BENCHMARKS=OFF",
            "cmake --build --preset release --target ballbot",
            "ballbot run S.yaml --seed 7"])

    def test_a_second_run_configures_nothing(self):
        self.configure(CONFIGURED_WITHOUT_TESTS)
        self.assertNotIn("cmake --preset", "\n".join(self.calls("run")))

    def test_the_tests_after_a_run_are_configured_and_all_is_built(self):
        self.configure(CONFIGURED_WITHOUT_TESTS)
        calls = [c for c in self.calls("test", "-L", "unit") if not c.startswith("apt-get")]
        self.assertEqual(calls, [
            "cmake --preset release -DBALLBOT_BUILD_TESTS=ON -DBALLBOT_BUILD_BENCHMARKS=ON",
            "cmake --build --preset release",
            "ctest --preset release -L unit"])

    def test_a_run_after_the_tests_leaves_them_configured(self):
        self.configure(CONFIGURED_WITH_TESTS)
        calls = [c for c in self.calls("run") if c.startswith("cmake")]
        self.assertEqual(calls, ["cmake --build --preset release --target ballbot"])

    def test_build_makes_what_an_fmu_is_made_of(self):
        self.assertIn("cmake --build --preset release --target ballbot ballbot_fmi2_bundle ballbot_fmi3_bundle",
                      self.calls("build"))


if __name__ == "__main__":
    unittest.main(argv=["bootstrap_test", "-v", *others])
