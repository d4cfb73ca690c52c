#!/bin/sh
# `pip install .` as docs/reference/python.md has it, without a network, in an environment of its own; then what
# README.md says, from a folder that knows nothing of the clone:
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
"$python" -m venv --system-site-packages "$folder/venv"
pip="$folder/venv/bin/pip"
(cd "$source" && "$pip" install --no-index --no-build-isolation .) >"$folder/pip.log" 2>&1 || {
  cat "$folder/pip.log"
  exit 1
}
cd "$folder/elsewhere"
"$folder/venv/bin/python" "$source/python/tests/installed.py" "$source" "$folder/venv"
"$pip" uninstall --yes plexway >"$folder/uninstall.log"
if "$folder/venv/bin/python" -c "import plexway" 2>/dev/null; then
  echo "pip: uninstalled, and still there" >&2
  exit 1
fi
echo "pip: all well"
