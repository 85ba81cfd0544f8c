#!/usr/bin/env bash
# render: what it draws, tells and refuses. Run in the project's root, with the binary in MESHTOOL.
. tests/cli/lib.sh
root=$PWD
cd "$folder" || exit 1
scenes=$root/meshes/scenes

# draws NAME SCENE OPTIONS...
draws() {
  local name=$1 scene=$2
  shift 2
  run 0 render "$scene" -q -o "$name.ppm" --size 60x40 --samples 4 "$@"
}
differ() { holds "$1 and $2 differ" bash -c "! cmp -s $1.ppm $2.ppm"; }
same() { holds "$1 and $2 are the same" cmp "$1.ppm" "$2.ppm"; }

# The same picture by any structure and any number of threads; other samples make another.
for scene in mirror_and_glass many_lights cut_away; do
  draws plain "$scenes/$scene.json"
  for accel in auto none aabb obb grid bsp; do
    draws other "$scenes/$scene.json" --accel $accel --threads 1
    same plain other
  done
  draws exact "$scenes/$scene.json" --triangle-test exact
  draws fast "$scenes/$scene.json" --triangle-test fast
  draws one "$scenes/$scene.json" --samples 1
  differ plain one
done

# The plan tells the truth about what is there and what is not.
run 0 render "$scenes/mirror_and_glass.json" -o x.png --size 30x20 --samples 1 --explain
says 'built    stack of rays'
says 'built    surface tree'
holds 'it does not speak of what is there as skipped' bash -c "! grep -q skipped .err"
run 0 render "$scenes/many_lights.json" -o x.png --size 30x20 --samples 1 --explain
says 'skipped  refracted rays'
says 'no glass'
says 'few triangles: every ray meets them all'

cat >simple.json <<'J'
{"camera": {"eye": [0, 0, 5], "target": [0, 0, 0]}, "ambient": 0.2,
 "lights": [{"kind": "directional", "direction": [0, -1, -1], "shadows": false}],
 "meshes": {"t": {"generate": "torus"}},
 "objects": [{"kind": "mesh", "mesh": "t", "transform": {"rotate": [1, 0, 0, 40]}}, {"kind": "plane", "point": [0, -1, 0]}]}
J
draws plain simple.json
draws raster simple.json --method raster
draws ray simple.json --method ray
same plain raster
same plain ray
draws adaptive simple.json --samples adaptive
draws adaptive_ray simple.json --samples adaptive --method ray
same adaptive adaptive_ray
run 0 render simple.json -o x.png --size 30x20 --explain
says 'skipped  shadow rays'
says 'no light casts shadows'
says 'no mirror and no glass'
says 'primary rays only'
says 'built    tile lists'
run 0 render simple.json -o x.png --size 30x20 --explain=measure
says 'saved    surface tree'
says 'saved    a ray for each sample'
says 'saved    shadow rays'
says 'saved    stack of rays'
run 0 render simple.json -o x.png --size 30x20 --samples 4 --json
prints '"width": 30, "height": 20, "objects": 2, "meshes": 1'
prints '"lights": 1'
prints '"rays": {"primary": 2400, "shadow": 0, "reflected": 0, "refracted": 0}'
draws eight simple.json --size 8x8
holds 'a scene comes from standard input' bash -c "'$meshtool' render - -o piped.ppm --size 8x8 --samples 4 <simple.json"
same eight piped
sed 's/"ambient"/"background": {"transparent": true}, "ambient"/' simple.json >clear.json
run 0 render clear.json -o clear.png --size 8x8
run 2 render clear.json -o clear.ppm --size 8x8
says 'transparent'

# The schema in the help is the table that reading follows.
run 0 render --help
prints 'a point light:'
prints 'refractive_index'
prints 'checker_size'

# What is refused: wrong usage, wrong scenes, what there is no memory for.
for options in "--size 0x5" "--samples 5" "--accel quad" "--triangle-test quick" "--method both"; do
  # shellcheck disable=SC2086
  run 2 render simple.json -o wrong.png $options
done
run 2 render simple.json
run 2 render simple.json other.json -o wrong.png
run 4 render none.json -o wrong.png
run 2 render "$scenes/many_lights.json" -o wrong.png --method raster
says 'cannot be drawn by rasterising'
printf '{"camera": {"eye": [0, 0, 5], "target": [0, 0, 0]},\n "objects": [{"kind": "sphere", "centre": [0, 0, 0]}]}' >wrong.json
run 3 render wrong.json -o wrong.png
says 'wrong.json:2:43: objects[0].centre: this key is unknown here'
printf '{"camera": ' >cut.json
run 3 render cut.json -o wrong.png
says 'cut.json:1:'
run 5 render "$scenes/cut_away.json" -o wrong.png --max-memory 100K
holds 'nothing was written' test ! -e wrong.png
finish
