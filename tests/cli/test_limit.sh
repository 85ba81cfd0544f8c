# subdivide --limit and --evaluate.
. tests/cli/lib.sh

# The unit cube's corners go half-way to its center, from whichever level; each has the normal of the sphere there.
run 0 subdivide "$folder/cube.off" -n 0 --limit -o "$folder/zero.obj"
holds "the limit of level 0" grep -qx 'v 0.25 0.25 0.25' "$folder/zero.obj"
run 0 subdivide "$folder/cube.off" -n 2 --limit -o "$folder/two.obj"
holds "the limit of level 2" grep -qx 'v 0.25 0.25 0.25' "$folder/two.obj"
holds "a normal a vertex" test "$(grep -c '^vn' "$folder/two.obj")" = "$(grep -c '^v ' "$folder/two.obj")"

# With all edges sharp the cube stays a cube, and its corners have three normals each.
run 0 subdivide "$folder/cube.off" -n 1 --limit --crease-angle 40 -o "$folder/sharp.obj"
holds "the corner stays" grep -qx 'v 1 1 1' "$folder/sharp.obj"
holds "normals of faces" test "$(sed -n 's/^vn //p' "$folder/sharp.obj" | sort -u | wc -l)" = 6

run 0 subdivide "$folder/cube.off" -n 2 --evaluate
prints "to the limit"
prints "    0       0.433013       0.433013             25 %"
run 0 subdivide "$folder/cube.off" -n 2 --evaluate --json
prints '"levels": 2, "distance": [{"level": 0, "max": 0.4330127018922193, "rms": 0.4330127018922193, "vertex": 0}'
run 0 subdivide "$folder/cube.off" --evaluate -o "$folder/x.ply"
silent
says "to the limit"
holds "the mesh is written too" test -s "$folder/x.ply"

# What has no limit in closed form says what would help.
printf 'OFF\n3 1 3\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >"$folder/triangle.off"
run 3 subdivide "$folder/triangle.off" -n 0 --limit -o "$folder/x.off"
says "face 0 has 3 sides"
says "ask for a level or more"
run 3 subdivide "$folder/bowtie.off" --evaluate
run 0 subdivide "$folder/triangle.off" --limit -o "$folder/x.off"
finish
