"""What `seiche schema` refuses, `seiche check` refuses, and what runs, the schema takes: schema_test.py PROGRAM CASES"""
import copy
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib
import unittest

import jsonschema

PROGRAM, CASES = sys.argv[1], pathlib.Path(sys.argv[2])
SCHEMA = json.loads(subprocess.run([PROGRAM, "schema"], capture_output=True, check=True).stdout)
VALIDATOR = jsonschema.Draft7Validator(SCHEMA)


def printed(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, check=True, text=True).stdout


def toml(case):
    def value(v):
        return "{ " + ", ".join(f"{k} = {value(w)}" for k, w in v.items()) + " }" if isinstance(v, dict) else json.dumps(v)

    return "".join(f"[{name}]\n" + "".join(f"{k} = {value(v)}\n" for k, v in keys.items()) for name, keys in case.items())


def complaints(case):
    return [error.message for error in VALIDATOR.iter_errors(case)]


class Schema(unittest.TestCase):
    def test_is_a_schema(self):
        jsonschema.Draft7Validator.check_schema(SCHEMA)

    def test_takes_every_case_of_the_repository(self):
        files = sorted(CASES.glob("*.toml"))
        self.assertGreater(len(files), 30)
        for file in files:
            with self.subTest(file.name):
                self.assertEqual(complaints(tomllib.loads(file.read_text(encoding="utf-8"))), [])

    def test_takes_the_example_of_every_problem_with_all_its_keys(self):
        for problem in json.loads(printed("list", "problems", "--json")):
            text = printed("new", problem["name"])
            sections = text[text.index("\n[method]"):]
            every_key = text[:text.index("\n[method]")] + re.sub(r"^# (?=\[|\w+ = )", "", sections, flags=re.MULTILINE)
            for case in (text, every_key):
                with self.subTest(problem["name"]):
                    self.assertEqual(complaints(tomllib.loads(case)), [])

    def test_knows_every_key_of_a_case(self):
        case = tomllib.loads(printed("new", "klein_gordon"))
        for section, keys in case.items():
            if section != "problem":
                self.assertLessEqual(set(keys), set(SCHEMA["properties"][section]["properties"]))

    def test_has_defaults_that_it_takes(self):
        checked = 0
        for section in SCHEMA["properties"]["problem"]["allOf"] + list(SCHEMA["properties"].values()):
            for key, row in section.get("then", section).get("properties", {}).items():
                if "default" in row:
                    with self.subTest(key):
                        jsonschema.Draft7Validator(row).validate(row["default"])
                        checked += 1
        self.assertGreater(checked, 50)

    def test_refuses_what_the_program_refuses(self):
        good = {"problem": {"name": "klein_gordon", "points": 16}, "method": {"name": "egc4", "h": 0.125}, "time": {"end": 1.0}}
        mistakes = [
            ("problem", "name", "klein_gorden"), ("problem", "alhpa", 1.0), ("problem", "points", 1), ("problem", "points", True),
            ("problem", "boundary", "absorbing"), ("problem", "discretisation", "fd3"), ("problem", "initial", "sech"),
            ("method", "name", "rk4"), ("method", "h", 0), ("method", "h", -0.5), ("method", "tolerance", 0), ("method", "dt", 0.1),
            ("method", "law", "strong"), ("backend", "plan", "patient"), ("backend", "pade_degree", -1), ("time", "start", -1.0),
            ("time", "end", 0), ("output", "energy_every", 0), ("output", "energy_every", 1.5), ("output", "ledger", True),
            ("output", "directory", 3), ("checkpoint", "keep", 3), ("checkpoint", "every_seconds", -1), ("ensemble", "members", 0),
            ("ensemble", "alpha", 0.5), ("meethod", "h", 0.125), ("problem", "alpha", "one"), ("problem", "gamma", [0.1]),
            ("problem", "friction", {"kind": "quadratc", "coefficient": 0.1}), ("problem", "friction", {"kind": "tanh"}),
            ("problem", "friction", {"kind": "dry", "coefficient": 0.1, "width": 1.0}),
            ("problem", "friction", {"kind": "dry", "coefficient": -0.1}), ("problem", "force", [1.0]),
        ]
        self.assertEqual(complaints(good), [])
        for section, key, value in mistakes:
            bad = copy.deepcopy(good)
            bad.setdefault(section, {})[key] = value
            text = toml(bad)
            with self.subTest(f"{section}.{key} = {value}"), tempfile.TemporaryDirectory() as folder:
                self.assertNotEqual(complaints(bad), [])
                file = pathlib.Path(folder) / "case.toml"
                file.write_text(text, encoding="utf-8")
                self.assertEqual(subprocess.run([PROGRAM, "check", str(file)], capture_output=True).returncode, 2, text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
