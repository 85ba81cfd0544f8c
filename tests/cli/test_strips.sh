# strips: the text that is written, the account, painting, and what is refused.
. tests/cli/lib.sh

# Usage comes first: the input does not even exist.
run 2 strips "$folder/none.off"
says "give -o OUT"
run 2 strips "$folder/none.off" -o "$folder/x.dwg"
says 'no format for strips is called "dwg"'
run 2 strips "$folder/none.off" -o "$folder/x"
says "no extension"
run 2 strips "$folder/none.off" -o "$folder/x.txt" --kind ribbon
says "strip, fan or mixed"
run 2 strips "$folder/none.off" -o "$folder/x.txt" --join glue
run 2 strips "$folder/none.off" -o "$folder/x.txt" --kind fan --join degenerate
says "fans cannot be joined"
run 2 strips "$folder/none.off" -o - --json
run 2 strips "$folder/none.off" -o "$folder/x.txt" --paint "$folder/x.stl"
says "hold no colours of faces"
run 4 strips "$folder/none.off" -o "$folder/x.txt"
holds "nothing is written" test ! -e "$folder/x.txt"
echo kept >"$folder/kept.txt"
run 3 strips "$folder/bad.off" -o "$folder/kept.txt"
run 4 strips "$folder/cube.off" -o "$folder/kept.txt" --no-clobber
holds "a failure leaves the output" grep -qx kept "$folder/kept.txt"

# The triangles that a text draws, one a line with the lowest vertex first, sorted.
triangles() {
  awk '{
    fan = $1 == "f"
    for (i = 3 + fan; i <= NF; i++) {
      if (fan) { a = $2; b = $(i - 1) } else if (i % 2) { a = $(i - 2); b = $(i - 1) } else { a = $(i - 1); b = $(i - 2) }
      c = $i
      if (a == b || b == c || c == a) continue
      while (a > b || a > c) { t = a; a = b; b = c; c = t }
      print a, b, c
    }
  }' "$1" | sort
}
# Those of a mesh, from an OFF file of triangles, but for those that name a vertex twice.
off_triangles() {
  awk '/^3 / && NF == 4 && $2 != $3 && $3 != $4 && $4 != $2 { a = $2; b = $3; c = $4; while (a > b || a > c) { t = a; a = b; b = c; c = t }; print a, b, c }' \
    "$1" | sort
}

for mesh in "$folder/cube.off" "$folder/open.off" "$folder/bowtie.off" "$folder/book.off" "$folder/flipped.off" \
  meshes/valid/torus.off meshes/non_manifold/*.obj; do
  run 0 convert "$mesh" "$folder/triangles.off" --triangulate --encoding ascii -q
  off_triangles "$folder/triangles.off" >"$folder/expected"
  for how in "" "--kind fan" "--kind mixed" "--join degenerate" "--join none" "--thorough --join none"; do
    run 0 strips "$mesh" -o "$folder/x.txt" $how --json
    triangles "$folder/x.txt" >"$folder/found"
    holds "$mesh $how: its triangles" cmp "$folder/expected" "$folder/found"
  done
done

run 0 strips "$folder/cube.off" -o "$folder/x.txt"
prints "12 triangles in "
prints "restarts counted"
run 0 strips "$folder/cube.off" -o "$folder/x.txt" -q
silent
run 0 strips "$folder/cube.off" -o - --thorough --join degenerate
holds "one line on standard output, and nothing else" test "$(printf '%s\n' "$out" | grep -c '^[0-9 ]*$')" = 1
run 0 strips "$folder/cube.off" -o "$folder/out.dat" --to txt --kind fan
holds "fans begin with f" sh -c "! grep -qv '^f [0-9 ]*$' '$folder/out.dat'"
printf 'OFF\n0 0 0\n' >"$folder/empty.off"
run 0 strips "$folder/empty.off" -o "$folder/empty.txt" --json
prints '"strips": 0, "fans": 0, "indices": 0, "indices_per_triangle": 0'
holds "an empty file" test ! -s "$folder/empty.txt"

# Orders: the same triangles; numbers of vertices stay those of the file.
if grep -q MESHTOOL_MESHOPT:BOOL=OFF "${BUILD:-build/test}/CMakeCache.txt" 2>/dev/null; then
  run 3 strips meshes/valid/torus.off -o "$folder/x.txt" --optimize cache
else
  run 0 strips meshes/valid/torus.off -o "$folder/x.txt" --join none -q
  run 0 strips meshes/valid/torus.off -o "$folder/y.txt" --join none -q --optimize cache
  triangles "$folder/x.txt" >"$folder/expected"
  triangles "$folder/y.txt" >"$folder/found"
  holds "ordered for the cache: the same triangles" cmp "$folder/expected" "$folder/found"
fi
run 2 strips "$folder/none.off" -o "$folder/x.txt" --optimize fetch
says "text has no vertices"

# glTF: the same triangles come back, whatever draws them, and a validator has nothing against it where there is one.
run 0 convert meshes/valid/torus.off "$folder/plain.off" --triangulate -q
sorted() { sed 1,2d "$1" | awk 'NF == 4 { a = $2; b = $3; c = $4; if (b < a && b < c) print b, c, a; else if (c < a && c < b) print c, a, b; else print a, b, c }' | sort; }
for kind in strip fan mixed; do
  for format in glb gltf; do
    run 0 strips meshes/valid/torus.off -o "$folder/x.$format" --kind $kind -q
    run 0 convert "$folder/x.$format" "$folder/back.off" -q
    sorted "$folder/plain.off" >"$folder/expected"
    sorted "$folder/back.off" >"$folder/found"
    holds "$kind in $format: the same triangles" cmp "$folder/expected" "$folder/found"
  done
done

# JSON keys, and that they agree with the file.
run 0 strips meshes/valid/torus.off -o "$folder/x.txt" --json --thorough
for key in triangles strips fans indices indices_per_triangle single_triangles acmr atvr fifo16 fifo32; do
  prints "\"$key\": "
done
indices=$(($(wc -w <"$folder/x.txt") + $(wc -l <"$folder/x.txt") - 1))
prints "\"strips\": $(wc -l <"$folder/x.txt"), "
prints "\"indices\": $indices, "

# Painting: a mesh or a picture, whatever --to says about the strips.
run 0 strips "$folder/cube.off" -o "$folder/x.dat" --to txt --paint "$folder/painted.ply"
holds "a ply with colours" grep -qa "property uchar red" "$folder/painted.ply"
run 0 strips "$folder/cube.off" -o "$folder/x.txt" --paint "$folder/painted.png"
holds "a png" grep -qa PNG "$folder/painted.png"
run 0 preview "$folder/cube.off" -o "$folder/preview.png" --color-by strip
run 0 preview "$folder/cube.off" -o "$folder/plain.png" --color-by none
holds "strips have colours" sh -c "! cmp -s '$folder/preview.png' '$folder/plain.png'"

finish
