# Outputs: beside their place and renamed, pipes and devices written into, nothing left of a failed run.
. tests/cli/lib.sh
cd "$folder" || exit 1

# A failed run leaves the old file whole, and nothing new.
mkdir place && cd place || exit 1
echo old >kept.off
run 3 subdivide ../book.off -o kept.off
run 3 convert ../bad.off kept.off
run 5 subdivide ../cube.off -n 12 -o kept.off --max-memory 10M
holds "the old file is whole" test "$(cat kept.off)" = old
holds "nothing new stands beside it" test "$(ls -A)" = kept.off

# --no-clobber, before the work begins; -f changes nothing.
run 4 convert ../cube.off kept.off --no-clobber
says "kept.off"
run 4 generate cube -o kept.off --no-clobber
run 4 preview ../none.off -o kept.off --to png --no-clobber
holds "the old file is whole" test "$(cat kept.off)" = old
run 0 convert ../cube.off new.off --no-clobber
run 0 convert ../cube.off kept.off -f
holds "it was overwritten" cmp -s kept.off new.off
run 0 convert ../cube.off /dev/null --no-clobber
holds "/dev/null is still a device" test -c /dev/null

# What cannot work is said before the work.
run 4 convert ../none.off .
run 4 convert ../none.off missing/out.off
says "missing/out.off"

# The name of the input may be that of the output; a link stays a link.
cp ../cube.off same.off
run 0 convert same.off same.off --scale 2
ln -s same.off link.off
run 0 convert ../cube.off link.off
holds "a link stays a link" test -L link.off
holds "and its target is written" cmp -s same.off link.off

# Pipes: standard input and output, one mesh through many formats, with the command's default for "-".
"$meshtool" convert - - --from off --to obj <../cube.off 2>err | "$meshtool" convert - - --to stl 2>>err |
  "$meshtool" convert - - 2>>err | "$meshtool" info - >through.txt 2>>err
holds "a mesh goes through pipes" grep -q "8 vertices, 12 faces" through.txt
holds "and arrives as ply" grep -qi "ply" through.txt
"$meshtool" generate cube -o - | head -c 3 >magic
holds "the default for - is ply" test "$(cat magic)" = ply
"$meshtool" preview ../cube.off -o - --size 32x32 | head -c 4 | tail -c 3 >magic
holds "the default picture for - is png" test "$(cat magic)" = PNG
"$meshtool" convert ../cube.off /dev/stdout --to off >stdout.off
holds "/dev/stdout is written into" cmp -s stdout.off new.off
mkfifo pipe
cat pipe >from_pipe.off &
run 0 convert ../cube.off pipe --to off
wait $!
holds "a pipe is written into" cmp -s from_pipe.off new.off
holds "and stays a pipe" test -p pipe

# A full device is exit 4; a reader that went away too, without a word.
if [ -w /dev/full ]; then
  run 4 convert ../cube.off /dev/full
  for command in "info ../cube.off" "check-manifold ../cube.off" "formats" "help" "check-manifold ../cube.off --json"; do
    # shellcheck disable=SC2086
    "$meshtool" $command >/dev/full 2>err
    holds "$command into a full device: exit 4" test $? = 4
    holds "$command into a full device: says so" grep -q "standard output" err
  done
else
  echo "skipped: /dev/full"
fi
set -o pipefail
"$meshtool" generate torus --resolution 300 -o - 2>err | head -c 10 >/dev/null
holds "a broken pipe is no success" test $? = 4
holds "a broken pipe is no news" test ! -s err
"$meshtool" help --json 2>err | head -c 0
"$meshtool" help --json 2>err | :
holds "nor is it for text" test ! -s err
set +o pipefail

# An interrupt leaves nothing behind; standard input that never ends is the work that it meets.
run 0 generate torus --resolution 700 -o big.off
mkdir interrupted
(trap - INT && exec "$meshtool" subdivide big.off -n 3 -o interrupted/out.off 2>err) &
pid=$!
sleep 0.4
if kill -INT $pid 2>/dev/null; then
  wait $pid
  code=$?
  if [ $code = 0 ]; then
    echo "skipped: the interrupt came too late"
  else
    holds "an interrupt is exit 130, not $code" test $code = 130
    holds "and leaves nothing" test -z "$(ls -A interrupted)"
  fi
fi
finish
