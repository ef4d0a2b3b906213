#!/bin/sh
# Bakes scenes of samples/scenes and draws the pictures of docs/images.
#
# Usage: scripts/make_pictures.sh [PROGRAM [FOLDER]]    PROGRAM: shbake; FOLDER: where the pictures go
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
shbake=${1:-$root/shbake}
images=${2:-$root/docs/images}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$images"

# draw3 SCENE OPTIONS...: the three kinds of transfer side by side, as SCENE.png.
draw3() {
  scene=$1
  shift
  file=$root/samples/scenes/$scene.obj
  "$shbake" bake -q "$file" -o "$work/unshadowed.ply" --order 8 --transfer unshadowed
  for kind in shadowed interreflected; do
    "$shbake" bake -q "$file" -o "$work/$kind.ply" --order 8 --transfer $kind --tolerance 0.02 --rays 1024
  done
  "$shbake" render -q "$work/unshadowed.ply" "$work/shadowed.ply" "$work/interreflected.ply" -o "$images/$scene.png" "$@"
}

draw3 room --light overcast --zenith 0.5,0.62,0.8 --ground 0.25 --sun 42,200 --sun-irradiance 5,4.5,3.8 --window hann \
  --view 180,3 --fov 45 --size 420x400

draw3 columns --light overcast --zenith 0.35,0.5,0.75 --ground 0.2 --sun 45,245 --sun-irradiance 6,5.3,4.4 \
  --window lanczos --size 420x460

"$shbake" bake -q "$root/samples/scenes/city.obj" -o "$work/city.ply" --order 8 --tolerance 0.02
"$shbake" render -q "$work/city.ply" -o "$images/city.png" --light overcast --zenith 0.35,0.5,0.75 --ground 0.2 \
  --sun 32,245 --sun-irradiance 6,5.3,4.4 --window lanczos --view 190,28 --size 900x480 --ground-plane 0.2

"$shbake" render -q -o "$images/light.png" --light clear --sun 30,90 --ground 0.2 --order 5 --size 600x300 --exposure -2

# Where the axes of a light lie on a lat-long map: +x red, +y green, +z blue, the other way round paler.
"$shbake" light -q --disc 1,0,0,25,1,0.1,0.1 --disc 0,1,0,25,0.1,0.9,0.1 --disc 0,0,1,25,0.2,0.3,1 \
  --disc -1,0,0,25,0.5,0.25,0.25 --disc 0,-1,0,25,0.25,0.5,0.25 --disc 0,0,-1,25,0.25,0.25,0.5 --constant 0.02 \
  --order 32 --window hann -o "$work/axes.shlight"
"$shbake" render -q "$work/axes.shlight" -o "$images/orientation.png" --size 600x300 --exposure 0 \
  --captions '+x red centre   +y green left   +z blue top'
