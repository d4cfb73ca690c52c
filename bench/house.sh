#!/bin/sh
# house.sh [REVISION...]: how large the house is, as Markdown: lines of C++ and GLSL by folder, public
# headers, and declarations of the verbs, one column a revision (default: HEAD). The last one before
# one `solve` is 8fa164a.
set -eu
cd "$(dirname "$0")/.."
[ $# -gt 0 ] || set -- HEAD

# Files of a revision that are code, under a folder.
files() { git ls-tree -r --name-only "$1" -- $2 | grep -E '\.(hpp|cpp|inl|comp|vert|frag)$' || true; }
lines() {
  revision="$1"; shift
  for folder; do files "$revision" "$folder"; done |
    while read -r file; do git show "$revision:$file"; done | wc -l
}
headers() { git ls-tree -r --name-only "$1" -- include complexes | grep -c '/\?include/.*\.hpp$' || true; }
implementation() {  # those that the API reference leaves out: by a list, or in folders named detail
  listed=$(git show "$1:cmake/PlexwayReference.cmake" 2>/dev/null |
    awk '/^set\(implementation/ {on = 1; next} on && /\.hpp/ {n++} on && /\)$/ {on = 0} END {print n + 0}')
  echo $((listed + $(git ls-tree -r --name-only "$1" -- include | grep -c '/detail/.*\.hpp$' || true)))
}
verbs() {  # declarations, not calls: a line that begins with a type, at no indentation
  files "$1" include | grep '\.hpp$' | while read -r file; do git show "$1:$file"; done |
    grep -cE "^(\[\[nodiscard\]\] )?[a-zA-Z].*[ >&]($2)\(" || true
}
row() {
  name="$1" command="$2"; shift 2
  printf '| %s |' "$name"
  for revision in $revisions; do printf ' %s |' "$($command "$revision" "$@")"; done
  printf '\n'
}

revisions="$*"
printf '| |'; for r in $revisions; do printf ' %s |' "$(git show -s --format='%h, %as' "$r" | tail -1)"; done
printf '\n|---|'; for r in $revisions; do printf -- '---:|'; done; printf '\n'
library='include src complexes shaders'
for folder in $library python/src web/module tests bench examples; do
  row "\`$folder\`" lines "$folder"
done
row 'the library, `include` to `shaders`' lines $library
row 'public headers' headers
row 'of them implementation' implementation
row 'declarations of `solve`, `solve_each`' verbs 'solve|solve_each'
row 'of `propagate`, `propagate_each`' verbs 'propagate|propagate_each'
row 'of `field`, `fields`' verbs 'field|fields|surface_field|solid_field'
