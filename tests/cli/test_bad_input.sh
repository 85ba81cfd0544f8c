# What holds for every format in text: encodings, marks, line ends, blanks, a long line; and a target that fills up.
. tests/cli/lib.sh

printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >"$folder/plain.obj"
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >"$folder/plain.off"
printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1
property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >"$folder/plain.ply"
printf 'solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet
endsolid a\n' >"$folder/plain.stl"
cp meshes/malformed/gltf/plain.gltf "$folder/plain.gltf"

is_triangle() { # PATH WHAT
  run 0 info "$1" --json
  prints '"faces": 1'
  holds "$2: without a warning" test -z "$err"
}

for extension in obj off ply stl gltf; do
  plain="$folder/plain.$extension" path="$folder/changed.$extension"
  is_triangle "$plain" "$extension as it is"
  sed 's/./&\x00/g; s/$/\x0d\x00/' "$plain" | { printf '\xff\xfe' && cat; } >"$path"
  run 3 info "$path"
  says "UTF-16"
  { head -n 3 "$plain" && printf '\0' && tail -n +4 "$plain"; } >"$path"
  run 3 info "$path"
  says "$path:"
  { printf '\xef\xbb\xbf' && cat "$plain"; } >"$path"
  is_triangle "$path" "$extension with a mark of UTF-8"
  sed 's/$/\r/' "$plain" >"$path"
  is_triangle "$path" "$extension with CRLF"
  tr '\n' '\r' <"$plain" >"$path"
  is_triangle "$path" "$extension with lone CR"
  sed 's/ /\t\v /g; s/$/ \t/' "$plain" | head -c -1 >"$path"
  is_triangle "$path" "$extension with tabs, vertical tabs, spaces at the ends and no last line end"
done

{ printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2' && head -c 100000000 /dev/zero | tr '\0' ' ' && echo 3; } >"$folder/long.obj"
is_triangle "$folder/long.obj" "a line of 100 MB"
rm "$folder/long.obj"

# A limit on the size of files stands for a disk that fills up while a file is written: the old one stays.
mkdir "$folder/full"
echo old >"$folder/full/kept.obj"
run 0 generate icosphere -o "$folder/sphere.ply" -n 5
for format in obj off ply stl glb gltf drc; do
  code=0
  (ulimit -f 1 && "$meshtool" convert "$folder/sphere.ply" "$folder/full/kept.obj" --to $format) 2>"$folder/said" || code=$?
  holds "$format into a file that may not grow: exit 4, not $code" test "$code" = 4
  holds "$format: why" grep -q "kept.obj: could not be written" "$folder/said"
  holds "$format: the old file stays, and alone" test "$(cat "$folder/full/kept.obj") $(ls -A "$folder/full")" = "old kept.obj"
done
finish
