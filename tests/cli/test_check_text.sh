# check-manifold as people read it: the verdict first, each kind of defect with its place, the boundary as loops.
. tests/cli/lib.sh

# verdict CODE FILE SENTENCE: the first line of the report.
verdict() {
  run "$1" check-manifold "$folder/$2"
  holds "$2: the first line says: $3" test "$(head -1 "$folder/.out")" = "$folder/$2: $3"
}

verdict 0 cube.off "manifold and closed, consistently oriented."
prints "volume 1"
prints "genus 0"
verdict 0 open.off "manifold with boundary (1 boundary loop), consistently oriented."
prints "1 loop, 4 edges"
prints "a loop of 4 edges around (0, 0.5, 0.5), through vertex 0"
prints "no volume as it is not closed"
run 1 check-manifold "$folder/open.off" --closed
prints "open.off: not closed: manifold with boundary"
verdict 1 bowtie.off "not manifold: 1 vertex joins separate surfaces."
prints "vertex 0 at (0, 0, 0), in faces 0, 1, 2, 4, 5, 6"
prints "To see where: meshtool check-manifold"
verdict 1 book.off "not manifold: 1 edge has three faces or more."
prints "edge 0-1 at (0, 0, 0.5), in faces 0, 1, 2"
prints "6 edges have only one face"
verdict 0 flipped.off "manifold with boundary (1 boundary loop), but its faces are not all turned the same way."
run 1 check-manifold "$folder/flipped.off" --oriented --closed
prints "flipped.off: not closed and not oriented: "

# The cube inside out.
awk 'NR <= 10 { print; next } { print $1, $5, $4, $3, $2 }' "$folder/cube.off" >"$folder/inside.off"
verdict 0 inside.off "manifold and closed, consistently oriented; 1 component is inside out."
prints "volume -1 (negative: the faces look inwards; turn them all over)"

# One-sided surfaces are told apart from turned faces.
run 0 generate moebius -o "$folder/moebius.ply"
verdict 0 moebius.ply "manifold with boundary (1 boundary loop), one-sided as a Moebius strip, so that no orientation fits."
run 0 generate klein -o "$folder/klein.ply"
verdict 0 klein.ply "manifold and closed, one-sided as a Moebius strip, so that no orientation fits."

# Everything at once, on one triangle's neighbours: nothing hides behind something else.
cat >"$folder/all.obj" <<'END'
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
v 0 -1 0
v 5 5 5
v nan 0 0
v 2 0 0
v 3 0 0
v 9 9 9
v 9 9 8
f 1 2 3
f 1 2 4
f 1 2 5
f 3 1 2
f 6 6 7
f 2 8 9
f 6 10 11
END
run 1 check-manifold "$folder/all.obj"
prints "not manifold: 1 face names a vertex more than once, 1 edge has three faces or more and"
for part in "1 vertex has a coordinate that is NaN" "1 face repeats an earlier one: drop it" \
  "1 face has no area, as its vertices lie on one line" "edge 0-1 at (0.5, 0, 0), in faces 0, 1, 2, 3"; do
  prints "$part"
done
order=$(grep -nE '^  [0-9]' "$folder/.out" | grep -oE 'NaN|names a vertex|repeats|three faces|join|no area' | tr '\n' ' ')
holds "defects come in the order of mending, not: $order" \
  test "$order" = "NaN names a vertex repeats three faces join no area "
printf 'OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n5 5 5\n3 0 1 2\n' >"$folder/isolated.off"
verdict 0 isolated.off "manifold with boundary (1 boundary loop), consistently oriented; 1 vertex is in no face."
printf 'OFF\n0 0 0\n' >"$folder/empty.off"
verdict 0 empty.off "it has no faces, so there is nothing to find fault with."

# Long lists are cut, and say so; counts have separators.
run 0 generate grid -o "$folder/grid.ply" --resolution 40
awk 'BEGIN { for (i = 0; i < 1234; i++) print "v", i, 0, 0 }' >"$folder/points.obj"
run 0 check-manifold "$folder/points.obj"
prints "1,234 vertices are in no face"
prints "and 1,231 more"

# Two triangles that pass through each other: listed with the place, and only --watertight minds.
printf 'OFF\n6 2 0\n0 0 0\n4 0 0\n0 4 0\n1 1 -1\n1 1 1\n5 5 1\n3 0 1 2\n3 3 4 5\n' >"$folder/through.off"
run 0 check-manifold "$folder/through.off" --self-intersections
prints "consistently oriented; 1 pair of faces intersects."
prints "faces 0 and 1, around (2.5, 2.5, 0)"
run 1 check-manifold "$folder/through.off" --watertight
prints "through.off: not closed and not free of self-intersections: manifold with boundary"
run 0 check-manifold "$folder/cube.off" --watertight
prints "manifold and closed, consistently oriented; no faces intersect."
run 0 check-manifold "$folder/through.off" --self-intersections --paint "$folder/through.ply"
says "brown 1 self-intersection"

# Two triangles that meet in place but share no vertex: as welded they are one surface.
printf 'OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 3 4 5\n' >"$folder/seam.off"
run 0 check-manifold "$folder/seam.off"
prints "2 vertices are at the place of another. As welded it would still be manifold with boundary, with 4 boundary edges"
prints "seam.off -o OUT --weld"

# A part that looks inwards beside one that does not.
cat >"$folder/inside_part.off" <<'END_OF_MESH'
OFF
8 8 0
0 0 0
1 0 0
0 1 0
0 0 1
3 0 0
4 0 0
3 1 0
3 0 1
3 0 2 1
3 0 1 3
3 1 2 3
3 0 3 2
3 4 5 6
3 4 7 5
3 5 7 6
3 4 6 7
END_OF_MESH
run 0 check-manifold "$folder/inside_part.off" --paint "$folder/inside_part.png"
prints "1 component is inside out: turn over all its faces, unless it is the wall of a cavity"
prints "the component of face 4, which is at (3.33333, 0.333333, 0)"
says "olive 1 inside-out component"
run 0 repair "$folder/inside_part.off" -o "$folder/outside.off" --orient
prints "turned 4 faces"
run 0 check-manifold "$folder/outside.off" --json
prints '"inside_out_components": 0'

# Where the boundary touches itself.
run 1 check-manifold meshes/non_manifold/bow_tie.obj --json
prints '{"kind": "boundary_pinches", "vertices": [0], "faces": []}'
run 1 check-manifold meshes/non_manifold/bow_tie.obj
prints "1 vertex is where the boundary touches itself: give each part of the boundary its own copy of it"

# Several files get a line each, with -v all of it.
run 1 check-manifold "$folder/cube.off" "$folder/book.off"
holds "a line a file" test "$(wc -l <"$folder/.out")" = 2
run 1 check-manifold "$folder/cube.off" "$folder/book.off" -v
prints "edge 0-1 at (0, 0, 0.5)"

# STL has no indices: its corners are welded, and the report says so.
run 0 convert "$folder/cube.off" "$folder/cube.stl"
run 0 check-manifold "$folder/cube.stl" --closed
prints "corners welded where equal, as STL has no indices"

# Painted: the mesh has a colour for each face and vertex, the picture is one; the legend names them.
run 1 check-manifold "$folder/book.off" --paint "$folder/book.ply"
says "book.ply: red 1 non-manifold edge, pink 2 boundary pinches, green 6 boundary edges"
run 0 info "$folder/book.ply"
prints "color per vertex"
prints "color per face"
run 1 check-manifold "$folder/book.off" --paint "$folder/book.png"
holds "the picture is a PNG" test "$(head -c 4 "$folder/book.png" | tail -c 3)" = PNG
"$meshtool" check-manifold "$folder/book.off" --paint - 2>/dev/null | head -c 3 >"$folder/magic"
holds "painted to standard output: a ply, and no text" test "$(cat "$folder/magic")" = ply
run 0 check-manifold "$folder/cube.off" --paint "$folder/clean.ply"
says "nothing to colour"
finish
