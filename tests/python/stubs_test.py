"""Types and names of the package: the stubs are what is there, mypy accepts package and examples, importing is light, and
public_names.txt lists every public name with its parameters.

    PYTHONPATH=build/python /usr/bin/python3 tests/python/stubs_test.py             # run
    PYTHONPATH=build/python /usr/bin/python3 tests/python/stubs_test.py --write     # write public_names.txt anew
"""
import ast
import difflib
import importlib
import importlib.util
import inspect
import os
import pathlib
import subprocess
import sys
import tempfile
import types
import typing
import unittest

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
TABLE = HERE / "public_names.txt"
DUNDERS = ("__dlpack__", "__dlpack_device__", "__enter__", "__exit__", "__getitem__", "__iter__", "__len__")


def package_folder():
    """Where airsim360 is found; not imported for that."""
    return pathlib.Path(next(iter(importlib.util.find_spec("airsim360").submodule_search_locations)))


# What pybind11 says of parameters: the first line of a docstring, or a numbered line for each overload.

def split(text, mark):
    """Parts of a text at a mark that is in no bracket and no quotes."""
    parts, depth, quote = [""], 0, ""
    for i, letter in enumerate(text):
        quote = "" if letter == quote else letter if not quote and letter in "'\"" else quote
        depth += not quote and ((letter in "([{") - (letter in ")]}"))
        if not quote and depth == 0 and text.startswith(mark, i):
            parts.append("")
        else:
            parts[-1] += letter
    return parts


def native_signatures(function):
    """[(name, default or None), ...] for each overload of a function of the compiled module; ("*", None) before keywords."""
    name, lines = function.__name__, (function.__doc__ or "").splitlines()
    if any(line == "Overloaded function." for line in lines):
        lines = [line.split(". ", 1)[1] for line in lines if line.split(". ")[0].isdigit()]
    else:
        lines = lines[:1]
    found = []
    for line in lines:
        if not line.startswith(name + "("):
            continue
        inside = line[len(name) + 1:line.rindex(") -> ")] if ") -> " in line else line[len(name) + 1:-1]
        parameters = []
        for part in split(inside, ","):
            what, *default = split(part, "=")
            what = what.split(":")[0].strip()
            if what and what != "self" and not what.startswith(("arg", "*args", "**")):
                parameters.append((what, default[0].strip() if default else None))
        found.append(parameters)
    return found


def shown(parameters):
    return "(" + ", ".join(name + (f"={default}" if default else "") for name, default in parameters) + ")"


# The table of names.

def python_signature(function):
    parameters = list(inspect.signature(function).parameters.values())
    parts, keywords = [], False
    for p in parameters:
        if p.name in ("self", "cls"):
            continue
        if p.kind == p.KEYWORD_ONLY and not keywords:
            keywords = True
            parts.append("*")
        if p.kind == p.VAR_POSITIONAL:
            keywords = True
        stars = {p.VAR_POSITIONAL: "*", p.VAR_KEYWORD: "**"}.get(p.kind, "")
        default = "" if p.default is p.empty else "=..." if " object at 0x" in repr(p.default) else f"={p.default!r}"
        if isinstance(p.default, (int, float, str, tuple, list, type(None))) or not default:
            parts.append(stars + p.name + default)
        else:
            parts.append(stars + p.name + "=...")
    return "(" + ", ".join(parts) + ")"


def is_native(thing):
    return getattr(thing, "__module__", "").startswith("airsim360._native") or type(thing).__name__ == "builtin_function_or_method"


def lines_of(path, thing):
    """The lines of the table for a function, a class or a value."""
    if isinstance(thing, type) and typing.is_typeddict(thing):
        yield f"{path}: {', '.join(thing.__annotations__)}"
    elif isinstance(thing, type):
        native = is_native(thing)
        signatures = [shown(s) for s in native_signatures(thing.__init__)] if native else [python_signature(thing.__init__)]
        if not native and "__init__" not in vars(thing) and all("__init__" not in vars(b) for b in thing.__mro__[:-1]):
            signatures = []
        yield from (path + s for s in signatures or [""])
        for name, member in sorted(vars(thing).items()):
            if name.startswith("_") and name not in DUNDERS or name == "fields":
                continue
            if isinstance(member, (staticmethod, classmethod)):
                member = getattr(thing, name)
            if callable(member):
                for s in [shown(s) for s in native_signatures(member)] if native else [python_signature(member)]:
                    yield f"{path}.{name}{s}"
            else:
                yield f"{path}.{name}"
        for name in sorted(getattr(thing, "fields", {})):
            yield f"{path}.{name}"
    elif callable(thing):
        yield from (path + s for s in ([shown(s) for s in native_signatures(thing)] if is_native(thing) else [python_signature(thing)]))
    else:
        yield path


def public_names():
    import airsim360
    import airsim360.airsim
    import airsim360.gym
    import msgpackrpc
    lines = []
    for name in airsim360.__all__:
        thing = getattr(airsim360, name)
        lines += [f"{name}.{part}" for part in thing.__all__] if isinstance(thing, types.ModuleType) else lines_of(name, thing)
    for module in (airsim360.airsim, airsim360.data, airsim360.gym, airsim360.metrics, airsim360.records, msgpackrpc, msgpackrpc.error):
        path = module.__name__.removeprefix("airsim360.")
        for name in module.__all__:
            if name in ("Box", "Dict", "HAS_GYMNASIUM", "error"):  # Gymnasium's where it is installed
                continue
            lines += lines_of(f"{path}.{name}", getattr(module, name))
    return sorted(set(lines))


class PublicNames(unittest.TestCase):
    def test_the_table_lists_every_name_and_its_parameters(self):
        difference = list(difflib.unified_diff(TABLE.read_text().splitlines(), public_names(), "public_names.txt", "the package", "", "", 0, ""))
        self.assertFalse(difference, "\n".join(["public names have changed; if that is meant: stubs_test.py --write", *difference]))

    def test_importing_the_package_imports_nothing_heavy(self):
        code = "import sys; before = set(sys.modules); import airsim360; print(*(set(sys.modules) - before))"
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
        heavy = {"airsim360._native", "airsim360.airsim", "airsim360.gym", "PIL", "ctypes", "difflib", "gym", "gymnasium", "http", "json",
                 "msgpack", "msgpackrpc", "numpy", "socket", "torch", "typing", "urllib"}
        self.assertIn("airsim360", done.stdout.split())
        self.assertFalse(heavy & set(done.stdout.split()))

    def test_datasets_and_gym_import_only_what_they_need(self):
        for module, heavy in (("airsim360.dataset", {"airsim360._native", "PIL", "torch", "msgpack", "difflib", "http"}),
                              ("airsim360.data", {"airsim360._native", "PIL", "torch", "msgpack", "difflib", "http", "multiprocessing"}),
                              ("airsim360.gym", {"airsim360._native", "PIL", "torch", "msgpack"}),
                              ("airsim360.airsim", {"airsim360._native", "PIL", "torch", "gymnasium", "airsim360.gym"})):
            done = subprocess.run([sys.executable, "-c", f"import sys; import {module}; print(*sys.modules)"],
                                  capture_output=True, text=True, check=True)
            self.assertFalse(heavy & set(done.stdout.split()), module)

    def test_every_public_name_has_a_docstring(self):
        import airsim360
        import airsim360.airsim
        import airsim360.gym
        for module in (airsim360, airsim360.airsim, airsim360.data, airsim360.gym, airsim360.metrics, airsim360.records):
            for name in module.__all__:
                thing = getattr(module, name)
                if isinstance(thing, (type, types.FunctionType, types.BuiltinFunctionType, types.ModuleType)):
                    self.assertTrue(thing.__doc__, f"{module.__name__}.{name}")

    def test_every_member_of_the_compiled_module_has_a_docstring(self):
        native = importlib.import_module("airsim360._native")
        for kind in (k for k in vars(native).values() if isinstance(k, type)):
            for name, member in vars(kind).items():
                if name.startswith("_") or name == "TASK_OPTIONS":  # static: pybind11 shows no text for it
                    continue
                text = member.__doc__ if isinstance(member, property) else "".join((getattr(kind, name).__doc__ or "").splitlines()[1:])
                self.assertTrue(text and text.strip(), f"{kind.__name__}.{name}")


# The stub of the compiled module against what pybind11 says.

def stub_parameters(function):
    a = function.args
    positional = [p.arg for p in a.posonlyargs + a.args]
    defaults = [None] * (len(positional) - len(a.defaults)) + [ast.unparse(d) for d in a.defaults]
    pairs = [pair for pair in zip(positional, defaults) if pair[0] != "self"]
    if a.kwonlyargs:
        pairs += [("*", None)] + [(p.arg, d and ast.unparse(d)) for p, d in zip(a.kwonlyargs, a.kw_defaults)]
    return pairs


def same_default(stub, runtime):
    if stub is None or runtime is None or stub == "...":
        return (stub is None) == (runtime is None)
    return ast.literal_eval(stub) == ast.literal_eval(runtime)


class NativeStub(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.tree = ast.parse((package_folder() / "_native.pyi").read_text())

    def compare(self, path, function, member):
        signatures = native_signatures(member)
        if not signatures:
            return
        stub, runtime = stub_parameters(function), signatures[0]
        self.assertEqual([name for name, _ in stub], [name for name, _ in runtime], path)
        for (name, a), (_, b) in zip(stub, runtime):
            self.assertTrue(same_default(a, b), f"{path}: {name}: {a} in the stub, {b} in the module")

    def test_names_parameters_and_defaults_are_those_of_the_module(self):
        native = importlib.import_module("airsim360._native")
        public = {name for name in vars(native) if not name.startswith("_")} - {"metrics"}
        in_stub = {n.name for n in self.tree.body if isinstance(n, (ast.ClassDef, ast.FunctionDef)) and not n.name.startswith("_")}
        in_stub |= {n.target.id for n in self.tree.body if isinstance(n, ast.AnnAssign)}
        self.assertEqual(in_stub, public)
        for node in self.tree.body:
            if isinstance(node, ast.FunctionDef):
                self.compare(node.name, node, getattr(native, node.name))
            if not isinstance(node, ast.ClassDef):
                continue
            kind, seen = getattr(native, node.name), {}
            for part in node.body:
                if isinstance(part, ast.FunctionDef) and part.name not in seen:  # of overloads the first
                    seen[part.name] = part
                elif isinstance(part, ast.AnnAssign):
                    seen[part.target.id] = part
            members = {name for name in vars(kind) if not name.startswith("_")}
            self.assertEqual({name for name in seen if not name.startswith("_")}, members, node.name)
            for name, part in seen.items():
                if isinstance(part, ast.FunctionDef) and not isinstance(vars(kind).get(name), property) and not name.startswith("__exit"):
                    self.compare(f"{node.name}.{name}", part, getattr(kind, name))

    def test_every_name_of_the_stubs_has_a_docstring(self):
        for stub in ("_native.pyi", "metrics.pyi", "airsim/client.pyi"):
            for node in ast.walk(ast.parse((package_folder() / stub).read_text())):
                if isinstance(node, (ast.ClassDef, ast.FunctionDef)) and not node.name.startswith("__"):
                    overloaded = any(ast.unparse(d) == "overload" for d in getattr(node, "decorator_list", []))
                    self.assertTrue(ast.get_docstring(node) or overloaded, f"{stub}: {node.name}, line {node.lineno}")

    def test_the_airsim_stub_is_what_its_tables_say(self):
        done = subprocess.run([sys.executable, ROOT / "tools/write_airsim_stub.py", "--check"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


MISSING = [name for name in ("mypy", "mypy.stubtest") if importlib.util.find_spec(name.split(".")[0]) is None]


@unittest.skipIf(MISSING, "mypy is not installed: apt-get install mypy python3-typeshed")
class Mypy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.cache = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.cache.cleanup)

    def run_python(self, *command):
        folder = str(package_folder().parent)
        done = subprocess.run([sys.executable, *map(str, command)], capture_output=True, text=True, cwd=ROOT,
                              env={**os.environ, "MYPYPATH": folder, "PYTHONPATH": folder, "MYPY_CACHE_DIR": self.cache.name})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_stubs_are_what_is_there(self):
        self.run_python("-m", "mypy.stubtest", "--concise", "--mypy-config-file", "pyproject.toml", "--ignore-unused-allowlist",
                        "--allowlist", HERE / "stubtest_allow.txt", "airsim360")

    def test_package_and_examples_have_right_types(self):
        self.run_python("-m", "mypy", "--config-file", "pyproject.toml", "-p", "airsim360", "-p", "msgpackrpc")
        self.run_python("-m", "mypy", "--config-file", "pyproject.toml", *sorted((ROOT / "examples").glob("*.py")))


if __name__ == "__main__":
    if "--write" in sys.argv:
        TABLE.write_text("\n".join(public_names()) + "\n")
    else:
        unittest.main()
