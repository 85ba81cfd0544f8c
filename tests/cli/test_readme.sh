#!/usr/bin/env bash
# The README's program compiles against the library as the README says, and does what it promises; the
# README's commands are ones that meshtool knows.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

sed -n '/^```c$/,/^```$/p' README.md | sed '1d;$d' >"$folder/refine.c"
grep -q 'mt_subdivide' "$folder/refine.c" || { echo "README.md has no C program that subdivides"; exit 1; }
lines=$(wc -l <"$folder/refine.c")
[ "$lines" -le 30 ] || { echo "the README's program has grown to $lines lines"; exit 1; }

flags=()
grep -q 'MESHTOOL_SANITIZE:STRING=.' "$BUILD/CMakeCache.txt" &&
  flags=("-fsanitize=$(sed -n 's/^MESHTOOL_SANITIZE:STRING=//p' "$BUILD/CMakeCache.txt")")
"$CC" -Wall -Wextra -Werror "$folder/refine.c" -I lib/include -I formats/include "$BUILD/libmeshtool.a" "${flags[@]}" \
  -lstdc++ -lspng -ljpeg -ltiff -lz -lzstd -ljansson -ldraco -lmeshoptimizer -lm -fopenmp -o "$folder/refine"

"$folder/refine" meshes/valid/cube.obj "$folder/refined.obj"
faces=$(grep -c '^f ' "$folder/refined.obj")
[ "$faces" -eq 24 ] || { echo "the README's program made $faces faces of a cube, not 24"; exit 1; }
if "$folder/refine" meshes/non_manifold/bow_tie.obj "$folder/no.obj" 2>"$folder/message"; then
  echo "the README's program refined a bow-tie"
  exit 1
fi
grep -q 'vertex 0' "$folder/message" || { echo "the README's program does not name the offender:"; cat "$folder/message"; exit 1; }
if "$folder/refine" 2>/dev/null; then
  echo "the README's program takes no arguments for an answer"
  exit 1
fi

known=$("$MESHTOOL" help)
for command in $(sed -n 's/^\$ meshtool \([a-z-]*\) .*/\1/p' README.md | sort -u); do
  grep -q "^  $command " <<<"$known" || { echo "README.md shows meshtool $command, which is unknown"; exit 1; }
done
echo "5 passed, 0 failed"
