# normals: kinds, weights and creases, what is written where, the JSON keys, and wrong usage.
. tests/cli/lib.sh

# counts PATTERN NUMBER FILE: so many lines of the file match.
counts() { holds "$2 lines $1 in $3" test "$(grep -c "$1" "$folder/$3")" = "$2"; }

run 0 normals "$folder/cube.off" -o "$folder/vertex.obj"
silent
counts '^vn ' 8 vertex.obj
counts '^vn -0.5773502691896258 -0.5773502691896258 -0.5773502691896258$' 1 vertex.obj
counts '^f 1//1 4//4 3//3 2//2$' 1 vertex.obj

run 0 normals "$folder/cube.off" -o "$folder/corner.obj" --crease 30 --json
prints '"kind": "corner", "weight": "area", "crease": 3e+01, "elements": 24, "normals": 24, "undefined": 0, "lost": []'
counts '^vn ' 24 corner.obj
# At exactly 90 degrees the edges are creases, a hair above none is.
run 0 normals "$folder/cube.off" -o "$folder/corner.obj" --crease 90 --json
prints '"normals": 24'
run 0 normals "$folder/cube.off" -o "$folder/corner.obj" --crease 90.001 --json --weight angle
prints '"weight": "angle"'
prints '"normals": 8'
run 0 normals "$folder/cube.off" -o "$folder/corner.obj" --kind corner --json
prints '"crease": 41.0'
run 0 normals "$folder/cube.off" -o "$folder/flat.obj" --crease 0 --json
prints '"normals": 24'

run 0 normals "$folder/cube.off" -o "$folder/face.ply" --kind face --encoding ascii --json
prints '"kind": "face", "weight": null, "crease": null, "elements": 6, "normals": 6'
counts 'property double nx' 1 face.ply
run 0 info "$folder/face.ply" --json
prints '"semantic": "normal", "domain": "face", "type": "f64", "components": 3, "count": 6, "indexed": false'

# New normals replace the old; single precision stays single.
run 0 normals "$folder/vertex.obj" -o "$folder/again.obj" --weight max --precision f32
counts '^vn ' 8 again.obj
run 0 normals "$folder/corner.obj" -o "$folder/again.obj"
counts '^vn ' 8 again.obj

# Two tetrahedra at one vertex have each a normal there.
run 0 normals "$folder/bowtie.off" -o "$folder/bowtie.obj" --kind corner --crease 179 --json
prints '"normals": 8'
run 0 normals "$folder/bowtie.off" -o "$folder/bowtie.obj" --reachable --json
prints '"kind": "corner"'

# What has no direction is counted, and said with -v.
printf 'OFF\n5 2 0\n0 0 0\n1 0 0\n0 1 0\n2 0 0\n9 9 9\n3 0 1 2\n3 0 1 3\n' >"$folder/odd.off"
run 0 normals "$folder/odd.off" -o "$folder/odd.ply" -v --json
prints '"undefined": 2'
says "2 vertices without a direction, stored as 0 0 0"

# What a format cannot hold is said.
run 0 normals "$folder/cube.off" -o "$folder/face.obj" --kind face --json
says "cannot hold face normals"
prints '"lost": ["face normals"]'
run 3 normals "$folder/cube.off" -o "$folder/strict.obj" --kind face --strict-loss
holds "nothing is left" test ! -e "$folder/strict.obj"

# Any number of threads, and reading from a pipe.
run 0 normals "$folder/cube.off" -o "$folder/one.ply" --threads 1 --crease 100
run 0 normals "$folder/cube.off" -o "$folder/three.ply" --threads 3 --crease 100
holds "the same bytes" cmp "$folder/one.ply" "$folder/three.ply"

run 2 normals "$folder/cube.off"
run 2 normals "$folder/cube.off" -o "$folder/x.ply" --kind edge
run 2 normals "$folder/cube.off" -o "$folder/x.ply" --crease 181
run 2 normals "$folder/cube.off" -o "$folder/x.ply" --kind vertex --crease 30
says "--crease is for corners, not for --kind vertex"
run 2 normals "$folder/cube.off" -o "$folder/x.ply" --kind face --weight max
says "--weight is for vertices and corners"
run 3 normals "$folder/bad.off" -o "$folder/x.ply"
run 5 normals "$folder/cube.off" -o "$folder/x.ply" --max-memory 700
holds "nothing is left" test ! -e "$folder/x.ply"

finish
