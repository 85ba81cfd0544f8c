#!/usr/bin/env bash
# What we write as glTF passes Khronos's validator without an error or warning, and three.js reads what is in it. Needs
# node, and the packages that ./dev test puts into build/node; says so and passes where they are not there.
set -euo pipefail
modules=$PWD/build/node
command -v node >/dev/null || { echo "skipped: node is not installed"; exit 0; }
[ -d "$modules/node_modules/three" ] && [ -d "$modules/node_modules/gltf-validator" ] ||
  { echo "skipped: the packages three and gltf-validator are not in build/node; ./dev setup all puts them there"; exit 0; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

cases=()
# bounds FILE OPTIONS...: six numbers.
bounds() {
  "$MESHTOOL" info --json -q "$@" | sed -n 's/.*"minimum": \[\([^]]*\)\], "maximum": \[\([^]]*\)\].*/[\1, \2]/p'
}

# expect MESH TRIANGLES LINES POINTS [OPTIONS...]: written as GLB and as glTF.
expect() {
  local mesh=$1 triangles=$2 lines=$3 points=$4 bits=0 extension out box=-
  shift 4
  [ "${1:-}" != --quantize ] || bits=$2
  [ "$mesh" = "$folder/nothing.obj" ] || box=$(bounds "$mesh")
  for extension in glb gltf; do
    out=$folder/$(basename "$mesh" | tr . _)${1:-}$bits.$extension
    "$MESHTOOL" convert "$mesh" "$out" -q "$@"
    cases+=("$out" "$triangles" "$lines" "$points" "$bits" "$box")
  done
}

# quantized MESH TRIANGLES LINES POINTS: in bytes and in words, at both of their ends.
quantized() {
  for bits in 1 8 9 16; do
    expect "$@" --quantize $bits
  done
}

cat >"$folder/everything.obj" <<'TEXT'
o first "quoted" \ part
v 0 0 0 1 0 0
v 1 0 0 0 1 0
v 1 1 0 0 0 1
v 0 1 0 0.5 0.25 2
v 2 0 0 1 1 1
v 3 0 0 1 1 1
vt 0 0
vt 0.3 0
vt 1 1
vt 0.2 0.9
vn 0 0 1
vn 0 0 -3
vn 0 0 0
usemtl red
f 1/1/1 2/2/1 3/3/1 4/4/1
o größe
usemtl blue
f 3/3/2 2/2/2 1/1/3
f 3/1/2 2/3/2 5
l 1 5
l 5 6
l 1 2 3 4
p 5 6
TEXT
printf 'v 0 0 0\nv 1 2 3\n' >"$folder/points.obj"
printf 'v 1 2 3\n' >"$folder/one.obj"
printf '# nothing\n' >"$folder/nothing.obj"
grep -v '^[fp]' "$folder/everything.obj" >"$folder/colored.obj"
printf 'f 1 2 3 4\nf 3 2 5\n' >>"$folder/colored.obj"
"$MESHTOOL" convert "$folder/colored.obj" "$folder/colored.ply" -q
"$MESHTOOL" generate icosphere --resolution 6 -o "$folder/large.ply"
"$MESHTOOL" generate icosphere --resolution 2 -o "$folder/smooth.ply"
"$MESHTOOL" normals "$folder/smooth.ply" --kind vertex -o "$folder/fine.ply" -q

expect "$folder/everything.obj" 4 5 2
expect "$folder/colored.ply" 3 5 0
expect "$folder/points.obj" 0 0 2
expect "$folder/nothing.obj" 0 0 0 --from obj
expect "$folder/large.ply" 81920 0 0
expect meshes/valid/teapot.obj 4030 0 0
expect meshes/valid/torus.stl 144 0 0
expect meshes/valid/cone.ply 62 0 0
expect meshes/non_manifold/isolated_vertices.obj 4 0 0
quantized "$folder/everything.obj" 4 5 2
quantized "$folder/colored.ply" 3 5 0
quantized "$folder/points.obj" 0 0 2
quantized "$folder/one.obj" 0 0 1
quantized "$folder/fine.ply" 320 0 0
quantized meshes/valid/teapot.obj 4030 0 0
expect "$folder/nothing.obj" 0 0 0 --quantize 12 --from obj
expect "$folder/everything.obj" - - - --draco
expect "$folder/colored.ply" - - - --draco --quantize 0
expect meshes/valid/teapot.obj - - - --draco --quantize 11 --draco-speed 10
node tests/support/gltf_peers.mjs "$modules" "${cases[@]}"
