#!/usr/bin/env python3
"""scripts/install puts there what works, and takes away what it has put there, and nothing else.

    tests/install/scripts_install_test.py     in a tree that scripts/run has built
"""

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent.parent


def run(*command, status=0, folder=SOURCE):
    """What the command prints, which ends with that status."""
    environment = {name: value for name, value in os.environ.items() if name != "LD_LIBRARY_PATH"}
    result = subprocess.run([str(x) for x in command], cwd=folder, env=environment, text=True, check=False,
                            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if result.returncode != status:
        raise AssertionError(f"{command} ended with {result.returncode}:\n{result.stdout}")
    return result.stdout


def tree(folder):
    """All that is below a folder."""
    return sorted(str(x.relative_to(folder)) for x in folder.rglob("*"))


class Install(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.prefix = self.folder / "a prefix"
        self.elsewhere = self.folder / "elsewhere"
        self.elsewhere.mkdir()

    def check_works(self, prefix):
        castor = prefix / "bin/castor"
        components = run(castor, "components", folder=self.elsewhere)
        for name in ("Camera", "SpatialRelater", "Binder", "UtteranceParser", "SubarchitectureWorkingMemory"):
            self.assertIn(name, components)
        self.assertNotIn("cannot load", components)
        for name in ("vision", "playmate"):
            output = run(castor, "check", f"configs/{name}.cast", folder=self.elsewhere)
            self.assertIn("no errors", output)
            self.assertIn(str(prefix / f"share/castor/configs/{name}.cast"), output)

    def test_what_is_installed_works_and_is_taken_away_again(self):
        (self.prefix / "lib").mkdir(parents=True)
        (self.prefix / "bin").mkdir()
        (self.prefix / "bin/foreign").write_text("somebody else's")
        before = tree(self.prefix)
        output = run(SOURCE / "scripts/install", "--prefix", self.prefix.name, folder=self.folder)
        export = [x for x in output.splitlines() if "export PATH=" in x]
        self.assertEqual(len(export), 1, output)
        found = run("sh", "-c", f"{export[0]}; command -v castor").strip()
        self.assertEqual(found, str(self.prefix / "bin/castor"))
        self.check_works(self.prefix)
        # A second time, over what is there.
        run(SOURCE / "scripts/install", "--prefix", self.prefix)
        self.check_works(self.prefix)
        run(SOURCE / "scripts/install", "--uninstall", "--prefix", self.prefix)
        self.assertEqual(tree(self.prefix), before)

    def test_a_folder_that_was_not_there_is_gone_again_even_if_it_has_moved(self):
        run(SOURCE / "scripts/install", "--prefix", self.prefix)
        moved = self.folder / "moved"
        self.prefix.rename(moved)
        self.check_works(moved)
        run(SOURCE / "scripts/install", "--uninstall", f"--prefix={moved}")
        self.assertFalse(moved.exists())

    def test_files_of_an_earlier_version_go_with_the_next_one(self):
        run(SOURCE / "scripts/install", "--prefix", self.prefix)
        old = self.prefix / "include/castor/old"
        old.mkdir()
        (old / "old.hpp").touch()
        manifest = self.prefix / "share/castor/install_manifest.txt"
        lines = manifest.read_text().splitlines()
        manifest.write_text("\n".join(sorted([*lines, "include/castor/old/", "include/castor/old/old.hpp"])) + "\n")
        run(SOURCE / "scripts/install", "--prefix", self.prefix)
        self.assertFalse((old / "old.hpp").exists())
        run(SOURCE / "scripts/install", "--uninstall", "--prefix", self.prefix)
        self.assertFalse(self.prefix.exists())

    def test_cmake_installs_after_scripts_run_too(self):
        run("cmake", "--install", "build/release", "--prefix", self.prefix)
        self.check_works(self.prefix)

    def test_the_command_of_the_build_tree_finds_what_comes_with_it(self):
        castor = SOURCE / "build/release/castor"
        self.assertIn("no errors", run(castor, "check", "configs/vision.cast", folder=self.elsewhere))
        self.assertIn("cannot read 'configs/nosuch.cast'",
                      run(castor, "check", "configs/nosuch.cast", status=1, folder=self.elsewhere))

    def test_what_makes_no_sense_is_refused(self):
        self.assertIn("--prefx", run(SOURCE / "scripts/install", "--prefx", "x", status=2))
        self.assertIn("--prefix takes a folder", run(SOURCE / "scripts/install", "--prefix", status=2))
        self.assertIn("install_manifest.txt", run(SOURCE / "scripts/install", "--uninstall", "--prefix",
                                                  self.elsewhere, status=2))
        (self.folder / "file").touch()
        self.assertIn("no folder that you can write to",
                      run(SOURCE / "scripts/install", "--prefix", self.folder / "file", status=2))


if __name__ == "__main__":
    unittest.main()
