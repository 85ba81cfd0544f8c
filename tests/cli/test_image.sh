#!/usr/bin/env bash
# The command image: operations in the order given, what it prints, and its results beside netpbm and ImageMagick.
. tests/cli/lib.sh

# near FILE FILE LEVELS [MARGIN]: two binary PPM or PGM files of 8 bits differ nowhere by more, but in the margin.
near() {
  od -An -v -tu1 -w1 "$1" >"$folder/.a"
  od -An -v -tu1 -w1 "$2" >"$folder/.b"
  paste "$folder/.a" "$folder/.b" | awk -v most="$3" -v margin="${4:-0}" '
    NR == 1 { ppm = 1 }
    { bytes[NR] = $1; others[NR] = $2; if (NF != 2) bad = 1 }
    END {
      header = 0; field = 0; text = ""
      while (field < 3 && header < NR) {
        c = sprintf("%c", bytes[++header]); text = text c
        if (c == "\n" && header > 3 || c == " ") field++
      }
      split(text, parts, /[ \n]+/)
      width = parts[2]; height = parts[3]; channels = parts[1] == "P6" ? 3 : 1
      if (NR - header != width * height * channels || bad) exit 1
      for (i = header + 1; i <= NR; i++) {
        pixel = int((i - header - 1) / channels); x = pixel % width; y = int(pixel / width)
        if (x < margin || y < margin || x >= width - margin || y >= height - margin) continue
        d = bytes[i] - others[i]
        if (d > most || -d > most) { print "pixel " x "," y ": " bytes[i] " and " others[i]; exit 1 }
      }
    }'
}

# Four pixels: red, half green, blue, grey.
printf 'P3\n2 2\n255\n255 0 0  0 128 0\n0 0 255  100 100 100\n' >"$folder/four.ppm"
values() { tail -c +"$(($(head -n 3 "$1" | wc -c) + 1))" "$1" | od -An -v -tu1 | tr -s ' \n' ' ' | sed 's/^ //; s/ $//'; }
expect() { # VALUES OPTIONS...
  local wanted=$1
  shift
  run 0 image "$folder/four.ppm" "$folder/out.ppm" "$@"
  holds "$* gives $wanted, not $(values "$folder/out.ppm")" test "$(values "$folder/out.ppm")" = "$wanted"
}
expect "255 0 0 0 128 0 0 0 255 100 100 100"
expect "54 92 18 100" --gray
expect "0 255 0 0 0 128 255 0 0 100 100 100" --hue-shift 120
expect "0 255 0 0 0 128 255 0 0 100 100 100" --hue-shift -240
expect "0 255 0 0 0 128 255 0 0 100 100 100" --hue-shift 480
expect "255 128 128 64 128 64 128 128 255 100 100 100" --desaturate 0.5
expect "255 128 0 100" --bayer RGGB
expect "0 0 0 100" --bayer GBRG
expect "255 64 100 255 128 100 255 0 100 255 64 100" --bayer RGGB --demosaic RGGB
# The order of the command line counts, and operations may be repeated.
expect "54 92 18 100" --gray --hue-shift 120
expect "182 9 54 100" --hue-shift 120 --gray
expect "255 0 0 0 128 0 0 0 255 100 100 100" --hue-shift 100 --hue-shift 200 --hue-shift 60
expect "54 92 18 100" --gray --gray
# Light: red is 0.2126 of it, which is written as 127.
expect "127 109 76 100" --linear --gray
expect "255 0 0 0 128 0 0 0 255 100 100 100" --linear --srgb
expect "255 0 0 0 128 0 0 0 255 100 100 100" --linear
run 0 image "$folder/four.ppm" "$folder/light.pfm" --linear
run 0 image "$folder/light.pfm" "$folder/out.ppm"
holds "a PFM holds the numbers as they are: $(values "$folder/out.ppm")" test "$(values "$folder/out.ppm")" = "255 0 0 0 55 0 0 0 255 32 32 32"
run 0 image "$folder/light.pfm" "$folder/out.ppm" --srgb
holds "--srgb encodes them" test "$(values "$folder/out.ppm")" = "255 0 0 0 128 0 0 0 255 100 100 100"

# Alpha.
printf 'P7\nWIDTH 3\nHEIGHT 1\nDEPTH 4\nMAXVAL 255\nTUPLTYPE RGB_ALPHA\nENDHDR\n\377\0\0\0\377\0\0\200\377\0\0\377' >"$folder/alpha.pam"
run 0 image "$folder/alpha.pam" "$folder/out.ppm" --over 0,0,255
holds "over a colour: $(values "$folder/out.ppm")" test "$(values "$folder/out.ppm")" = "0 0 255 128 0 127 255 0 0"
printf 'P6\n3 1\n255\n\0\377\0\0\377\0\0\377\0' >"$folder/green.ppm"
run 0 image "$folder/alpha.pam" "$folder/out.ppm" --over "$folder/green.ppm"
holds "over a picture" test "$(values "$folder/out.ppm")" = "0 255 0 128 127 0 255 0 0"
run 0 image "$folder/alpha.pam" "$folder/out.ppm" --premultiply --drop-alpha
holds "premultiplied" test "$(values "$folder/out.ppm")" = "0 0 0 128 0 0 255 0 0"
run 0 image "$folder/alpha.pam" "$folder/out.ppm" --drop-alpha
holds "dropped" test "$(values "$folder/out.ppm")" = "255 0 0 255 0 0 255 0 0"
run 0 image "$folder/alpha.pam" "$folder/out.pam" --premultiply --unpremultiply
run 3 image "$folder/alpha.pam" "$folder/none.ppm"
says "holds no transparency"
run 3 image "$folder/alpha.pam" "$folder/none.ppm" --over "$folder/four.ppm"
says "expected the same"
run 3 image "$folder/alpha.pam" "$folder/none.ppm" --bayer RGGB
run 3 image "$folder/four.ppm" "$folder/none.ppm" --demosaic RGGB
says "3 channels"
run 4 image "$folder/alpha.pam" "$folder/none.ppm" --over "$folder/missing.png"
holds "nothing is left" test ! -e "$folder/none.ppm"

# Wrong usage, before anything is read.
run 2 image "$folder/missing.png" "$folder/out.png" --bayer RGBG
says "expects RGGB, BGGR, GRBG or GBRG"
run 2 image "$folder/missing.png" "$folder/out.xyz"
run 2 image "$folder/missing.png"
says "give -o OUT"
run 2 image "$folder/missing.png" "$folder/a.png" -o "$folder/b.png"
says "given twice"
for wrong in "--desaturate 1.5" "--desaturate x" "--hue-shift inf" "--over 1,2" "--over 0,0,256" "--bits 12" "--quality 0" "--quality 101" "--gray=1" "--from obj"; do
  run 2 image "$folder/missing.png" "$folder/out.png" $wrong
done
run 2 image "$folder/four.ppm" "$folder/none.jpg" --bits 16
many=$(printf ' --gray%.0s' $(seq 65))
run 2 image "$folder/four.ppm" "$folder/out.ppm" $many
says "at most 64 operations"
run 4 image "$folder/missing.png" "$folder/none.png"
run 4 image "$folder/four.ppm" "$folder/four.ppm" --no-clobber

# What is lost is said, refused when asked, and 8 bits from 8 are no loss.
run 0 image "$folder/four.ppm" "$folder/out.png" --hue-shift 77 --json
prints '"lost": []'
run 0 image "$folder/four.ppm" "$folder/fine.png" --bits 16
run 0 image "$folder/fine.png" "$folder/out.jpg"
says "out.jpg: JPEG of 8 bits cannot hold samples of 16 bits; this is lost"
run 0 image "$folder/fine.png" "$folder/out.png" --json
says "this is lost (--bits goes up to 16)"
prints '"lost": ["samples of 16 bits"]'
run 0 image "$folder/fine.png" "$folder/out.pfm" --strict-loss
printf 'Pf\n4 1\n-1.0\n\0\0\0\077\0\0\0\100\0\0\300\177\0\0\200\077' >"$folder/bright.pfm" # 0.5, 2, nan, 1
run 3 image "$folder/bright.pfm" "$folder/none.tiff" --bits 16 --strict-loss
says "none.tiff: Tagged Image File Format of 16 bits cannot hold floats of 32 bits and 2 samples outside 0 to 1 (clipped), and no loss is allowed"
holds "nothing is written" test ! -e "$folder/none.tiff"
run 0 image "$folder/bright.pfm" "$folder/out.tiff" --bits 32 --strict-loss
# What a format has not is wrong usage, before anything is read.
run 2 image "$folder/missing.png" "$folder/out.tiff" --quality 50
says "Tagged Image File Format has no quality"
run 2 image "$folder/missing.png" "$folder/out.pfm" --bits 16
says "is written with 32 bits a channel, not 16"
run 2 image "$folder/missing.png" "$folder/out.png" --bits 32
says "is written with 8 or 16 bits a channel, not 32"

# JSON.
run 0 image "$folder/four.ppm" "$folder/out.png" --hue-shift 30 --gray --json
prints "{\"file\": \"$folder/four.ppm\", \"format\": \"ppm\", \"width\": 2, \"height\": 2, \"channels\": 3, \"bits\": 8, \"operations\": [\"hue-shift 30\", \"gray\"], \"lost\": [], \"output\": \"$folder/out.png\"}"
run 0 image "$folder/out.png" - --to pgm
run 2 image "$folder/out.png" - --to pgm --json
run 0 formats --json
prints '{"name": "jpeg", "title": "JPEG", "extensions": ["jpg", "jpeg"], "read": true, "write": true'
run 0 preview meshes/valid/cube.obj -o "$folder/cube.jpg" --size 64x48
run 0 preview meshes/valid/cube.obj -o "$folder/cube.tiff" --size 64x48
run 0 preview meshes/valid/cube.obj -o "$folder/cube.ppm" --size 64x48
run 0 image "$folder/cube.tiff" "$folder/out.ppm"
holds "a preview as TIFF is that as PPM" cmp "$folder/out.ppm" "$folder/cube.ppm"
run 0 image "$folder/cube.jpg" "$folder/out.ppm"
holds "a preview as JPEG is near that as PPM" near "$folder/out.ppm" "$folder/cube.ppm" 40
run 0 image "$folder/cube.jpg" "$folder/small.jpg" --quality 20
holds "a lower quality is smaller" test "$(stat -c %s "$folder/small.jpg")" -lt "$(stat -c %s "$folder/cube.jpg")"
for format in png jpg tiff; do
  run 0 image "$folder/cube.ppm" "$folder/a.$format" --threads 1
  run 0 image "$folder/cube.ppm" "$folder/b.$format" --threads 2
  holds "$format is the same on two threads" cmp "$folder/a.$format" "$folder/b.$format"
done

if command -v convert >/dev/null && convert -version | grep -q ImageMagick; then
  convert -size 64x48 -seed 7 plasma:red-blue -depth 8 -type TrueColor "ppm:$folder/plasma.ppm"
  convert "$folder/plasma.ppm" -alpha set -channel A -fx i/w +channel "$folder/clear.png"
  read_as() { # WHAT FILE: reads as ImageMagick does, in 16 bits.
    convert "$2" -depth 16 "rgba:$folder/.rgba"
    if run 0 image "$2" "$folder/out.pam" --bits 16 && convert "$folder/out.pam" -depth 16 "rgba:$folder/.ours"; then
      holds "$1 reads as ImageMagick does" cmp "$folder/.rgba" "$folder/.ours"
    fi
  }
  for type in Bilevel Grayscale GrayscaleAlpha Palette PaletteAlpha TrueColor TrueColorAlpha; do
    for interlace in None PNG; do
      convert "$folder/clear.png" -type $type -depth 8 -interlace $interlace "$folder/t.png"
      read_as "$type PNG ($interlace)" "$folder/t.png"
    done
  done
  for depth in 1 2 4 8 16; do
    for interlace in None PNG; do
      convert "$folder/plasma.ppm" -colorspace gray -depth $depth -interlace $interlace "$folder/g.png"
      read_as "grey PNG of $depth bits ($interlace)" "$folder/g.png"
    done
  done
  for colors in 2 4 16 200; do
    convert "$folder/plasma.ppm" -colors $colors -type Palette -interlace PNG "$folder/p.png"
    read_as "PNG of $colors colours" "$folder/p.png"
  done
  convert "$folder/plasma.ppm" -transparent "$(convert "$folder/plasma.ppm" -format '%[pixel:p{3,4}]' info:)" -define png:color-type=2 "$folder/key.png"
  read_as "PNG with a transparent colour" "$folder/key.png"
  for options in "" "-compress lzw" "-compress zip -define tiff:tile-geometry=16x16" "-interlace plane" "-endian MSB" "-depth 16" \
    "-define tiff:rows-per-strip=5 -compress rle" "-monochrome -compress group4" "-colorspace gray" "-colors 30 -type Palette" "-define quantum:format=floating-point -depth 32" \
    "-define quantum:format=floating-point -depth 64" "-alpha set -channel A -evaluate set 50% +channel" "-colorspace gray -define quantum:polarity=min-is-white"; do
    convert "$folder/plasma.ppm" $options "$folder/t.tiff" 2>/dev/null
    read_as "TIFF with $options" "$folder/t.tiff"
  done
  for options in "" "-interlace JPEG" "-colorspace gray" "-sampling-factor 4:2:0" "-sampling-factor 4:4:4 -quality 100"; do
    convert "$folder/plasma.ppm" $options "$folder/t.jpg"
    read_as "JPEG with $options" "$folder/t.jpg"
  done
  convert "$folder/plasma.ppm" -colorspace CMYK "$folder/cmyk.jpg"
  run 3 image "$folder/cmyk.jpg" "$folder/none.png"
  says "CMYK"

  # What a file holds besides its picture is said.
  printf '\377\330\377\341\0\042Exif\0\0MM\0*\0\0\0\010\0\001\001\022\0\003\0\0\0\001\0\006\0\0\0\0\0\0' >"$folder/turned.jpg"
  tail -c +3 "$folder/cube.jpg" >>"$folder/turned.jpg"
  run 0 image "$folder/turned.jpg" "$folder/out.png"
  says "turned.jpg: Exif orientation 6 is not applied"
  holds "the right number: $(identify -format '%[EXIF:Orientation]' "$folder/turned.jpg")" \
    test "$(identify -format '%[EXIF:Orientation]' "$folder/turned.jpg")" = 6
  printf 'four' | cat "$folder/cube.jpg" - >"$folder/longer.jpg"
  run 0 image "$folder/longer.jpg" "$folder/out.png"
  says "longer.jpg: 4 bytes after the picture are ignored"
  run 0 image "$folder/cube.jpg" "$folder/out.png"
  holds "nothing besides" test -z "$err"
  convert "$folder/plasma.ppm" "$folder/plasma.ppm" "$folder/pages.tiff"
  run 0 image "$folder/pages.tiff" "$folder/out.ppm"
  says "pages.tiff: of several pictures only the first is read"
  holds "the first" cmp "$folder/out.ppm" "$folder/plasma.ppm"

  run 0 image "$folder/plasma.ppm" "$folder/ours.pgm" --gray
  convert "$folder/plasma.ppm" -grayscale Rec709Luma -depth 8 "$folder/theirs.pgm"
  holds "luminance as ImageMagick's Rec709Luma" near "$folder/ours.pgm" "$folder/theirs.pgm" 1
  run 0 image "$folder/plasma.ppm" "$folder/ours.ppm" --desaturate 0.4
  convert "$folder/plasma.ppm" -define modulate:colorspace=HSB -modulate 100,60,100 -depth 8 "$folder/theirs.ppm"
  holds "saturation as ImageMagick's HSB" near "$folder/ours.ppm" "$folder/theirs.ppm" 1
  run 0 image "$folder/plasma.ppm" "$folder/ours.ppm" --hue-shift 90
  convert "$folder/plasma.ppm" -define modulate:colorspace=HSB -modulate 100,100,150 -depth 8 "$folder/theirs.ppm"
  holds "hue as ImageMagick's HSB" near "$folder/ours.ppm" "$folder/theirs.ppm" 1
  run 0 image "$folder/clear.png" "$folder/ours.ppm" --over 10,200,30
  convert "$folder/clear.png" -background 'rgb(10,200,30)' -flatten -depth 8 "$folder/theirs.ppm"
  holds "over a colour as ImageMagick's flatten" near "$folder/ours.ppm" "$folder/theirs.ppm" 1
  run 0 image "$folder/plasma.ppm" "$folder/ours.png" --bits 16
  holds "16 bits" test "$(convert "$folder/ours.png" -format %z info:)" = 16
else
  echo "ImageMagick is not installed: not compared with it"
fi

if command -v pambayer >/dev/null && [ -e "$folder/plasma.ppm" ]; then
  # pambayer names patterns by numbers, cuts where we round, and leaves out samples towards the borders.
  while read -r pattern number; do
    run 0 image "$folder/plasma.ppm" "$folder/mosaic.pgm" --bayer "$pattern"
    run 0 image "$folder/mosaic.pgm" "$folder/ours.ppm" --demosaic "$pattern"
    pambayer -type="$number" "$folder/mosaic.pgm" 2>/dev/null | pamtopnm >"$folder/theirs.ppm"
    holds "$pattern as pambayer" near "$folder/ours.ppm" "$folder/theirs.ppm" 1 3
  done <<'END'
GBRG 1
RGGB 2
BGGR 3
GRBG 4
END
  pnmtopnm -plain "$folder/plasma.ppm" >"$folder/plain.ppm" 2>/dev/null || pnmtoplainpnm "$folder/plasma.ppm" >"$folder/plain.ppm"
  run 0 image "$folder/plain.ppm" "$folder/out.ppm"
  holds "netpbm's text" cmp "$folder/out.ppm" "$folder/plasma.ppm"
  pamtopfm "$folder/plasma.ppm" >"$folder/plasma.pfm"
  run 0 image "$folder/plasma.pfm" "$folder/out.ppm"
  holds "netpbm's PFM" cmp "$folder/out.ppm" "$folder/plasma.ppm"
else
  echo "netpbm is not installed: not compared with it"
fi
finish
