"""Real systems count as the model does. The program is in $FILTERING_BENCHMARK."""

import os
import re
import subprocess
import tempfile
import unittest

import study


class Counts(unittest.TestCase):
    def test_of_systems_are_those_of_the_model(self):
        results = {"synthetic": []}
        for case in study.cases():
            if case.components != study.SIZES[0] or case.across != study.SHARES[1]:
                continue
            with tempfile.NamedTemporaryFile("w", suffix=".cast") as file:
                file.write(case.text(changes=20, pause="1ms"))
                file.flush()
                output = subprocess.run(
                    [os.environ["FILTERING_BENCHMARK"], "changes", f"system={file.name}", f"nodes={case.nodes}",
                     f"broadcast={study.MEASURED_SCHEMES[case.scheme]}"],
                    check=True, stdout=subprocess.PIPE, text=True, timeout=120).stdout
            figures = {name: [float(value)] for name, value in re.findall(r"^figure (\S+) (\S+)$", output, re.MULTILINE)}
            results["synthetic"].append(dict(study.asdict(case), samples=figures))
        self.assertEqual(len(results["synthetic"]), 12)
        self.assertEqual(study.disagreements(results), [])


if __name__ == "__main__":
    unittest.main()
