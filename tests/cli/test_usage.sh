# Wrong usage is exit 2, is said in one sentence, and happens before anything is read or written.
. tests/cli/lib.sh

run 2
says "usage: meshtool COMMAND"
silent
run 0 --version
prints "meshtool "
run 2 subdivde x
says 'unknown command "subdivde"; did you mean subdivide?'
unknown=$err
run 0 help
commands=$(printf '%s\n' "$out" | sed -n '/^Commands:/,/^$/s/^  \([a-z-]*\) .*/\1/p')
holds "help lists at least ten commands" test "$(printf '%s\n' "$commands" | wc -l)" -ge 10
err=$unknown
says "$(printf '%s\n' "$commands" | sed '$!{$!N;s/\n/, /}' | paste -sd, | sed 's/,\([^ ]\)/, \1/g; s/, \([a-z-]*\)$/ and \1/')"
run 2 frobnicate
case $err in *"did you mean"*) fail "a far name is suggested" ;; *) pass ;; esac
run 2 --json info
says "options come after it"

run 2 info
says "too few arguments"
run 2 subdivide "$folder/cube.off" extra -o "$folder/x.off"
says '"extra" is one argument too many'
run 2 subdivide "$folder/cube.off" --level 2 -o "$folder/x.off"
says 'unknown option "--level"; did you mean --levels?'
run 2 subdivide "$folder/cube.off" -z
says 'unknown option "-z"'
run 2 subdivide "$folder/cube.off" -n
says "needs a value"
run 2 info "$folder/cube.off" --json=yes
says "info: --json takes no value"
for value in -1 32 2.5 "" x 1e3 99999999999999999999; do
  run 2 subdivide "$folder/cube.off" -o "$folder/x.off" -n "$value"
  says "expects a whole number from 0 to 31"
done
for value in 0 1025 two; do
  run 2 info "$folder/cube.off" --threads "$value"
done
for value in 0 -1 K 12Q 1e400 12KiBB nan; do
  run 2 info "$folder/cube.off" --max-memory "$value"
  says "such as 512M"
done
for value in 1G 1GiB 1000MB 2g 123456789 0.5GB 123456789B; do
  run 0 info "$folder/cube.off" --max-memory "$value"
done
run 2 info "$folder/cube.off" --precision f16
says "auto, f32 or f64"
run 2 convert "$folder/cube.off" "$folder/x.ply" --encoding default
run 2 info "$folder/cube.off" --progress sometimes
run 2 info "$folder/cube.off" --from jpeg2000
says "no format that is read"
run 2 info - - --from off
says "named twice"

run 2 subdivide "$folder/cube.off"
says "give -o OUT"
run 2 preview "$folder/cube.off"
says "give -o OUT"
run 2 generate cube
run 2 convert "$folder/cube.off"
run 2 convert "$folder/cube.off" "$folder/a.ply" -o "$folder/b.ply"
says "given twice"
for size in 0x5 5x0 5 5x 5x5x5 70000x5 1.5x2 -1x5; do
  run 2 preview "$folder/cube.off" -o "$folder/x.png" --size "$size"
  says "such as 1920x1080"
done
for color in 1,2 1,2,3,4 256,0,0 -1,0,0 red; do
  run 2 preview "$folder/cube.off" -o "$folder/x.png" --background "$color"
done
run 2 preview "$folder/cube.off" -o "$folder/x.png" --samples 15
run 2 preview "$folder/cube.off" -o "$folder/x.ppm" --background transparent
says "cannot be transparent"
for turn in w,90 z 90 0,0,0,90 z,90,1 z,nan; do
  run 2 convert "$folder/cube.off" "$folder/x.ply" --rotate "$turn"
done
for scale in 0 -1 inf x; do
  run 2 convert "$folder/cube.off" "$folder/x.ply" --scale "$scale"
done
run 2 convert "$folder/cube.off" "$folder/x.ply" --translate 1,2
run 2 generate cuube -o "$folder/x.off"
says "did you mean cube?"
run 2 generate cube -o "$folder/x.off" --resolution 0

# An unknown output format fails before the input is read: the input does not even exist.
run 2 convert "$folder/none.off" "$folder/x.dwg"
says "dwg"
run 2 subdivide "$folder/none.off" -o "$folder/x"
run 2 subdivide "$folder/none.off" -o "$folder/x.off" --to xyz
run 2 preview "$folder/none.off" -o "$folder/x.off"
run 2 check-manifold "$folder/none.off" --paint "$folder/x.stl"
says "hold no colours of faces"
run 2 check-manifold "$folder/cube.off" "$folder/open.off" --paint "$folder/x.ply"

# JSON and data cannot share standard output.
for path in - /dev/stdout /dev/fd/1; do
  run 2 convert "$folder/cube.off" "$path" --to off --json
  silent
  run 2 subdivide "$folder/cube.off" -o "$path" --json
  run 2 preview "$folder/cube.off" -o "$path" --json
  run 2 generate cube -o "$path" --json
  run 2 check-manifold "$folder/cube.off" --paint "$path" --json
done
holds "nothing was written" test -z "$(find "$folder" -name 'x*')"
finish
