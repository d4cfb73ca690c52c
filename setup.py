"""Builds the Python package's native module by CMake; the rest is in pyproject.toml."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent


def version():
    found = re.search(r"project\(plexway VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())
    return found.group(1)


class CMakeBuild(build_ext):
    """Configures and builds in a folder of its own, or in the one that PLEXWAY_BUILD names and that
    is then kept for the next time; PLEXWAY_CMAKE_ARGS adds options."""

    def build_extension(self, extension):
        package = Path(self.get_ext_fullpath(extension.name)).resolve().parent
        folder = Path(os.environ.get("PLEXWAY_BUILD", self.build_temp)).resolve()
        options = [
            "-DCMAKE_BUILD_TYPE=Release",
            "-DPLEXWAY_WITH_PYTHON=ON",
            f"-DPLEXWAY_PYTHON={sys.executable}",
            f"-DPLEXWAY_PYTHON_INSTALL={package}",
            "-DPLEXWAY_BUILD_TOOL=OFF",
            "-DPLEXWAY_BUILD_TESTS=OFF",
            "-DPLEXWAY_BUILD_BENCH=OFF",
            "-DPLEXWAY_BUILD_EXAMPLES=OFF",
            "-DPLEXWAY_INSTALL=OFF",
            "-DBUILD_SHARED_LIBS=OFF",
        ]
        if shutil.which("ninja"):
            options += ["-G", "Ninja"]
        if shutil.which("ccache"):
            options.append("-DCMAKE_CXX_COMPILER_LAUNCHER=ccache")
        options += os.environ.get("PLEXWAY_CMAKE_ARGS", "").split()
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))
        subprocess.run(["cmake", "-S", ROOT, "-B", folder, *options], check=True)
        subprocess.run(
            ["cmake", "--build", folder, "--parallel", jobs, "--target", "plexway_python"],
            check=True,
        )
        subprocess.run(["cmake", "--install", folder, "--component", "python"], check=True)


# All that is made on the way goes into one folder of the build tree.
SCRATCH = ROOT / "build" / "pip"
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
