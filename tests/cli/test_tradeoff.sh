#!/usr/bin/env bash
# meshtool tradeoff: rows as text and JSON, plots, and what is refused. No time is looked at.
. tests/cli/lib.sh

"$meshtool" generate torus -o "$folder/torus.ply" --resolution 24

run 0 tradeoff "$folder/torus.ply" --budget 0 --knob triangle-test
prints "Which test says where a ray meets a triangle?"
prints "watertight: no ray slips through"
run 0 tradeoff "$folder/torus.ply" --budget 0 --knob triangle-test --json
for key in '"knob": "triangle-test"' '"level": "exact"' '"seconds": ' '"spread": null' '"peak_bytes": ' '"says": ' \
  '"missed_at_vertices": 0.0' '"reference_seconds": ' '"skipped": \[\]'; do
  holds "JSON has $key" grep -q -- "$key" <<<"$out"
done

# Runs that are repeated have a spread.
run 0 tradeoff "$folder/torus.ply" --budget 10 --knob digits --json
case $out in *'"spread": null'*) fail "a spread is missing: $out" ;; *) pass ;; esac
run 0 tradeoff "$folder/torus.ply" --budget 0 --knob visibility --json
holds "nothing is wrong" test "$(grep -o '"wrong_pixels": 0.0' <<<"$out" | wc -l)" = 2
holds "pixels were judged" grep -q '"judged_pixels": 39[0-9][0-9]' <<<"$out"
holds "nothing differs" test "$(grep -o '"differing_pixels": 0.0' <<<"$out" | wc -l)" = 2

# Two triangles of nearly one plane that do not meet: in doubles alone they do. The oracle knows.
printf 'OFF\n6 2 0\n0 0 0\n0.33 0.21 0.27\n0.01 0.1 0.02\n0.04 0.4 0.08\n0.3 -0.09 0.21\n0.4 -0.12 0.28
3 0 1 2\n3 3 4 5\n' >"$folder/two.off"
run 0 tradeoff "$folder/two.off" --budget 0 --knob arithmetic
prints "floating: missed and made up: 0 and 1 pairs, 0 and 0 flat faces, 0 and 0 inside-out parts"
prints "adaptive: nothing on this mesh: 0 pairs, 0 flat faces, all right"
prints "exact: nothing on this mesh: 0 pairs, 0 flat faces, all right"
# A face so small that products vanish is flat to doubles alone, one whose corners are rounded onto a line is not; and a
# flat tetrahedron has its inside out.
printf 'OFF\n7 3 0\n0 0 0\n1e-200 0 0\n0 1e-200 0\n0.1 0.2 0.3\n0.3 0.6 0.9\n0.7 1.4 2.1\n0.2 0.4 0.6
3 0 1 2\n3 3 4 5\n3 3 6 5\n' >"$folder/flat.off"
run 0 tradeoff "$folder/flat.off" --budget 0 --knob arithmetic
prints "floating: missed and made up: 0 and 0 pairs, 1 and 1 flat faces, 0 and 0 inside-out parts"
prints "adaptive: nothing on this mesh: 0 pairs, 1 flat faces, all right"
prints "exact: nothing on this mesh: 0 pairs, 1 flat faces, all right"
printf 'OFF\n4 4 0\n-5.4 -1.6 1.6\n-12.3 0.8 7.2\n-10.5 2 7.2\n-7.5 0 4\n3 0 2 1\n3 1 2 3\n3 0 3 2\n3 0 1 3
' >"$folder/thin.off"
run 0 tradeoff "$folder/thin.off" --budget 0 --knob arithmetic
prints "floating: missed and made up: 0 and 2 pairs, 0 and 0 flat faces, 0 and 1 inside-out parts"
prints "adaptive: nothing on this mesh: 0 pairs, 0 flat faces, all right"
prints "exact: nothing on this mesh: 0 pairs, 0 flat faces, all right"
# Of two crossing squares, n-gons each, one pair; of many faces a sample is judged.
printf 'OFF\n8 2 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n1 -1 -1\n1 3 -1\n1 3 1\n1 -1 1\n4 0 1 2 3\n4 4 5 6 7\n' >"$folder/cross.off"
run 0 tradeoff "$folder/cross.off" --budget 0 --knob arithmetic
prints "floating: nothing on this mesh: 1 pairs, 0 flat faces, all right"
"$meshtool" generate torus -o "$folder/many.ply" --resolution 220
run 0 tradeoff "$folder/many.ply" --budget 0 --knob arithmetic
prints "all right; pairs are judged with 12100 of 24200 faces"
# Of many vertices as well; what is judged is as exact as the whole.
run 0 tradeoff "$folder/many.ply" --budget 0 --knob storage
prints " of the diagonal, at 12100 of 24200 vertices that are judged"
holds "the sample is as exact" grep -q "f64: normals up to [0-9]e-1[45] degrees off, refined vertices [0-9]e-17 " <<<"$out"

# The largest distance of two meshes is within what is owned to, or the command fails; slivers leave no coarse copy.
run 0 tradeoff "$folder/torus.ply" --budget 0 --knob distance --json
holds "every level is there" test "$(grep -o '"largest_off": ' <<<"$out" | wc -l)" = 8
prints '"level": "1e-6, 1/10"'
# Of a face that is not finite the finite corners are looked at; far from the origin samples are rounded to what is there.
printf 'OFF\n11 5 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n10 0 0\n10 1 0\nnan 0 0
4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 2 3 7 6\n3 8 9 10\n' >"$folder/nan.off"
run 0 tradeoff "$folder/nan.off" --budget 0 --knob distance
sed 's/nan 0 0/inf 0 0/' "$folder/nan.off" >"$folder/inf.off"
run 0 tradeoff "$folder/inf.off" --budget 0 --knob distance --plot "$folder/inf.svg"
"$meshtool" convert "$folder/torus.ply" "$folder/far.ply" --precision f64 --translate 5e6,3e6,1e6
run 0 tradeoff "$folder/far.ply" --budget 0 --knob distance
"$meshtool" generate extreme:sliver -o "$folder/sliver.ply"
run 0 tradeoff "$folder/sliver.ply" --budget 0 --knob distance
prints "distance: left out, no face of the mesh is large enough"

# Plots: SVG that ends, PNG by its content; nothing new after a failure.
run 0 tradeoff "$folder/torus.ply" --budget 0 --knob samples --plot "$folder/plot.svg" -q
holds "an SVG" grep -q '^<svg xmlns' "$folder/plot.svg"
holds "a whole SVG" grep -q '^</svg>' "$folder/plot.svg"
holds "a label" grep -q '>adaptive' "$folder/plot.svg"
run 0 tradeoff "$folder/torus.ply" --budget 0 --knob samples --plot "$folder/plot.png" -q
holds "a PNG" grep -q PNG "$folder/plot.png"
run 2 tradeoff "$folder/torus.ply" --plot "$folder/plot.doc"
run 2 tradeoff "$folder/torus.ply" --knob sampels
says 'no knob is called "sampels"; did you mean samples?'
run 3 tradeoff "$folder/bad.off" --plot "$folder/none.svg"
holds "no plot of a bad mesh" test ! -e "$folder/none.svg"

# A plot says how it is to be read, what stands upwards and in which unit; where nothing is wrong it shows no scale.
run 0 tradeoff "$folder/torus.ply" --budget 0 --json --plot "$folder/all.svg"
for text in 'What speed costs on torus.ply (288 faces)' 'Left is faster, lower is more exact.' \
  'Filled: no other level is as fast and as exact.' 'Ringed: the knee. Beyond it, a little more exactness costs much time.' \
  'rmse: root mean square error of a pixel (1: full brightness)' 'normal max: how far a vertex normal is off (degrees)' \
  'hausdorff: distance from the limit surface, at most (diagonals)' 'wrong pixels: pixels that show a wrong face (count)' \
  'No level has an error on this mesh.' 'left out: 4' '>time<'; do
  holds "the plot says: $text" grep -qF -- "$text" "$folder/all.svg"
done
count() { grep -o -- "$1" | wc -l; }
holds "each knee is named" test "$(count '"knee": true' <<<"$out")" = "$(count '(knee)</text>' <"$folder/all.svg")"
holds "each knee is ringed" test "$(count '"knee": true' <<<"$out")" = "$(count 'r="9.5"' <"$folder/all.svg")"
# The report explains every error that the JSON has.
run 0 tradeoff "$folder/torus.ply" --budget 0 --json
figures=$(grep -o '"error": {[^}]*}' <<<"$out" | grep -o '"[a-z_0-9]*":' | tr -d '":' | sort -u | grep -vx error)
run 0 tradeoff "$folder/torus.ply" --budget 0
legend=$(sed -n '/^Times are medians/,$p' <<<"$out")
holds "there are errors" test "$(wc -w <<<"$figures")" -gt 20
for figure in $figures; do
  holds "the legend has $figure" grep -q "^  [^;]*\b$figure[,:]" <<<"$legend"
done

# A mesh without faces has no rays to trace, and says so.
printf 'OFF\n2 0 0\n0 0 0\n1 1 1\n' >"$folder/points.off"
run 0 tradeoff "$folder/points.off" --budget 0
prints "triangle-test: left out, the mesh has no faces"

# Levels that are left out say why, and 0 seconds leave out none for want of time.
"$meshtool" generate torus -o "$folder/wide.ply" --resolution 48
run 0 tradeoff "$folder/wide.ply" --knob strips --budget 0.000001
prints "strips, thorough: left out, one run takes more"
run 0 tradeoff "$folder/wide.ply" --knob strips --budget 0 --json
prints '"level": "thorough"'
prints '"skipped": []'
run 0 tradeoff "$folder/wide.ply" --knob levels --budget 0
prints "levels, 4: left out, its faces are too many"
finish
