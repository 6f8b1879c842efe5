"""The types: the stub of the compiled part agrees with it, and mypy accepts the package."""

import ast
import inspect
import os
import pathlib
import re
import subprocess
import sys

import palpa
from palpa import _core

PACKAGE = pathlib.Path(palpa.__file__).parent


def declared():
    """{"Class.function": [arguments]} of _core.pyi."""
    found = {}
    for node in ast.parse((PACKAGE / "_core.pyi").read_text()).body:
        if isinstance(node, ast.FunctionDef):
            found[node.name] = [each.arg for each in node.args.args]
        if isinstance(node, ast.ClassDef):
            found[node.name] = None
            for each in node.body:
                if isinstance(each, ast.FunctionDef):
                    found[f"{node.name}.{each.name}"] = [arg.arg for arg in each.args.args]
    return found


def arguments(function):
    """The arguments in the first line of a bound function's documentation."""
    inside = re.match(r"\w+\((.*)\) ->", function.__doc__).group(1)
    return re.findall(r"(\w+): ", re.sub(r"\[[^\]]*\]", "", inside))


def compiled():
    """The same of the module."""
    found = {}
    for name, value in vars(_core).items():
        if name.startswith("_") or name == "version":
            continue
        if not inspect.isclass(value):
            found[name] = arguments(value)
            continue
        found[name] = None
        if issubclass(value, BaseException):
            continue
        for member, function in vars(value).items():
            if not member.startswith("_"):
                found[f"{name}.{member}"] = arguments(getattr(value, member))
    return found


def test_the_stub_names_what_the_module_has():
    assert declared() == compiled()


def test_mypy_accepts_the_package():
    command = [sys.executable, "-m", "mypy", "--strict", f"--cache-dir={os.devnull}", str(PACKAGE)]
    outcome = subprocess.run(command, capture_output=True, text=True)
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr


def test_mypy_finds_wrong_calls(tmp_path):
    script = tmp_path / "wrong.py"
    script.write_text("import palpa\nmodel = palpa.sphere('wide').build()\nmodel.touch()\n")
    command = [sys.executable, "-m", "mypy", f"--cache-dir={os.devnull}", str(script)]
    outcome = subprocess.run(command, capture_output=True, text=True, env={"MYPYPATH": str(PACKAGE.parent)})
    assert "wrong.py:2" in outcome.stdout and "wrong.py:3" in outcome.stdout, outcome.stdout


def test_everything_public_is_described():
    for name in palpa.__all__:
        value = getattr(palpa, name)
        if name in ("__version__", "Load"):
            continue
        assert value.__doc__, name
        if inspect.isclass(value):
            for member, function in vars(value).items():
                if not member.startswith("_") and (callable(function) or isinstance(function, property)):
                    assert function.__doc__, f"{name}.{member}"
