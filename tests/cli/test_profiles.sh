#!/usr/bin/env bash
# --profile: what each changes, what it says, and that an option beats it.
. tests/cli/lib.sh

run 0 help profiles
for setting in "samples a pixel" "triangle test" "digits of positions" "tolerance, in diagonals"; do prints "$setting"; done
run 2 info "$folder/cube.off" --profile quick
says "--profile expects fast, balanced or exact"

# Digits: fast says what it leaves out, and leaves out no more; strict loss keeps all.
printf 'OFF\n3 1 0\n0.123456789012345 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >"$folder/fine.off"
run 0 convert "$folder/fine.off" "$folder/fast.obj" --profile fast
says "--profile fast leaves out digits of positions after the 9th"
holds "nine digits" grep -q '^v 0.123456789 0 0$' "$folder/fast.obj"
run 0 convert "$folder/fine.off" "$folder/strict.obj" --profile fast --strict-loss
holds "all digits" grep -q '^v 0.123456789012345 0 0$' "$folder/strict.obj"
run 0 convert "$folder/fine.off" "$folder/exact.obj" --profile exact
holds "all digits" grep -q '^v 0.123456789012345 0 0$' "$folder/exact.obj"
run 0 convert "$folder/fine.off" "$folder/fast.ply" --profile fast
holds "binary keeps all" "$meshtool" convert "$folder/fast.ply" "$folder/back.obj"
holds "all digits" grep -q '^v 0.123456789012345 0 0$' "$folder/back.obj"

# Precision of refinement.
run 0 subdivide "$folder/cube.off" -o "$folder/fast.ply" --profile fast
says "refines positions in single precision"
holds "floats" grep -aq '^property float x' "$folder/fast.ply"
run 0 subdivide "$folder/cube.off" -o "$folder/fast.ply" --profile fast --precision f64
holds "doubles, asked for" grep -aq '^property double x' "$folder/fast.ply"

# Pictures: the profile is the same as its options, and options beat it.
run 0 preview "$folder/cube.off" -o "$folder/a.ppm" --size 64x64 --profile fast
run 0 preview "$folder/cube.off" -o "$folder/b.ppm" --size 64x64 --samples 4
holds "fast takes 4 samples" cmp "$folder/a.ppm" "$folder/b.ppm"
run 0 preview "$folder/cube.off" -o "$folder/a.ppm" --size 64x64 --profile exact
run 0 preview "$folder/cube.off" -o "$folder/b.ppm" --size 64x64 --samples 64 --triangle-test exact
holds "exact takes 64" cmp "$folder/a.ppm" "$folder/b.ppm"
run 0 preview "$folder/cube.off" -o "$folder/a.ppm" --size 64x64 --profile exact --samples 4 --triangle-test watertight
run 0 preview "$folder/cube.off" -o "$folder/b.ppm" --size 64x64 --samples 4
holds "options beat it" cmp "$folder/a.ppm" "$folder/b.ppm"

# Distance: the error that is stated follows.
for profile in fast:1e-3 balanced:1e-4 exact:1e-6; do
  run 0 distance "$folder/cube.off" "$folder/open.off" --profile "${profile%:*}" --json
  error=${out#*\"hausdorff_error\": } diagonal=${out#*\"diagonal\": }
  holds "tolerance of $profile" awk "BEGIN { exit !(${error%%[,\}]*} <= ${profile#*:} * ${diagonal%%[,\}]*} * 1.001) }"
done
finish
