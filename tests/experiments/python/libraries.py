"""What the Python package links and exports: `_fast` neither CGAL nor GMP, `_audit` and the judge GMP as a shared
library, the judge no CHOLMOD, and no module shows a symbol of its own besides the one that Python calls.

Usage: libraries.py BUILD_DIR. Exit status 77: skipped, a Python package is missing.
"""

import ast
import importlib
import re
import subprocess
import sys
import unittest

from package import main, prepare

BUILD, _ = prepare(__doc__)
import ogc_testbed  # noqa: E402

PACKAGE = BUILD / "python" / "ogc_testbed"
SYSTEM = {"libstdc++.so.6", "libm.so.6", "libgcc_s.so.1", "libc.so.6", "ld-linux-x86-64.so.2", "libpthread.so.0",
          "libdl.so.2", "librt.so.1"}


def said(*command):
    return subprocess.check_output([str(word) for word in command], text=True)


def linked(file):
    return set(re.findall(r"NEEDED.*\[(.*)\]", said("readelf", "-d", file))) - SYSTEM


def needed(module):
    return linked(PACKAGE / f"{module}.abi3.so")


def symbols(module, kind):
    return {line.split()[-1].split("@")[0]
            for line in said("nm", "-D", f"--{kind}-only", PACKAGE / f"{module}.abi3.so").splitlines()}


class Libraries(unittest.TestCase):
    def test_the_fast_path_links_one_tbb_alone(self):
        """cudart and libstdc++ need no licence of their own beside Apache-2.0; cudart is linked statically, and libcuda
        is found by it at run time."""
        self.assertEqual(needed("_fast"), {"libtbb.so.12"})
        strings = said("strings", "-a", PACKAGE / "_fast.abi3.so")
        self.assertNotRegex(strings, r"N4CGAL|__gmp|mpfr_|cholmod")
        self.assertFalse([name for name in symbols("_fast", "undefined") if re.match(r"__gmp|mpfr_|H5|cu[A-Z]", name)])

    def test_the_audits_link_gmp_as_a_shared_library(self):
        self.assertLessEqual(needed("_audit"), {"libtbb.so.12", "libgmp.so.10", "libmpfr.so.6"})
        self.assertIn("libgmp.so.10", needed("_audit"))
        used = {name for name in symbols("_audit", "undefined") if name.startswith("__gmp")}
        self.assertTrue(used, "GMP's functions come from its library")
        self.assertNotRegex(said("strings", "-a", PACKAGE / "_audit.abi3.so"), r"cholmod|N3ogc9reference")

    def test_the_judge_needs_no_solver(self):
        """Stages do without CHOLMOD and OpenBLAS, which parts of the program `ogc` need. Which HDF5 is linked is the
        build's choice; expat and minizip read meshes and frames."""
        judge, whole = BUILD / "ogc-judge", linked(BUILD / "ogc")
        self.assertTrue([name for name in whole if name.startswith("libcholmod")], "the program has what is looked for")
        readers = {name for name in whole if re.match(r"libhdf5|libexpat|libminizip|libz\.", name)}
        own = linked(judge) - readers
        self.assertLessEqual(own, {"libtbb.so.12", "libgmp.so.10", "libmpfr.so.6"})
        self.assertIn("libgmp.so.10", own)
        self.assertNotRegex(said("nm", "-C", judge), r"cholmod|gemm_|ogc::reference::(Factor|start_(newton|ipc))")

    def test_the_judges_messages_have_its_name(self):
        for words in (["compare", "trunc"], ["compar"], ["compare", "truncate", "--cases", "-1"]):
            done = subprocess.run([BUILD / "ogc-judge", *words], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
            self.assertTrue(done.stderr.startswith("ogc-judge: "), done.stderr)
            self.assertNotIn("see ogc ", done.stderr)

    def test_symbols_stay_inside(self):
        for module in ("_fast", "_audit"):
            self.assertEqual(symbols(module, "defined"), {f"PyInit_{module}"})

    def test_one_file_serves_all_versions_of_python(self):
        """Nothing is used that the stable interface of Python 3.10 lacks: what begins with _Py is outside of it, but
        for the functions that its macros call."""
        allowed = {"_Py_NoneStruct", "_Py_TrueStruct", "_Py_FalseStruct", "_Py_Dealloc", "_Py_NotImplementedStruct",
                   "_Py_EllipsisObject", "_Py_IncRef", "_Py_DecRef"}
        for module in ("_fast", "_audit"):
            private = {name for name in symbols(module, "undefined") if name.startswith("_Py")}
            self.assertLessEqual(private, allowed, module)


class Import(unittest.TestCase):
    def test_the_package_loads_nothing_before_its_first_use(self):
        code = ("import sys, ogc_testbed; "
                "print([name for name in sys.modules if name.startswith(('ogc_testbed.', 'numpy'))]); "
                "dir(ogc_testbed); import ogc_testbed as ogc; ogc.Mesh; print('ogc_testbed._audit' in sys.modules)")
        self.assertEqual(said(sys.executable, "-c", code), "[]\nFalse\n")

    def test_it_takes_less_than_a_fifth_of_a_second(self):
        """The best of five: other work on the machine only adds."""
        code = ("import time; begun = time.perf_counter(); import ogc_testbed as ogc; ogc.Mesh; "
                "print(time.perf_counter() - begun)")
        self.assertLess(min(float(said(sys.executable, "-c", code)) for _ in range(5)), 0.2)

    def test_missing_audits_say_what_to_install(self):
        code = ("import sys; sys.modules['ogc_testbed._audit'] = None\n"
                "import ogc_testbed\n"
                "try: ogc_testbed.audit\n"
                "except ImportError as error: print(error)")
        self.assertIn("pip install 'ogc-testbed[judge]'", said(sys.executable, "-c", code))
        with self.assertRaisesRegex(AttributeError, "no attribute 'nothing'"):
            ogc_testbed.nothing


class Stubs(unittest.TestCase):
    def test_have_every_name_with_types_and_words(self):
        listed = ast.parse((PACKAGE / "__init__.pyi").read_text())
        names = {alias.asname for node in listed.body if isinstance(node, ast.ImportFrom) for alias in node.names}
        self.assertEqual(names, set(ogc_testbed.__all__))
        for module in ("_fast", "_audit"):
            real = importlib.import_module(f"ogc_testbed.{module}")
            tree = ast.parse((PACKAGE / f"{module}.pyi").read_text())
            defined = {node.name: node for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
            self.assertEqual(set(defined), {name for name in vars(real) if not name.startswith("_")})
            for name, node in defined.items():
                self.check(name, node, getattr(real, name))

    def check(self, name, node, real):
        if isinstance(node, ast.ClassDef):
            members = {member.name: member for member in node.body if hasattr(member, "name")}
            for member in members.values():
                self.assertTrue(hasattr(real, member.name), f"{name}.{member.name}")
                if not member.name.startswith("__"):
                    self.check(f"{name}.{member.name}", member, getattr(real, member.name))
            missing = {member for member in vars(real) if not member.startswith("_")} - set(members)
            self.assertFalse(missing, f"{name} in the stub lacks {missing}")
        self.assertTrue(real.__doc__, f"{name} has no words")
        if not isinstance(node, ast.ClassDef):
            self.assertIsNotNone(node.returns, f"{name} has no type")


class Versions(unittest.TestCase):
    def test_are_those_of_the_build(self):
        cache = (BUILD / "CMakeCache.txt").read_text()
        version = re.search(r"^CMAKE_PROJECT_VERSION:STATIC=(.*)$", cache, re.M)[1]
        self.assertEqual(ogc_testbed.__version__, version)
        source = re.search(r"^CMAKE_HOME_DIRECTORY:INTERNAL=(.*)$", cache, re.M)[1]
        with open(f"{source}/pyproject.toml", encoding="utf-8") as file:
            project = file.read()
        self.assertEqual(re.search(r'^version = "(.*)"$', project, re.M)[1], version)
        self.assertEqual(re.search(r"ogc-testbed-judge==([\d.]+)", project)[1], version)


if __name__ == "__main__":
    main()
