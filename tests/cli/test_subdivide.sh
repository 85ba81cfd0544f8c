# subdivide: tags, options and lists of creases, holes, boundaries, what is foretold.
. tests/cli/lib.sh

# faces FILE: how many faces an OBJ has. at FILE VERTEX: a vertex's coordinates, counted from 0.
faces() { grep -c '^f ' "$1"; }
at() { grep '^v ' "$1" | sed -n "$(($2 + 1))p"; }

run 0 subdivide "$folder/cube.off" -o "$folder/plain.obj" -n 2
holds "96 faces" [ "$(faces "$folder/plain.obj")" = 96 ]

# A cube whose edges stay sharp keeps its corners, by angle, by tag and by list.
run 0 subdivide "$folder/cube.off" -o "$folder/angle.obj" -n 2 --crease-angle 40
holds "vertex 6 by angle" [ "$(at "$folder/angle.obj" 6)" = "v 1 1 1" ]
run 0 convert "$folder/cube.off" "$folder/tagged.obj"
printf 't corner 1/1/0 6 10\nt hole 1/0/0 0\n' >>"$folder/tagged.obj"
run 0 subdivide "$folder/tagged.obj" -o "$folder/tag.obj" -n 2
holds "vertex 6 by tag" [ "$(at "$folder/tag.obj" 6)" = "v 1 1 1" ]
holds "a hole by tag" [ "$(faces "$folder/tag.obj")" = 80 ]
holds "no hole is left" [ "$(grep -c '^t hole' "$folder/tag.obj")" = 0 ]
printf '# a list\n\ncorner 6 infinite  # for ever\ncrease 0 1 2.5\nhole 5\n' >"$folder/list"
run 0 subdivide "$folder/cube.off" -o "$folder/list.obj" -n 2 --creases "$folder/list"
holds "vertex 6 by list" [ "$(at "$folder/list.obj" 6)" = "v 1 1 1" ]
holds "a hole by list" [ "$(faces "$folder/list.obj")" = 80 ]
holds "sharpness is left" grep -q '^t crease 2/1/0 [0-9]* [0-9]* 0.5$' "$folder/list.obj"

# An option beats a tag: the corner is as round as without one.
printf 'corner 6 0\n' >"$folder/smooth"
run 0 subdivide "$folder/tagged.obj" -o "$folder/beaten.obj" -n 2 --creases "$folder/smooth"
holds "a tag beaten" [ "$(at "$folder/beaten.obj" 6)" = "$(at "$folder/plain.obj" 6)" ]

# Lists that are wrong are refused with their line.
refused() {
  printf '%b' "$1" >"$folder/wrong"
  run 3 subdivide "$folder/cube.off" -o "$folder/never.obj" --creases "$folder/wrong"
  says "$folder/wrong:$2"
}
refused 'crease 0 1 2\ncrnr 3\n' '2: expected a line that begins with crease, corner, hole or #'
refused 'crease 0 8 2\n' '1: expected "crease A B SHARPNESS" with the numbers of two vertices, counted from 0'
refused 'crease 0 1\n' '1: expected "crease A B SHARPNESS"'
refused '\n\ncorner -1 2\n' '3: expected "corner V SHARPNESS"'
refused 'hole 6\n' '1: expected "hole F" with the number of a face'
refused 'hole 1 2\n' '1: expected "hole F"'
run 4 subdivide "$folder/cube.off" -o "$folder/never.obj" --creases "$folder/nothing"
says "cannot read $folder/nothing"
holds "nothing written" [ ! -e "$folder/never.obj" ]

# Boundaries: of a lone quad all corners move, stay, or there is nothing left.
printf 'v 0 0 0\nv 8 0 0\nv 8 8 0\nv 0 8 0\nf 1 2 3 4\n' >"$folder/quad.obj"
run 0 subdivide "$folder/quad.obj" -o "$folder/smooth.obj"
holds "a smooth boundary" [ "$(at "$folder/smooth.obj" 0)" = "v 1 1 0" ]
run 0 subdivide "$folder/quad.obj" -o "$folder/corners.obj" --boundary corners
holds "corners stay" [ "$(at "$folder/corners.obj" 0)" = "v 0 0 0" ]
run 0 subdivide "$folder/quad.obj" -o "$folder/none.obj" --boundary none
holds "no face is left" [ "$(faces "$folder/none.obj")" = 0 ]
printf 't interpolateboundary 1/0/0 1\n' >>"$folder/quad.obj"
run 0 subdivide "$folder/quad.obj" -o "$folder/tagged_corners.obj"
holds "corners by tag" cmp -s <(grep '^v' "$folder/corners.obj") <(grep '^v' "$folder/tagged_corners.obj")
holds "the tag is kept" grep -q '^t interpolateboundary 1/0/0 1$' "$folder/tagged_corners.obj"
run 0 subdivide "$folder/quad.obj" -o "$folder/back.obj" --boundary smooth
holds "an option beats the tag" cmp -s <(grep '^v' "$folder/smooth.obj") <(grep '^v' "$folder/back.obj")
run 2 subdivide "$folder/quad.obj" -o "$folder/x.obj" --boundary round
says "smooth, corners, none"
run 2 subdivide "$folder/quad.obj" -o "$folder/x.obj" --uv cubic
run 2 subdivide "$folder/quad.obj" -o "$folder/x.obj" --crease-angle 0

# UVs: linear ones keep the corner, smooth ones round it.
printf 'v 0 0 0\nv 8 0 0\nv 8 8 0\nv 0 8 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n' >"$folder/uv.obj"
for rule in all linear corners-only boundaries; do
  run 0 subdivide "$folder/uv.obj" -o "$folder/out.obj" --uv "$rule"
  holds "UVs by $rule" [ "$(grep '^vt' "$folder/out.obj" | sed -n 1p)" = "vt 0 0" ]
done
run 0 subdivide "$folder/uv.obj" -o "$folder/out.obj" --uv none
holds "smooth UVs" [ "$(grep '^vt' "$folder/out.obj" | sed -n 1p)" = "vt 0.125 0.125" ]

# Two cubes that share a vertex.
run 3 subdivide "$folder/bowtie.off" -o "$folder/x.obj"
run 0 subdivide "$folder/bowtie.off" -o "$folder/joined.obj" --non-manifold crease
run 0 check-manifold "$folder/cube.off"
run 3 subdivide "$folder/flipped.off" -o "$folder/x.obj" --non-manifold crease

# What is foretold is what comes, with holes too, and with a time.
run 0 subdivide "$folder/tagged.obj" -n 2 --dry-run
prints "time"
prints " 80 "
run 0 subdivide "$folder/tagged.obj" -n 2 --dry-run --json
prints '"faces": 80'
prints '"seconds": '
run 3 subdivide "$folder/book.off" --dry-run
run 0 subdivide "$folder/book.off" --dry-run --non-manifold crease

finish
