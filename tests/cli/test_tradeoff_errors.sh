#!/usr/bin/env bash
# The errors that tradeoff measures are the same on every machine and for any number of threads: they are compared with
# tests/cli/tradeoff_errors.txt, which `bash tests/cli/test_tradeoff_errors.sh --update` writes anew.
. tests/cli/lib.sh
table=tests/cli/tradeoff_errors.txt

"$meshtool" generate torus -o "$folder/torus.ply" --resolution 24
"$meshtool" generate extreme:sliver -o "$folder/sliver.ply"

# errors MESH THREADS: a line for each level: knob, level, errors.
errors() {
  "$meshtool" tradeoff "$1" --budget 0 --json -q --threads "$2" |
    sed 's/{"knob": /\n&/g' | sed -n 's/^{"knob": "\([^"]*\)", "level": "\([^"]*\)".*"error": {\([^}]*\)}.*/\1 \2 \3/p' | tr -d '"'
}
for mesh in "$folder/torus.ply" "$folder/sliver.ply" meshes/valid/cube.obj; do
  printf '%s\n' "$(basename "$mesh")"
  errors "$mesh" 2
done >"$folder/errors.txt"
if [ "${1-}" = --update ]; then
  cp "$folder/errors.txt" "$table"
  exit
fi
holds "levels were judged" test "$(wc -l <"$folder/errors.txt")" -gt 60
if diff "$table" "$folder/errors.txt" >"$folder/.err"; then pass; else fail "errors differ from $table"; fi
errors meshes/valid/cube.obj 1 >"$folder/serial.txt"
sed '1,/^cube.obj$/d' "$folder/errors.txt" >"$folder/parallel.txt"
holds "errors do not depend on threads" cmp "$folder/parallel.txt" "$folder/serial.txt"
finish
