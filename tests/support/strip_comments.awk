# Blanks comments, and the insides of strings and character constants, of C and C++ sources; lines keep their numbers.
# Prints FILE:LINE:text for every line of every file.
FNR == 1 { in_comment = 0 }
{
    text = ""
    rest = $0
    while (rest != "") {
        if (in_comment) {
            end = index(rest, "*/")
            if (end == 0) {
                break
            }
            in_comment = 0
            rest = " " substr(rest, end + 2)
        } else if (!match(rest, /\/\/|\/\*|"|'/)) {
            text = text rest
            break
        } else {
            text = text substr(rest, 1, RSTART - 1)
            start = substr(rest, RSTART, RLENGTH)
            rest = substr(rest, RSTART + RLENGTH)
            if (start == "//") {
                break
            } else if (start == "/*") {
                in_comment = 1
            } else if (start == "'" && text ~ /[0-9a-fA-F]$/ && rest ~ /^[0-9a-fA-F]/) {
                continue # a separator of digits
            } else if ((start == "\"" && match(rest, /^([^"\\]|\\.)*"/)) ||
                       (start == "'" && match(rest, /^([^'\\]|\\.)*'/))) {
                text = text start start
                rest = substr(rest, RSTART + RLENGTH)
            } else {
                text = text start
            }
        }
    }
    print FILENAME ":" FNR ":" text
}
