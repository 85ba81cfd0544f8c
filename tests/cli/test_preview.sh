#!/usr/bin/env bash
# Every option of preview: what it draws, what it refuses, and that both orders of drawing give the same picture of every
# mesh. Run in the project's root, with the binary in MESHTOOL.
. tests/cli/lib.sh
root=$PWD
cd "$folder" || exit 1
cp "$root"/meshes/valid/teapot.obj "$root"/meshes/valid/torus.stl .

# draws NAME OPTIONS...: writes NAME.ppm of the teapot.
draws() {
  local name=$1
  shift
  run 0 preview teapot.obj -q -o "$name.ppm" --size 64x48 --samples 4 "$@"
}
differ() { holds "$1 and $2 differ" bash -c "! cmp -s $1.ppm $2.ppm"; }
same() { holds "$1 and $2 are the same" cmp "$1.ppm" "$2.ppm"; }

draws plain
draws auto --projection perspective --view auto --shading crease --method auto --accel auto --triangle-test watertight
same plain auto

# Each option changes the picture, by rays as well, and no two of them in the same way.
options=(
  "--projection orthographic" "--projection oblique" "--projection cavalier" "--view front" "--view back" "--view left"
  "--view right" "--view top" "--view bottom" "--view iso" "--up z" "--up 1,1,0" "--eye 5,2,4" "--target 1,0,0"
  "--fov 60" "--eye 0,1,0 --fov 90" "--shading flat" "--shading smooth" "--crease 5" "--wireframe" "--color-by normal"
  "--color-by face" "--color-by component" "--color-by defect" "--color-by quality" "--color-by depth"
  "--color-by orientation" "--background 20,30,40" "--shadows" "--ground" "--ground --shadows" "--axes" "--scale-bar"
  "--samples adaptive" "--sheet" "--sheet --turntable 5")
for i in "${!options[@]}"; do
  # shellcheck disable=SC2086
  draws "o$i" ${options[$i]}
  # shellcheck disable=SC2086
  draws "r$i" ${options[$i]} --method ray
  same "o$i" "r$i"
  differ plain "o$i"
done
different=$(md5sum o*.ppm | cut -c1-32 | sort -u | wc -l)
holds "all ${#options[@]} pictures differ: $different do" test "$different" = "${#options[@]}"

draws oblique --projection oblique
draws cabinet --projection cabinet
same oblique cabinet
draws none --color-by none
same plain none # the teapot has no colours
draws up_y --up y
same plain up_y
for test in fast exact; do
  draws raster --triangle-test "$test" --method raster
  draws ray --triangle-test "$test" --method ray
  same raster ray
done
for structure in aabb obb grid bsp; do
  for test in watertight exact; do
    draws raster --triangle-test "$test" --method raster --shadows
    draws searched --triangle-test "$test" --method ray --shadows --accel "$structure"
    same raster searched
  done
done
draws one_thread --threads 1
same plain one_thread
run 0 preview "$root/meshes/valid/cube.off" -o tried.ppm --size 32x32 --method ray --accel none
run 0 preview "$root/meshes/valid/cube.off" -o drawn.ppm --size 32x32
same tried drawn

# Both orders, every mesh, three projections.
for mesh in "$root"/meshes/valid/* "$root"/meshes/non_manifold/*; do
  for projection in perspective orthographic cavalier; do
    run 0 preview -q "$mesh" -o raster.ppm --size 60x45 --samples 4 --projection $projection --method raster
    run 0 preview -q "$mesh" -o ray.ppm --size 60x45 --samples 4 --projection $projection --method ray
    same raster ray
  done
done

# The other formats, a transparent background, a turntable.
run 0 preview teapot.obj -o clear.png --size 32x32 --background transparent --ground --shadows --axes --scale-bar
run 0 preview teapot.obj -o float.pfm --size 32x32
run 0 preview torus.stl -o turn.png --size 32x32 --turntable 3 --json
prints '"pictures": 3'
for i in 1 2 3; do holds "turn-$i.png is there" test -s turn-$i.png; done
run 2 preview torus.stl -o - --turntable 3
says 'add --sheet for one picture'
run 0 preview torus.stl -o - --to ppm --size 32x32 --turntable 3 --sheet

# What the plan tells.
run 0 preview teapot.obj -o x.png --size 32x32 --explain
says 'skipped  tree'
says 'primary rays only'
says 'skipped  shadow rays'
run 0 preview teapot.obj -o x.png --size 32x32 --explain=measure
says 'saved    tree'
says 'saved    a ray for each sample'
says 'saved    shadow rays'
run 0 preview teapot.obj -o x.png --size 32x32 --shadows --explain
says 'built    surface tree'
while read -r structure part; do
  run 0 preview teapot.obj -o x.png --size 32x32 --shadows --explain --accel "$structure"
  says "built    $part"
done <<'END'
none packed triangles
aabb surface tree
obb oriented boxes
grid uniform grid
bsp BSP tree
END
run 0 preview "$root/meshes/valid/cube.off" -o x.png --size 32x32 --shadows --explain
says 'few triangles'
run 0 preview teapot.obj -o x.png --size 32x32 --scale-bar --json
prints '"scale_bar": 1'
run 0 preview teapot.obj -o x.png --size 32x32 -v --scale-bar
says 'the scale bar is 1 long'

# What is refused, before anything is read or written.
for wrong in "--projection fisheye" "--view above" "--up 0,0,0" "--up x" "--eye 1,2" "--eye 1,nan,2" "--target a,b,c" \
  "--fov 0" "--fov 180" "--fov -1" "--samples 5" "--samples 100" "--shading gouraud" "--crease 181" "--color-by red" \
  "--method both" "--accel octree" "--triangle-test quick" "--turntable 1" \
  "--turntable x" "--size 0x5" "--size 70000x5" "--background 1,2" "--background 256,0,0"; do
  # shellcheck disable=SC2086
  run 2 preview none.obj -o wrong.png $wrong
done
run 2 preview none.obj -o wrong.png --accel octree
says 'none, aabb, obb, grid or bsp'
holds 'nothing was written' test ! -e wrong.png

# Never a blank picture without a word.
run 0 preview teapot.obj -o x.png --size 32x32 --eye 50,0,0 --target 60,0,0
says 'shows nothing of the mesh'
printf 'OFF\n3 1 0\nnan 0 0\n0 nan 0\n0 0 nan\n3 0 1 2\n' >nan.off
printf 'OFF\n0 0 0\n' >empty.off
for mesh in nan empty; do
  run 3 preview $mesh.off -o wrong.png
  says 'there is nothing to see'
done
holds 'nothing was written' test ! -e wrong.png
finish
