#!/bin/sh
# `pip install .` as docs/reference/python.md has it, and where python3-build is installed a wheel of
# an sdist, without a network, each in an environment of its own; then what README.md says, from a
# folder that knows nothing of the clone:
#   python/tests/pip.sh PYTHON FOLDER [BUILD]
# FOLDER is made anew. With BUILD, in which the project is built, the library is not built a second
# time; without, it is built as for a user.
set -eu
python="$1"
folder="$(realpath -m "$2")"
source="$(cd "$(dirname "$0")/../.." && pwd)"
if [ $# -gt 2 ]; then
  PLEXWAY_BUILD="$(realpath "$3")"
  export PLEXWAY_BUILD
fi
rm -rf "$folder"
mkdir -p "$folder/elsewhere"
unset PYTHONPATH

# logged NAME COMMAND: its words are shown only where it fails.
logged() {
  log="$folder/$1.log"
  shift
  "$@" >"$log" 2>&1 || {
    cat "$log"
    exit 1
  }
}

# used PIP-OPTIONS: installs what they say, uses it and takes it away.
used() {
  rm -rf "$folder/venv"
  "$python" -m venv --system-site-packages "$folder/venv"
  pip="$folder/venv/bin/pip"
  logged pip "$pip" install --no-index "$@"
  (cd "$folder/elsewhere" &&
    "$folder/venv/bin/python" "$source/python/tests/installed.py" "$source" "$folder/venv")
  logged uninstall "$pip" uninstall --yes plexway
  if (cd "$folder/elsewhere" && "$folder/venv/bin/python" -c "import plexway" 2>/dev/null); then
    echo "pip: uninstalled, and still there" >&2
    exit 1
  fi
}

used --no-build-isolation "$source"

if ! "$python" -c "import build" 2>/dev/null; then
  echo "pip: all well; no wheels, as python3-build is not installed"
  exit 0
fi
# Debian's pybind11-dev is none of pip's packages, so -x: pip's names of what is needed do not count.
logged build "$python" -m build --no-isolation -x --outdir "$folder/dist" "$source"
# What the library and the package are built from lies in the sdist, file by file.
tar -tzf "$folder"/dist/plexway-*.tar.gz | sed 's:^[^/]*/::' | sort >"$folder/sdist"
(cd "$source" && find CMakeLists.txt LICENSE cmake complexes include shaders src python/src \
  python/plexway -type f ! -name '*.py[cod]') | sort >"$folder/sources"
missing="$(comm -13 "$folder/sdist" "$folder/sources")"
if [ -n "$missing" ]; then
  echo "pip: not in the sdist: $missing" >&2
  exit 1
fi
# Without a compiler, and without the folder that the library was built in.
unset PLEXWAY_BUILD
for name in CC CXX; do export "$name=/nonexistent/compiler"; done
used "$folder"/dist/plexway-*.whl
if command -v auditwheel >/dev/null; then
  auditwheel show "$folder"/dist/plexway-*.whl
fi
echo "pip: all well"
