#!/usr/bin/env bash
# From format to format: what both hold arrives, what is lost is said, and what is not lost is not complained of.
. tests/cli/lib.sh
project=$PWD
cd "$folder" || exit 1
quiet() { if [ -z "$err" ]; then pass; else fail "stderr should be empty: $*"; fi; }

# A Draco stream ends where it ends, whatever made it.
for method in edgebreaker sequential; do
  run 0 convert cube.off cube.drc --draco-method $method
  run 0 info cube.drc
  quiet "info of Draco by $method"
  printf 'four' >>cube.drc
  run 0 info cube.drc
  says "4 bytes after the end of the Draco stream"
done

# Names of glTF's nodes are OBJ's objects, there and back; what has no name gets no line.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\no a\nusemtl m\nf 1 2 3\no b\nf 2 3 1\n' >named.obj
run 0 convert named.obj named.gltf -q
run 0 convert named.gltf again.obj
quiet "names of parts are written as objects"
holds "the names come back" test "$(grep '^[ou]' again.obj | tr '\n' ' ')" = "o a usemtl m o b "
sed 's/{"name":"m"}/{}/; s/"name":"a",//g' named.gltf >unnamed.gltf
run 0 convert unnamed.gltf again.obj
holds "no line without a name" test "$(grep '^[ou]' again.obj | tr '\n' ' ')" = "o b "

# Standard output is called so.
run 0 convert named.obj - --to stl
says "warning: standard output: STL cannot hold object names and material names; these are lost"

# Refused is all that would be lost, in one sentence; past sixteen things there is more.
run 3 convert named.obj none.stl --strict-loss
says "none.stl: STL cannot hold object names and material names, and no loss is allowed"
holds "nothing is written" test ! -e none.stl
{
  printf 'ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n'
  seq -f 'property float value_%g' 20
  printf 'end_header\n0 0 0 %s\n' "$(seq -s ' ' 20)"
} >many.ply
run 0 convert many.ply many.obj
says 'vertex attribute "value_15" and more; these are lost'

# What a glTF file holds and a mesh does not, and what is missing, with the place that asks for it.
plain=$project/meshes/malformed/gltf/plain.gltf
changed() { # CODE SENTENCE EDIT: the plain file, changed by sed
  sed "$3" "$plain" >changed.gltf
  run "$1" info changed.gltf
  says "changed.gltf: $2"
}
changed 0 "of materials only the names are kept" 's/"scene":0/"materials":[{"name":"a","alphaMode":"MASK"}],&/'
changed 0 "animations are not kept" 's/"scene":0/"animations":[{}],&/'
changed 0 "primitives without a POSITION, left out: 1" 's/"POSITION":0//'
changed 0 "a node has a matrix beside" 's/{"mesh":0}/{"mesh":0,"scale":[2,2,2],"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}/'
changed 0 "of 2 scenes only scenes[0] is read" 's/"scenes":\[/&{"nodes":[0]},/'
changed 3 "nodes[0].matrix: expected an array of 16 numbers, got an array of 3" 's/{"mesh":0}/{"mesh":0,"matrix":[1,0,0]}/'
changed 4 "buffers[0].uri: none.bin: could not be opened" 's/"data:.*"/"none.bin"/'
sed 's/"scene":0/"materials":[{"name":"a","extras":1}],&/' "$plain" >changed.gltf
run 0 info changed.gltf
quiet "a material that is but a name"

# A compressed file finds those beside it.
mkdir beside && sed 's/"data:.*"/"buffer.bin"/' "$plain" | gzip >beside/plain.gltf.gz
sed 's/.*base64,//; s/".*//' "$plain" | base64 -d >beside/buffer.bin
run 0 info beside/plain.gltf.gz
quiet "a compressed glTF file with its buffer beside it"
# Solids that no name tells apart are lost in OBJ, and said to be.
for names in ' ' 'a a' 'a b'; do
  for name in "${names% *}" "${names#* }"; do
    printf 'solid %s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n' "$name"
  done >two.stl
  run "$([ "$names" = 'a b' ] && echo 0 || echo 3)" convert two.stl two.obj --strict-loss
done

finish
