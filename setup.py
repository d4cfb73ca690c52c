"""Builds the Python package's native module by CMake; the rest is in pyproject.toml.

PLEXWAY_BUILD names the folder that it is built in: another one than build/pip, or one in which the
project was built before, by whatever options, and which is then only brought up to date.
PLEXWAY_CMAKE_ARGS adds options where a folder is configured for the first time.
"""

import os
import re
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent
# All that is made on the way goes into one folder of the build tree.
SCRATCH = ROOT / "build" / "pip"


def version():
    found = re.search(r"project\(plexway VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())
    return found.group(1)


def run(*command):
    subprocess.run([str(word) for word in command], check=True)


class CMakeBuild(build_ext):
    """Configures, builds, installs into a folder of its own, and takes the package from there."""

    def configure(self, folder):
        options = [
            "-DCMAKE_BUILD_TYPE=Release",
            "-DPLEXWAY_WITH_PYTHON=ON",
            f"-DPLEXWAY_PYTHON={sys.executable}",
            "-DPLEXWAY_BUILD_TOOL=OFF",
            "-DPLEXWAY_BUILD_TESTS=OFF",
            "-DPLEXWAY_BUILD_BENCH=OFF",
            "-DPLEXWAY_BUILD_EXAMPLES=OFF",
            "-DBUILD_SHARED_LIBS=OFF",
        ]
        if shutil.which("ninja"):
            options += ["-G", "Ninja"]
        if shutil.which("ccache"):  # paths relative to the source: as .ci/configure has it
            launcher = ["env", f"CCACHE_BASEDIR={ROOT}", "CCACHE_NOHASHDIR=1", "ccache"]
            options.append("-DCMAKE_CXX_COMPILER_LAUNCHER=" + ";".join(launcher))
        options += os.environ.get("PLEXWAY_CMAKE_ARGS", "").split()
        command = ["cmake", "-S", ROOT, "-B", folder, *options]
        answer = subprocess.run(map(str, command), check=True, stdout=subprocess.PIPE, text=True)
        print(answer.stdout)
        return re.findall("^-- plexway: (.* left out: .*)$", answer.stdout, re.M)

    def build_extension(self, extension):
        folder = Path(os.environ.get("PLEXWAY_BUILD", self.build_temp)).resolve()
        without = []
        if not (folder / "CMakeCache.txt").exists():
            without = self.configure(folder)
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))
        run("cmake", "--build", folder, "--parallel", jobs, "--target", "plexway_python")

        installed = Path(self.build_temp).resolve() / "installed"
        shutil.rmtree(installed, ignore_errors=True)
        for component in ("python", "python_parts"):
            run("cmake", "--install", folder, "--component", component, "--prefix", installed)
        name = f"_plexway{sysconfig.get_config_var('EXT_SUFFIX')}"
        made = list(installed.rglob(name))
        if not made:
            raise SystemExit(f"{folder} holds no {name}: it was configured for another Python")
        package = Path(self.get_ext_fullpath(extension.name)).resolve().parent
        shutil.copytree(made[0].parent, package, dirs_exist_ok=True)
        for what in without:  # last, where one who asks (pip install -v) sees it
            print("plexway:", what)


SCRATCH.mkdir(parents=True, exist_ok=True)

setup(
    version=version(),
    options={"build": {"build_base": str(SCRATCH)}, "egg_info": {"egg_base": str(SCRATCH)}},
    packages=["plexway"],
    package_dir={"plexway": "python/plexway"},
    package_data={"plexway": ["py.typed", "*.pyi"]},
    ext_modules=[Extension("plexway._plexway", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
)
