#!/bin/sh
# Makes the pictures of docs/how-to/pictures.md anew, and the page itself.
#
#   docs/gallery.sh [BIN] [NAME...]
#
# BIN: where the programs are, build/bin if not given. NAME: only these pictures; the page is whole
# in any case. A picture is one line of the table below: name | title | what to see | command. The
# command writes NAME.png; `plexway` and `example_*` are looked for in BIN, the Python package of
# `docs/gallery.py` in BIN/../python where Python does not know it.
set -eu
cd "$(dirname "$0")/.."
bin=${1:-build/bin}
[ $# -eq 0 ] || shift
wanted=" $* "
python3 -c 'import plexway' 2> /dev/null || export PYTHONPATH="$bin/../python${PYTHONPATH:+:$PYTHONPATH}"

table() {
  cat <<'TABLE'
surface | A surface | Distances from the red point along a knotted tube. What is near in space is far on the surface. Lines of equal distance are at round numbers, and so are the marks of the bar. | plexway distance data/knot.ply --source vertex:0 --view 200,35 --small --picture surface.png
path | Shortest paths | Over hills, from the red point to two others; colours are distances, and paths cross their lines at right angles. | plexway path data/hills.off --from vertex:0 --to vertex:900 --to vertex:1250 --view -35,38 --small --picture path.png
sources | Several sources | Which source is nearest, on a Moebius strip. Borders run inside the triangles, where both sources are equally far. | plexway distance data/moebius.obj --source vertex:0 --source vertex:300 --source vertex:450 --colour cells --view 20,45 --small --picture sources.png
segment | A line as source | Distances from a segment along a face of a flat L, and on around its inner corner: straight beside the line, arcs about its ends. | plexway distance data/ell.obj --source segment:0.25,1.7,0,0.75,1.1,0 --orthographic --isolines 20 --title length --size 640x480 --small --picture segment.png
metric | An anisotropic metric | A flat L with a grain: a step across it costs twice a step along it, so lines of equal cost are ellipses, behind the corner as well. | docs/gallery.py grain metric.png
solid | A solid, cut open | The same knot filled with tetrahedra: distances through its inside, on the exact section of the tetrahedra. | plexway distance data/knot.ply --as solid --max-volume 0.001 --source vertex:0 --clip z --view 20,50 --small --picture solid.png
volume | By way of a level set | The same knot as OpenVDB sees it: a level set, its inside cut into tetrahedra again. | plexway distance data/knot.ply --repair --voxel 0.05 --as solid --source point:2,-1,-1 --clip z --view 20,50 --size 640x480 --small --picture volume.png
isosurfaces | Surfaces of equal distance | In a solid, around its inner edge, at six distances; of the solid a veil is left. | plexway distance data/elbow.off --as solid --max-volume 0.002 --source vertex:0 --isosurfaces 0.4,0.8,1.2,1.6,2,2.4 --view 30,30 --size 640x480 --small --picture isosurfaces.png
inside | A path through a solid | It touches the walls from inside, wherever they are in its way. | plexway path data/knot.ply --as solid --from vertex:0 --to vertex:2600 --view 200,35 --size 640x480 --small --picture inside.png
cloud | A cloud of points | Points of a rolled-up sheet of paper, as discs; no mesh is given. Distances follow the paper, not the gap. | docs/gallery.py roll cloud.png
wireframe | A wireframe | A tree of vessels, lines only. | plexway distance data/vessels.obj --source vertex:0 --map magma --range 0,4.4 --view 20,15 --small --picture wireframe.png
mixed | Several kinds in one domain | Vessels are twenty times as fast as the tissue around them: a wireframe welded to a solid, which is cut open below it. The picture is made by the library (`examples/organ.cpp`). | example_organ mixed.png
poisson | Poisson disks | 700 points, none too near to another along the surface, and none missing. | plexway poisson data/torus.obj --count 700 --size 640x480 --small --picture poisson.png
cvt | Centroidal Voronoi cells | 120 seeds, each in the middle of its cell. | plexway cvt data/knot.ply --count 120 --view 200,35 --size 640x480 --small --picture cvt.png
farthest | Farthest points | 30 landmarks, each the farthest from those before; how far is the nearest? | docs/gallery.py farthest farthest.png
flat | Exact where it is known | A flat L: paths bend at its inner corner, and lines of equal distance are arcs around it. Flat things are seen from above. | plexway distance data/ell.obj --source point:1.9,0.1,0 --orthographic --isolines 24 --title length --small --picture flat.png
errors | Errors beside exact distances | Left Dijkstra along the edges (8.6e-2 in the mean), in the middle the heat method (4.0e-2), right plexway by default (4.3e-5). | docs/gallery.py errors errors.png
cortex | A cortex | Distances on a folded surface, in mm; the medial wall is left out. | plexway distance data/cortex.surf.gii --source vertex:100 --mask data/cortex.label.gii:0 --view 240,10 --title mm --size 640x480 --small --picture cortex.png
space-time | Space and time | Upwards is time. A door opens late: paths to its other side wait at the top of the wall, and pass it there. | docs/gallery.py space-time space-time.png
unreached | What is not reached | Two spheres, one source: the other one is grey. | plexway distance data/two_parts.obj --source vertex:0 --small --picture unreached.png
TABLE
}

page=docs/how-to/pictures.md
mkdir -p docs/gallery
{
  echo "# Gallery"
  echo
  echo "One command each. \`--picture\` draws without a display, by EGL;"
  echo "[the tool](../reference/cli.md#pictures) lists its options. \`docs/gallery.sh\` makes this page and"
  echo "its pictures."
} > "$page"
table | while IFS='|' read -r name title text command; do
  name=$(echo "$name" | tr -d ' ')
  title=$(echo "$title" | sed 's/^ *//; s/ *$//')
  text=$(echo "$text" | sed 's/^ *//; s/ *$//')
  command=$(echo "$command" | sed 's/^ *//; s/ *$//')
  if [ "$wanted" = "  " ] || [ "${wanted#* "$name" }" != "$wanted" ]; then
    echo "$name" >&2
    quiet= at="$bin/"
    case $command in
      plexway*) quiet=--quiet ;;
      docs/*) at= ;;
    esac
    # shellcheck disable=SC2086
    $at$(echo "$command" | sed "s| $name\.png| docs/gallery/$name.png|") $quiet > /dev/null < /dev/null
  fi
  printf '\n## %s\n\n%s\n\n    %s\n\n![%s](../gallery/%s.png)\n' \
    "$title" "$(echo "$text" | fold -s -w 100 | sed 's/ *$//')" "$command" "$title" "$name" >> "$page"
done
