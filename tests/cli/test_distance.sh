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

# lies LOW HIGH KEY [OBJECT]: of the last JSON, or of an object in it, the key's number is in that range.
lies() {
  local text=$out
  [ -z "${4-}" ] || text=${text#*\"$4\": [\[\{]}
  text=${text#*\"$3\": }
  holds "$1 <= $3 <= $2 ${4-} in $out" awk "BEGIN { x = \"${text%%[,\}]*}\"; exit !(x ~ /^-?[0-9]/ && x + 0 >= $1 && x + 0 <= $2) }"
}
run 0 distance "$folder/low.off" "$folder/high.off" --json --tolerance 1e-9
for side in a_to_b b_to_a; do
  lies 0.249999999999 0.250000000001 max $side
  lies 0.249999999999 0.250000000001 mean $side
  lies 0.249999999999 0.250000000001 rms $side
done
lies 0.249999999999 0.250000000001 hausdorff
lies 0 1.001e-9 hausdorff_error
lies 1.436 1.437 diagonal

# Points, one a line: distance, nearest point, face; inside of a closed mesh below zero.
run 0 distance "$folder/cube.off" --points "$folder/points.off" --signed
prints "-0.25 0.5 0.5 0 0"
prints "2 0.5 0.5 1 1"
prints "1 1 1 "
run 0 distance "$folder/cube.off" --points "$folder/points.off"
prints "0.25 0.5 0.5 0 0"
run 0 distance "$folder/cube.off" --points "$folder/points.off" --signed --json
lies -0.25 -0.25 distance points

run 0 distance "$folder/low.off" "$folder/cube.off" --signed --json
lies 0 0 max signed

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
