#!/bin/sh
# The Debian packages, made and unpacked into a folder of their own, do what they are for:
#   tests/package.sh BUILD FOLDER
# Everything must be built. FOLDER is made anew.
set -eu
build="$1"
folder="$(realpath -m "$2")"
source="$(cd "$(dirname "$0")/.." && pwd)"
rm -rf "$folder"
mkdir -p "$folder/root"
(cd "$build" && cpack -G DEB -B "$folder" >"$folder/cpack.log" 2>&1) || {
  cat "$folder/cpack.log"
  exit 1
}
for package in "$folder"/*.deb; do
  dpkg-deb -x "$package" "$folder/root"
done
usr="$folder/root/usr"
tool="$usr/bin/plexway"

"$tool" --version | grep -q '^plexway '
"$tool" distance "$source/data/knot.ply" --source vertex:0 --quiet --out "$folder/d.csv" >/dev/null
test "$(wc -l <"$folder/d.csv")" -gt 100

# TetGen is there with its package, and told to be missing without it.
if [ -e "$usr/lib/plexway/plexway-tetgen" ]; then
  if ldd "$tool" | grep -q libtet; then
    echo "the tool links TetGen" >&2
    exit 1
  fi
  "$tool" tetrahedralize "$source/data/elbow.off" --out "$folder/e.vtu" --quiet >/dev/null
  mv "$usr/lib/plexway/plexway-tetgen" "$folder/away"
  code=0
  "$tool" tetrahedralize "$source/data/elbow.off" --out "$folder/f.vtu" 2>"$folder/err" || code=$?
  test "$code" = 4
  grep -q 'the program plexway-tetgen, which runs TetGen, is not installed' "$folder/err"
fi

# The Python package, which finds the helpers of the others.
if [ -e "$usr/lib/python3/dist-packages/plexway" ]; then
  dpkg-deb -f "$folder"/python3-plexway_*.deb Depends | grep -q 'python3-numpy'
  (cd "$folder" && PYTHONPATH="$usr/lib/python3/dist-packages" PLEXWAY_HELPERS="$usr/lib/plexway" \
    /usr/bin/python3 "$source/tests/package.py" "$source/data")
fi

for package in "$folder"/*.deb; do
  test -e "$usr/share/doc/$(dpkg-deb -f "$package" Package)/copyright"
done

# The manual page, and completions that complete.
if command -v man >/dev/null; then
  man --warnings -l "$usr/share/man/man1/plexway.1" 2>"$folder/man.err" | grep -q -- --isoline-step
  test ! -s "$folder/man.err"
fi
if command -v bash >/dev/null; then
  completions="$usr/share/bash-completion/completions/plexway"
  bash -c '. "$1"; COMP_WORDS=(plexway tet); COMP_CWORD=1; _plexway
    [ "${COMPREPLY[*]}" = tetrahedralize ]
    COMP_WORDS=(plexway distance a.ply --isoline-s); COMP_CWORD=3; _plexway
    [ "${COMPREPLY[*]}" = --isoline-step ]' bash "$completions"
fi

# The library, by CMake (two components; one that needs others; all that there are) and by pkg-config.
for wanted in core,io apps ""; do
  cmake -S "$source/tests/consumer" -B "$folder/consumer" "-DCMAKE_PREFIX_PATH=$usr" \
    "-DPLEXWAY_WANTED=$wanted" >"$folder/cmake.log" 2>&1 || {
    cat "$folder/cmake.log"
    exit 1
  }
done
cmake --build "$folder/consumer" >>"$folder/cmake.log"
"$folder/consumer/consumer"
if command -v pkg-config >/dev/null; then
  export PKG_CONFIG_PATH="$usr/lib/pkgconfig"
  # shellcheck disable=SC2046
  c++ -std=c++20 $(pkg-config --cflags plexway-io) -c "$source/tests/consumer/main.cpp" \
    -o "$folder/consumer.o"
  # All of each library, so that what it links must be named.
  for file in "$usr"/lib/pkgconfig/*.pc; do
    name="$(basename "$file" .pc)"
    all="$usr/lib/lib$(echo "$name" | tr - _).a"
    # shellcheck disable=SC2046
    c++ "$folder/consumer.o" -Wl,--whole-archive "$all" -Wl,--no-whole-archive \
      $(pkg-config --libs "$name" plexway-io) -o "$folder/by_pkg_config"
  done
  "$folder/by_pkg_config"
fi
echo "packages: all well"
