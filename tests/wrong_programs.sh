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
for program in "$here"/*.cpp; do
  # Folders are words on purpose.
  # shellcheck disable=SC2086
  errors="$(LC_ALL=C "$compiler" -std=c++20 -fsyntax-only $include "$program" 2>&1 |
    sed -n 's/^.*: error: /  /p')"
  printf '\n%s\n%s\n' "$(basename "$program")" "${errors:-  compiles}" >>"$said"
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
programs="$(find "$here" -name '*.cpp' | wc -l)"
lines="$(grep -c '^  ' "$said")"
if [ "$programs" -lt 10 ] || [ "$programs" != "$lines" ] || grep -q '^  compiles' "$said"; then
  echo "wrong programs: $lines errors of $programs programs" >&2
  exit 1
fi
# And the programs that users read first are right ones.
for page in README.md docs/reference/cpp.md; do
  program="$(mktemp --suffix .cpp)"
  trap 'rm -f "$said" "$said.kept" "$said.now" "$program"' EXIT
  block="$(sed -n '/^```cpp$/,/^```$/p' "$here/../../$page" | grep -v '^```')"
  {
    echo '#include <iostream>'
    printf '%s\n' "$block" | grep '^#include'
    echo '#include <plexway/shape/warnings.hpp>'
    echo 'int main() {'
    printf '%s\n' "$block" | grep -v '^#include'
    echo '}'
  } >"$program"
  # shellcheck disable=SC2086
  "$compiler" -std=c++20 -fsyntax-only $include "$program"
done
echo "wrong programs: $programs, each with one error by $name; those of README.md compile"
