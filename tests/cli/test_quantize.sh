#!/usr/bin/env bash
# convert --quantize: glTF with Draco and without, .drc, and what is refused.
. tests/cli/lib.sh

mesh=meshes/valid/teapot.obj
size() { stat -c %s "$1"; }

run 0 convert $mesh "$folder/floats.glb" -q
run 0 convert $mesh "$folder/zero.glb" -q --quantize 0
holds "0 bits: floats" cmp "$folder/floats.glb" "$folder/zero.glb"
run 0 convert $mesh "$folder/fast.glb" -q --profile fast
holds "no profile quantises unasked" cmp "$folder/floats.glb" "$folder/fast.glb"

# 4 bytes a vertex less with 16 bits, 8 less with 8; the node's numbers take some.
for pair in 8,8 16,4; do
  bits=${pair%,*} saved=${pair#*,}
  run 0 convert $mesh "$folder/$bits.glb" --quantize "$bits" --json
  says "positions (quantised to $bits bits)"
  prints "\"positions (quantised to $bits bits)\""
  less=$(($(size "$folder/floats.glb") - $(size "$folder/$bits.glb") - 2081 * saved))
  holds "$bits bits take less, by what they are narrower: $less" test "${less#-}" -lt 300
  run 0 distance $mesh "$folder/$bits.glb" --json
  # Half a step on each axis of the largest side, 6.43.
  holds "$bits bits are within half a step" awk -v "text=$out" -v "bits=$bits" \
    'BEGIN { exit !(match(text, /"hausdorff": [0-9.e-]+/) && substr(text, RSTART + 13, RLENGTH - 13) + 0 <= 0.8661 * 6.4332 / (2 ^ bits - 1)) }'
done
run 3 convert $mesh "$folder/none.glb" --quantize 12 --strict-loss
holds "nothing is written" test ! -e "$folder/none.glb"
run 2 convert $mesh "$folder/none.glb" --quantize 17
says "at most 16 bits without --draco, not in 17"
run 2 convert $mesh "$folder/none.glb" --quantize 12 --draco-speed 3
says "need --draco"
run 2 convert $mesh "$folder/none.ply" --quantize 12
says "ply files are not quantised; drc, glb and gltf files can be"
run 0 convert meshes/valid/cube.obj "$folder/cube.glb" --quantize 8 --translate 1e30,0,0 -q
run 3 convert meshes/valid/cube.obj "$folder/none.glb" --quantize 8 --scale 1e-37
says "within single precision"
finish
