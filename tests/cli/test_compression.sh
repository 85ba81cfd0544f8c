#!/usr/bin/env bash
# Compressed files by name and by content, beside gzip and zstd; what is wrong with them, and the exit codes.
. tests/cli/lib.sh

compressed_by() { # TOOL EXTENSION UNPACK
  local tool=$1 ext=$2 unpack=$3
  if ! command -v "$tool" >/dev/null; then
    echo "$tool is not installed: not compared with it"
    return
  fi
  run 0 convert meshes/valid/cube.obj "$folder/cube.obj"
  run 0 convert meshes/valid/cube.obj "$folder/cube.obj.$ext"
  holds "$tool reads what is written" bash -c "$unpack <$folder/cube.obj.$ext | cmp - $folder/cube.obj"
  run 0 info "$folder/cube.obj.$ext" --json
  prints '"format": "obj"'
  # By content, whatever the name; levels; members one after the other; from a pipe.
  for level in 1 9; do
    "$tool" -c -$level <"$folder/cube.obj" >"$folder/level.bin"
    run 0 convert "$folder/level.bin" "$folder/again.obj"
    holds "level $level" cmp "$folder/again.obj" "$folder/cube.obj"
  done
  head -c 50 "$folder/cube.obj" | "$tool" -c >"$folder/two.obj"
  tail -c +51 "$folder/cube.obj" | "$tool" -c >>"$folder/two.obj"
  run 0 convert "$folder/two.obj" "$folder/again.obj"
  holds "two members" cmp "$folder/again.obj" "$folder/cube.obj"
  holds "a pipe" bash -c "'$meshtool' convert - '$folder/again.obj' <$folder/two.obj && cmp $folder/again.obj $folder/cube.obj"
  holds "a pipe that is a pipe" bash -c "cat $folder/two.obj | '$meshtool' convert - '$folder/again.obj' && cmp $folder/again.obj $folder/cube.obj"

  size=$(stat -c %s "$folder/cube.obj.$ext")
  head -c $((size - 3)) "$folder/cube.obj.$ext" >"$folder/cut.obj.$ext"
  run 3 convert "$folder/cut.obj.$ext" "$folder/none.ply"
  says "cut.obj.$ext@$((size - 3)): the file ends inside its"
  holds "no output" test ! -e "$folder/none.ply"
  "$tool" -c <"$folder/cube.obj.$ext" >"$folder/twice.obj.$ext"
  run 3 info "$folder/twice.obj.$ext"
  says "twice"
  head -c 400000000 /dev/zero | "$tool" -c >"$folder/bomb.stl.$ext"
  run 5 info "$folder/bomb.stl.$ext"
  says "expands to more than 256 times its size"
  run 5 info --max-memory 20M "$folder/bomb.stl.$ext"
  says "memory limit"
  run 2 convert meshes/valid/cube.obj "$folder/cube.$ext"
  says "no extension"
  run 0 preview meshes/valid/cube.obj -o "$folder/cube.ppm.$ext" --size 16x16
  holds "a picture" bash -c "$unpack <$folder/cube.ppm.$ext | head -c 2 | grep -q P6"
}

compressed_by gzip gz "gzip -dc"
compressed_by zstd zst "zstd -qdc"
finish
