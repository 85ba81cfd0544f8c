# The help lists every command and every option, each with words, in lines that fit a terminal.
. tests/cli/lib.sh

run 0 --help
list=$out
run 0 help
holds "help is --help" test "$out" = "$list"
commands=$("$meshtool" help --json | grep -o '"name": "[a-z-]*", "usage"' | cut -d'"' -f4)
for command in check-manifold repair subdivide preview info convert generate formats help; do
  case " $(echo $commands) " in *" $command "*) pass ;; *) fail "$command is not in help --json" ;; esac
done
for command in $commands; do
  out=$list
  prints "  $command "
  run 0 "$command" --help
  text=$out
  prints "usage: meshtool $command"
  run 0 "$command" -h
  holds "$command -h is --help" test "$out" = "$text"
  run 0 help "$command"
  holds "help $command is $command --help" test "$out" = "$text"
  # Records of options begin with their name and letter: "name": "json", "letter": null.
  for option in $("$meshtool" help "$command" --json | grep -o '"name": "[a-z-]*", "letter"' | cut -d'"' -f4); do
    out=$text
    prints "--$option"
  done
  holds "$command: no line is longer than 100 columns" test -z "$(printf '%s\n' "$text" | grep -E '^.{101}')"
done
for option in json quiet verbose threads max-memory progress precision encoding strict-loss no-clobber force from to \
  output explain; do
  run 0 subdivide --help
  prints "--$option"
done
run 2 help nonsense
run 0 generate --help
prints "teapot"
run 0 formats
prints "Wavefront OBJ"
prints ".png"
run 0 formats --json
prints '"meshes": [{"name": '
prints '"images": [{"name": '
finish
