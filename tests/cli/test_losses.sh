#!/usr/bin/env bash
# From format to format: what both hold arrives, what is lost is said, and what is not lost is not complained of.
. tests/cli/lib.sh
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
finish
