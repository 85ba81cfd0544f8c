# distance: the numbers as text and JSON, points, signs, painted results, and what is refused.
. tests/cli/lib.sh

# A unit square, one a quarter above it, and the unit cube of lib.sh.
printf 'OFF\n4 1 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n' >"$folder/low.off"
printf 'OFF\n4 1 4\n0 0 0.25\n1 0 0.25\n1 1 0.25\n0 1 0.25\n4 0 1 2 3\n' >"$folder/high.off"
printf 'OFF\n3 0 0\n0.5 0.5 0.25\n0.5 0.5 3\n2 2 2\n' >"$folder/points.off"

run 0 distance "$folder/low.off" "$folder/high.off"
prints "Hausdorff distance 0.25, exact to "
prints "mean     0.25, rms 0.25"
prints "normals  0 degrees apart on average, 0 at most"

# member PATH EXPRESSION: the value of the last JSON object holds.
member() { holds "$1 $2 in $out" python3 -c "
import json, sys
value = json.loads(sys.argv[1])
for key in sys.argv[2].split('.'): value = value[key]
sys.exit(not eval('value ' + sys.argv[3]))" "$out" "$1" "$2"; }
run 0 distance "$folder/low.off" "$folder/high.off" --json --tolerance 1e-9
for side in a_to_b b_to_a; do
  member $side.max "- 0.25 < 1e-12"
  member $side.mean "- 0.25 < 1e-12"
  member $side.rms "- 0.25 < 1e-12"
done
member hausdorff "- 0.25 < 1e-12"
member hausdorff_error "<= 1.001e-9"
member diagonal "> 1.436"

# Points, one a line: distance, nearest point, face; inside of a closed mesh below zero.
run 0 distance "$folder/cube.off" --points "$folder/points.off" --signed
prints "-0.25 0.5 0.5 0 0"
prints "2 0.5 0.5 1 1"
prints "1 1 1 "
run 0 distance "$folder/cube.off" --points "$folder/points.off"
prints "0.25 0.5 0.5 0 0"
run 0 distance "$folder/cube.off" --points "$folder/points.off" --signed --json
member points "[0]['distance'] == -0.25"

run 0 distance "$folder/low.off" "$folder/cube.off" --signed --json
member signed.max "== 0"

# Painted.
run 0 distance "$folder/low.off" "$folder/high.off" --paint "$folder/painted.ply" -q
holds "a ply with colours" grep -qa "property uchar red" "$folder/painted.ply"
run 0 distance "$folder/low.off" "$folder/high.off" --paint "$folder/painted.png"
says "violet 0"
holds "a png" grep -qa PNG "$folder/painted.png"

# Refused.
run 2 distance "$folder/low.off"
says "one mesh alone has no distance"
run 2 distance "$folder/low.off" "$folder/high.off" --points "$folder/points.off"
run 2 distance "$folder/low.off" "$folder/high.off" --paint "$folder/painted.stl"
says "hold no colours"
run 2 distance "$folder/low.off" "$folder/high.off" --tolerance 0
run 3 distance "$folder/low.off" "$folder/high.off" --signed
says "has one face"
printf 'OFF\n0 0 0\n' >"$folder/nothing.off"
run 3 distance "$folder/low.off" "$folder/nothing.off"
says "nothing to measure to"
run 4 distance "$folder/low.off" "$folder/missing.off"

finish
