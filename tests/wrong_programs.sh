#!/bin/sh
# Programs of users that are wrong, and what the compilers say: each ends in one error, a sentence
# that tells what to write. Then those of README.md, which are right.
#   tests/wrong_programs.sh COMPILER HEADERS...           compares with tests/wrong_programs/NAME.txt
#   tests/wrong_programs.sh --keep COMPILER HEADERS...    writes it
# COMPILER is one of g++ and clang++. Of another version than NAME.txt was kept by, the sentences
# count alone, not what the compiler says around them.
set -eu
here="$(cd "$(dirname "$0")" && pwd)/wrong_programs"
keep=
if [ "$1" = --keep ]; then
  keep=yes
  shift
fi
compiler="$1"
shift
include=
for folder in "$@"; do include="$include -I$folder"; done
case "$("$compiler" --version | head -n 1)" in
  *clang*) name=clang ;;
  *) name=gcc ;;
esac
kept="$here/$name.txt"
said="$(mktemp)"
trap 'rm -f "$said"' EXIT

echo "$name $("$compiler" -dumpversion | cut -d. -f1)" >"$said"
names="$(sed -n 's/^#ifdef IS_\([a-z_]*\).*/\1/p' "$here/programs.cpp")"
for program in $names; do
  # Folders are words on purpose.
  # shellcheck disable=SC2086
  errors="$(LC_ALL=C "$compiler" -std=c++20 -fsyntax-only $include "-DIS_$program" \
    "$here/programs.cpp" 2>&1 | sed -n 's/^.*: error: /  /p')"
  printf '\n%s\n%s\n' "$program" "${errors:-  compiles}" >>"$said"
done
if [ -n "$keep" ]; then
  cp "$said" "$kept"
  exit 0
fi

# The sentences alone, where versions differ.
sentences() {
  sed -e 's/^  static assertion failed: /  /' -e 's/^  static_assert failed.*"\(.*\)"$/  \1/' \
    -e 's/^  static assertion failed due to requirement.*: /  /' "$1" | tail -n +2
}
if [ "$(head -n 1 "$kept")" = "$(head -n 1 "$said")" ]; then
  diff "$kept" "$said"
else
  sentences "$kept" >"$said.kept"
  sentences "$said" >"$said.now"
  trap 'rm -f "$said" "$said.kept" "$said.now"' EXIT
  diff "$said.kept" "$said.now"
fi
programs="$(printf '%s\n' "$names" | wc -l)"
lines="$(grep -c '^  ' "$said")"
if [ "$programs" -lt 10 ] || [ "$programs" != "$lines" ] || grep -q '^  compiles' "$said"; then
  echo "wrong programs: $lines errors of $programs programs" >&2
  exit 1
fi
# And the programs that users read first are right ones; of those beside another package's the part
# that is ours, by itself.
for page in README.md docs/reference/cpp.md docs/coming-from.md; do
  program="$(mktemp --suffix .cpp)"
  trap 'rm -f "$said" "$said.kept" "$said.now" "$program"' EXIT
  block="$(awk '/^```cpp$/ { inside = 1; block = ""; beside = 0; next }
    /^```$/ && inside { inside = 0; printf beside ? "{\n%s}\n" : "%s", block; next }
    inside && /^\/\/ plexway/ { block = ""; beside = 1 }
    inside { block = block $0 "\n" }' "$here/../../$page")"
  {
    echo '#include <iostream>'
    printf '%s\n' "$block" | sed -n '/^#include/p'
    echo '#include <plexway/plexway.hpp>'
    echo '#include <plexway/shape/warnings.hpp>'
    echo 'const std::vector<std::array<double, 3>> positions, V;'
    echo 'const std::vector<std::array<int, 3>> triangles, F;'
    echo 'const plexway::TriangleMesh<double> surface(positions, triangles);'
    echo 'const plexway::Index other = 0;'
    echo 'int main() {'
    printf '%s\n' "$block" | grep -v '^#include'
    echo '}'
  } >"$program"
  # shellcheck disable=SC2086
  "$compiler" -std=c++20 -fsyntax-only $include "$program"
done
echo "wrong programs: $programs, each with one error by $name; those of pages compile"
