#!/bin/sh
# A short 360 degree video of people: the frames of a dataset (`airsim360 collect`), joined by img2webp (Debian package
# webp) as a process of its own. The file says that it is a full sphere and where the middle of the picture looks (XMP,
# GPano), so that viewers of panoramas can turn it.
#   tools/people/video.sh DATASET OUT.webp [HEADING_DEG] [QUALITY] [MS_A_FRAME]
set -eu
dataset="$1"; out="$2"; heading="${3:-0}"; quality="${4:-55}"; pause="${5:-100}"
for tool in img2webp webpmux; do
  command -v $tool >/dev/null || { echo "video.sh needs $tool (Debian package webp)" >&2; exit 2; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
img2webp -loop 0 -lossy -q "$quality" -m 4 -d "$pause" "$dataset"/rgb/*.png -o "$work/plain.webp"
size=$(webpmux -info "$work/plain.webp" | sed -n 's/^Canvas size: *//p')
width=${size%% *}; height=${size##* }
cat > "$work/sphere.xmp" <<XMP
<?xpacket begin="" id="W5M0MpCehiHzreSzNTczkc9d"?>
<x:xmpmeta xmlns:x="adobe:ns:meta/"><rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">
<rdf:Description rdf:about="" xmlns:GPano="http://ns.google.com/photos/1.0/panorama/"
 GPano:ProjectionType="equirectangular" GPano:UsePanoramaViewer="True"
 GPano:PoseHeadingDegrees="$heading" GPano:PosePitchDegrees="0" GPano:PoseRollDegrees="0"
 GPano:FullPanoWidthPixels="$width" GPano:FullPanoHeightPixels="$height"
 GPano:CroppedAreaImageWidthPixels="$width" GPano:CroppedAreaImageHeightPixels="$height"
 GPano:CroppedAreaLeftPixels="0" GPano:CroppedAreaTopPixels="0"/>
</rdf:RDF></x:xmpmeta><?xpacket end="w"?>
XMP
webpmux -set xmp "$work/sphere.xmp" "$work/plain.webp" -o "$out"
echo "$out: $width x $height, $(stat -c %s "$out") bytes"
