#!/usr/bin/env python3
"""Finds packages that nothing uses: what experiments/dependencies.sh and the requirements of plots and of the Python
package install must be included, imported or called somewhere.

    tests/packages.py SOURCE_DIR     the self-test, then one line for each package that is not; exit status 1 for any

What a Debian package brings is asked of dpkg, so a package that is not installed here is not judged (optional ones,
other systems).
"""

import re
import subprocess

from house import run, tracked

# Packages that no include, import or call reveals: the reason, and the words in the tree that need it.
STATED = {
    "build-essential": ("the compiler", r"project\([^)]*CXX"),
    "ca-certificates": ("the Python package index is reached by https", r"-m pip install"),
    "python3": ("plots, tests, the workflow", r"python3 -m"),
    "python3-dev": ("headers for the Python package", r"Development\.Module"),
    "python3-venv": ("the Python environment", r"-m venv"),
    "libgmp-dev": ("CGAL's exact numbers", r"find_package\(CGAL"),
    "libmpfr-dev": ("CGAL's exact numbers", r"find_package\(CGAL"),
    "libopenblas-dev": ("CHOLMOD's dense blocks", r"find_library\(CHOLMOD"),
    **dict.fromkeys(("libegl1", "libgl1", "libgl1-mesa-dri", "libxrender1"),
                    ("PyVista draws without a screen", r"import pyvista")),
}
IMPORTED_AS = {"PyYAML": "yaml", "pillow": "PIL", "vtk": "vtkmodules", "Jinja2": "jinja2",
               "markdown-it-py": "markdown_it"}
INCLUDE = re.compile(r"#\s*include\s*<([^>]+)>")
IMPORT = re.compile(r"^\s*(?:import|from)\s+(\w+)|-m (\w+)", re.M)
EXECUTOR = re.compile(r"^executor: (\w+)", re.M)


def arrays(script):
    """Returns name -> words of the arrays `name=(…)` of a shell script."""
    found = re.findall(r"^(\w+)=\((.*?)\)$", script, re.M | re.S)
    return {name: re.sub(r"#[^\n]*", "", body).split() for name, body in found}


def said(*command):
    """Returns the output of a command; nothing if it fails or does not exist."""
    try:
        return subprocess.run(command, capture_output=True, text=True, check=False).stdout
    except OSError:
        return ""


def files_of(package, deep=True):
    """Returns the paths that an installed package brings, or those of its dependencies if it has nothing else; none if
    it is not installed."""
    listed = said("dpkg", "-L", package).splitlines()
    places = ("/usr/include/", "/usr/bin/", "/usr/lib/python3/dist-packages/")
    found = [path for path in listed if path.startswith(places)]
    if found or not listed or not deep:
        return found
    depends = said("dpkg-query", "-W", "-f=${Depends}", package)
    return [path for name in re.findall(r"[a-z][\w.+-]+", depends) for path in files_of(name, deep=False)]


def brings(files, tree):
    """Returns whether the tree includes, imports or calls one of these files. `tree`: {path: text}."""
    sources = {path for path in tree if path.endswith((".cpp", ".hpp", ".h", ".cu", ".cuh"))}
    includes = {"/" + header for path in sources for header in INCLUDE.findall(tree[path])}
    words = {word for path, text in tree.items() if path not in sources for word in re.findall(r"[\w-]+", text)}
    imports = imported(tree)
    for path in files:
        folder, _, name = path.rpartition("/")
        module = path.partition("dist-packages/")[2].split("/")[0]
        if folder == "/usr/bin" and name in words or module and module in imports:
            return True
        if path.startswith("/usr/include/") and any(path.endswith(header) for header in includes):
            return True
    return False


def imported(tree):
    kinds = (".py", ".sh", "reproduce", "Snakefile", "CMakeLists.txt")
    python = (text for path, text in tree.items() if path.endswith(kinds))
    return {a or b for text in python for a, b in IMPORT.findall(text)}


def unused(dependencies, requirements, tree, files=files_of):
    """Returns sentences about packages of these files that nothing in the tree uses. `requirements`: {path: text}."""
    found, lists = [], arrays(dependencies)
    for package in dict.fromkeys(lists.get("packages", []) + lists.get("optional_packages", [])):
        if package in STATED:
            used = any(re.search(STATED[package][1], text) for text in tree.values())
        else:
            there = files(package)
            used = not there or brings(there, tree)
        found += [] if used else [f"{package} (experiments/dependencies.sh)"]
    imports = imported(tree)
    executors = {f"snakemake_executor_plugin_{name}" for text in tree.values() for name in EXECUTOR.findall(text)}
    for package in lists.get("fallback_packages", []):
        name = package.removeprefix("python3-").replace("-", "_")
        found += [] if name in imports else [f"{package} (experiments/dependencies.sh)"]
    for path, text in requirements.items():
        for package in re.findall(r"^([\w-]+)==", text, re.M):
            name = IMPORTED_AS.get(package, package.replace("-", "_"))
            plugin = any(name.startswith(executor) for executor in executors)
            found += [] if name in imports or plugin else [f"{package} ({path})"]
    words = "nothing includes, imports or calls it: remove it, or say in STATED (tests/packages.py) what it is for"
    return [f"{what}: {words}" for what in found]


def self_test():
    """Returns sentences about planted packages that are judged wrongly."""
    modules = "/usr/lib/python3/dist-packages"
    brought = {"libused-dev": ["/usr/include/used/all.hpp"], "tool": ["/usr/bin/tool"],
               "python3-used": [f"{modules}/used/x.py"], "libidle-dev": ["/usr/include/idle.h"],
               "idler": ["/usr/bin/idler"], "python3-idle": [f"{modules}/idle/x.py"]}
    tree = {"a.cpp": "#include <used/all.hpp>\n// idler\n", "b.sh": "tool --all\npython3 -m called\n",
            "c.py": "import used\n", "d.yaml": "executor: slurm\n"}
    sound = unused("packages=(libused-dev tool python3-used  # words\n not-installed)",
                   {"r.txt": "used==1\ncalled==1\nsnakemake-executor-plugin-slurm==2\n"}, tree,
                   lambda name: brought.get(name, []))
    lists = "packages=(libidle-dev idler)\noptional_packages=(python3-idle)\nfallback_packages=(python3-idle)"
    planted = unused(lists, {"r.txt": "idle==1\n"}, tree, lambda name: brought[name])
    wrong = [f"a used package is called unused: {finding}" for finding in sound]
    return wrong + ([] if len(planted) == 5 else [f"of five planted packages {len(planted)} are found: {planted}"])


def findings(root):
    kinds = re.compile(r"(\.(cpp|hpp|h|cu|cuh|py|sh|txt|yaml|cmake)|/(reproduce|Snakefile|run|bundle))$")
    tree = {name: text for name, text in tracked(root).items() if kinds.search(name) and name != "tests/packages.py"}
    dependencies = tree["experiments/dependencies.sh"]
    requirements = {path: tree.pop(path) for path in list(tree) if path.endswith("/requirements.txt")}
    how = re.sub(r"^\w+=\(.*?\)$", "", dependencies, flags=re.M | re.S)  # without the lists of packages
    return unused(dependencies, requirements, {**tree, "experiments/dependencies.sh": how})


if __name__ == "__main__":
    run(__doc__, self_test, findings)
