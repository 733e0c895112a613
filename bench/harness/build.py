"""Builds the programs that are compared, and installs what they need."""

import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys

from . import BENCH, ROOT

# Pinned, so that a page can be drawn up again.
PEERS = ["pygeoops==0.6.0", "pysfcgal==2.3.0"]

# What each C++ program wants on the command line of the compiler.
CPP = {
    "boost": [],
    # Intervals need the rounding mode left alone.
    "cgal": ["-frounding-math", "-lmpfr", "-lgmp"],
}


def need(found, package):
    """Installs a Debian package unless `found`, and ends if that cannot be done."""
    if found:
        return
    words = ["apt-get", "install", "-y", package]
    if os.geteuid() != 0:
        words.insert(0, "sudo")
    print(f"installing {package}", file=sys.stderr)
    ran = shutil.which(words[0]) and subprocess.run(words, stdout=subprocess.DEVNULL, check=False)
    if not ran or ran.returncode != 0:
        sys.exit(f"error: {package} is missing (Debian's name); install it and try again")


def target(folder):
    """Where cargo puts the release programs of a workspace."""
    return pathlib.Path(folder, os.environ.get("CARGO_TARGET_DIR", "target"), "release")


def cargo(folder, *words):
    subprocess.run(["cargo", "build", "--quiet", "--release", *words], cwd=folder, check=True)
    return target(folder)


def programs(rivals, files):
    """The command of medial, of its other engine and of each rival, by name; with `files` of `layers`."""
    packages = ["medial-bench"]
    packages += ["medial-bench-layers"] if files else []
    packages += ["medial-bench-rivals"] if set(rivals) - set(CPP) else []
    folder = cargo(BENCH, *(word for name in packages for word in ("-p", name)))
    medial = folder / "medial-bench"
    commands = {"medial": [medial], "divide_and_conquer": [medial, "time", "divide_and_conquer"]}
    commands |= {"both": [medial, "both", "path_tracing"], "both_other": [medial, "both", "divide_and_conquer"]}
    commands["layers"] = [folder / "layers"]
    for name in rivals:
        if name in CPP:
            commands[name] = [cpp(name, folder / name)]
        else:
            commands[name] = [folder / "rivals", name]
    return commands


def raster():
    """The programs of ours that time bitmaps, by name."""
    folder = cargo(BENCH, "-p", "medial-bench", "-p", "medial-bench-rivals")
    return {"bench": folder / "medial-bench", "rivals": folder / "rivals"}


def masks():
    """The program that compresses bitmaps."""
    return cargo(BENCH, "-p", "medial-bench-masks") / "masks"


def cpp(name, program):
    compiler = os.environ.get("CXX", "g++")
    need(shutil.which(compiler), "g++")
    header = {"boost": "boost/polygon/voronoi.hpp", "cgal": "CGAL/Segment_Delaunay_graph_2.h"}[name]
    package = {"boost": "libboost-dev", "cgal": "libcgal-dev"}[name]
    words = [compiler, "-x", "c++", "-include", header, "-fsyntax-only", "-frounding-math", os.devnull]
    look = lambda: subprocess.run(words, stderr=subprocess.DEVNULL, check=False).returncode == 0
    sources = [BENCH / f"{name}.cpp", BENCH / "rivals.hpp"]
    if program.exists() and all(s.stat().st_mtime < program.stat().st_mtime for s in sources):
        return program
    need(look(), package)
    first, rest = sources[0], CPP[name]
    words = [compiler, "-std=c++17", "-O3", "-DNDEBUG", "-o", program, first, *rest]
    subprocess.run(words, check=True)
    return program


def medial():
    """The command `medial`."""
    return cargo(ROOT, "-p", "medial-cli") / "medial"


def python(packages=PEERS):
    """A Python with some packages of pip."""
    folder = target(BENCH).parent / "venv"
    program = folder / "bin" / "python"
    if not program.exists():
        need(importlib.util.find_spec("ensurepip"), "python3-venv")
        subprocess.run([sys.executable, "-m", "venv", folder], check=True)
    subprocess.run([program, "-m", "pip", "install", "--quiet", *packages], check=True)
    return program
