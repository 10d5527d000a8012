#!/usr/bin/env bash
# Meshes in formats that are imported first: the same map as from the same vertices and faces in OFF, once imported they stay,
# and every command takes them.
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
[[ -x $VARIMAP_BIN/varimap-import ]] || { echo "skipped: built without assimp"; exit 77; }
small_picture+=("${coarse[@]}")
figure a.off 6
figure b.off 6 .5

# dae FILE.OFF: as COLLADA.
dae() {
    awk 'NR == 2 { n = $1; f = $2 } NR > 2 && NR <= n + 2 { x = x " " $0 } NR > n + 2 { p = p " " $2 " " $3 " " $4 }
        END {
            print "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">"
            print "<asset><up_axis>Y_UP</up_axis></asset><library_geometries><geometry id=\"g\"><mesh><source id=\"p\">"
            print "<float_array id=\"pa\" count=\"" 3 * n "\">" x "</float_array><technique_common>"
            print "<accessor source=\"#pa\" count=\"" n "\" stride=\"3\"><param name=\"X\" type=\"float\"/>"
            print "<param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor></technique_common></source>"
            print "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\"" f "\">"
            print "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>" p "</p></triangles></mesh></geometry>"
            print "</library_geometries><library_visual_scenes><visual_scene id=\"s\"><node id=\"n\">"
            print "<instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes>"
            print "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>"
        }' "$1"
}

# fbx FILE.OFF: as FBX that is text.
fbx() {
    awk 'NR == 2 { n = $1; f = $2 } NR > 2 && NR <= n + 2 { x = x (NR > 3 ? "," : "") $1 "," $2 "," $3 }
        NR > n + 2 { p = p (NR > n + 3 ? "," : "") $2 "," $3 "," (-1 - $4) }
        END {
            print "; FBX 7.3.0 project file\nFBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n\tFBXVersion: 7300\n}\nObjects:  {"
            print "\tGeometry: 1001, \"Geometry::\", \"Mesh\" {\n\t\tVertices: *" 3 * n " {\n\t\t\ta: " x "\n\t\t}"
            print "\t\tPolygonVertexIndex: *" 3 * f " {\n\t\t\ta: " p "\n\t\t}\n\t}"
            print "\tModel: 2001, \"Model::m\", \"Mesh\" {\n\t\tVersion: 232\n\t\tProperties70:  {\n\t\t}\n\t}\n}"
            print "Connections:  {\n\tC: \"OO\",2001,0\n\tC: \"OO\",1001,2001\n}"
        }' "$1"
}

# glb FILE.OFF [ATTRIBUTES]: as binary glTF.
glb() {
    perl -e '
        local $/;
        my $more = splice @ARGV, 1, 1;
        my (undef, $n, $f, undef, @word) = split " ", <>;
        my @face = splice @word, 3 * $n;
        my $places = pack "f<*", @word;
        my $corners = pack "V*", map { @face[4 * $_ + 1 .. 4 * $_ + 3] } 0 .. $f - 1;
        my ($p, $c) = (length $places, length $corners);
        my $json = "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
            . "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0$more},\"indices\":1}]}],\"buffers\":[{\"byteLength\":"
            . ($p + $c) . "}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":$p},{\"buffer\":0,\"byteOffset\":$p,\"byteLength\":$c}],"
            . "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":$n,\"type\":\"VEC3\",\"min\":[-9,-9,-9],"
            . "\"max\":[9,9,9]},{\"bufferView\":1,\"componentType\":5125,\"count\":" . 3 * $f . ",\"type\":\"SCALAR\"}]}";
        $json .= " " x (-length($json) % 4);
        print pack("a4VV", "glTF", 2, 28 + length($json) + $p + $c), pack("Va4", length $json, "JSON"), $json,
            pack("Va4", $p + $c, "BIN\0"), $places, $corners;' "$1" "${2:-}"
}

map a.off b.off -o plain
dae a.off >a.dae
fbx b.off >"b b.FBX"
map a.dae "b b.FBX" -o out
for table in source_to_target target_to_source; do same plain/$table.csv out/$table.csv; done
jq -e '.provenance | (.source.imported_from | endswith("/a.dae")) and (.source.file | endswith("/out/artifacts/a.obj"))
    and (.target.imported_from | endswith("/b b.FBX"))' out/quality.json >/dev/null || fail "provenance"

# Imported again, but nothing else runs; a changed file is a new mesh.
map a.dae "b b.FBX" -o out
expect_ran "import*2"
"$varimap" view out >out.txt 2>log || [[ $(<log) == *npm* || $(<log) == *viewer* ]] || fail "view"
"$varimap" transfer out --mesh out/artifacts/a.obj >out.txt 2>log || fail "transfer"
[[ -s out/transfer/source_on_target.obj ]] || fail "transfer wrote nothing"
# The scene itself serves, too: the OBJ stands for it.
for option in "--mesh a.dae" "--mesh=./a.dae"; do
    rm -r out/transfer
    # shellcheck disable=SC2086
    "$varimap" transfer out $option >out.txt 2>log || fail "transfer $option: $(tail -n 1 log)"
    [[ -s out/transfer/source_on_target.obj ]] || fail "transfer $option wrote nothing"
done
figure c.off 6 .8
fbx c.off >"b b.FBX"
map a.dae "b b.FBX" -o out
map a.off c.off -o changed
same changed/source_to_target.csv out/source_to_target.csv

# A batch takes a folder of them, too.
mkdir folder
glb a.off >folder/one.glb
glb b.off >folder/two.GLB
"$varimap" batch --all-pairs folder -o batch -j 1 "${small_picture[@]}" >out.txt 2>log || fail "batch: $(tail -n 1 log)"
grep -q '^pairs *1 of 1 done, 0 failed' out.txt || fail "batch: $(<out.txt)"

# make alone.
mkdir made
make -r -s -f "$VARIMAP_SOURCE/pipelines/Makefile" SOURCE=a.dae TARGET=c.off OUT=made until-preprocess 2>log || fail "make"
[[ -s made/artifacts/a.obj && ! -e made/artifacts/c.obj ]] || fail "make imports the wrong file"

# What cannot be read is refused in one line that names it.
echo '{"asset":{"version":"2.0"}}' >empty.gltf
head -c 3000 /dev/urandom >noise.glb
head -n 4 a.dae >cut.dae
for file in empty.gltf noise.glb cut.dae; do
    expect_exit 3 "$varimap" map $file b.off -o refused
    grep -q "error: .*$file: " log || fail "$file is not named"
done
echo hello >what.ever
expect_exit 3 "$varimap" map what.ever b.off -o refused
expect_exit 3 "$VARIMAP_BIN/varimap-verify" a.dae b.off out/source_to_target.csv
grep -q "varimap import" log || fail "verify does not say how to import"

# What is left out of a file is said, and what a file needs is named.
triangle='{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"buffers":[{"byteLength":36,
    "uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
    "bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0,"COLOR_0":0}}]}]}'
echo "$triangle" >colours.gltf
"$VARIMAP_BIN/varimap-import" colours.gltf colours.obj 2>log || fail "colours.gltf: $(tail -n 1 log)"
grep -q "note: colours.gltf: colours of vertices are left out" log || fail "colours are left out without a word"
jq '.extensionsRequired = ["FOO_bar"]' colours.gltf >needs.gltf
expect_exit 3 "$VARIMAP_BIN/varimap-import" needs.gltf needs.obj
grep -q "error: needs.gltf: .*FOO_bar" log || fail "FOO_bar is not named"

# It stands among the notes of the map, which make nothing doubtful, and a run that finds nothing else changes nothing.
glb a.off ',"COLOR_0":0' >coloured.glb
map coloured.glb b.off -o coloured --until preprocess
grep -q "^note     import coloured: $PWD/coloured.glb: colours of vertices are left out$" out.txt || fail "--until does not show what an import warns of"
map coloured.glb b.off -o coloured
grep -q "^note     import coloured: $PWD/coloured.glb: colours of vertices are left out$" out.txt || fail "the summary does not show what an import warns of"
jq -e '.notes[] | select(.stage == "import coloured" and (.message | endswith(": colours of vertices are left out")))' \
    coloured/quality.json >/dev/null || fail "quality.json does not hold what an import warns of"
report_on <coloured/quality.json | jq -e '.alarms | index("import coloured") == null' >/dev/null || fail "colours make a map doubtful"
cp coloured/quality.json before.json
map coloured.glb b.off -o coloured
same coloured/quality.json before.json

# Built without assimp: one line that says so.
mkdir without
ln -s "$VARIMAP_BIN"/varimap-* without/
rm without/varimap-import
VARIMAP_BIN=$PWD/without expect_exit 6 "$varimap" map a.dae b.off -o refused
grep -q "assimp" log || fail "assimp is not named"
VARIMAP_BIN=$PWD/without "$varimap" survey a.dae >out.txt 2>log && fail "survey takes what it cannot read"
grep -q '^"a.dae",refused,.*assimp' out.txt || fail "survey does not name assimp: $(<out.txt)"

# Quads stay quads in the exported meshes, but for those that lost a corner.
awk 'function vertex(x, y, z,    l, r, key) {
        key = x "," y "," z
        if (key in number) return number[key]
        l = sqrt(x * x + y * y + z * z)
        r = (1 + .6 * exp(4 * ((x + .3 * y + z) / l / 1.45 - 1)) + .4 * exp(6 * ((.5 * z - x + .2 * y) / l / 1.2 - 1))) / l
        printf "v %.17g %.17g %.17g\n", 1.3 * x * r, .8 * y * r, z * r
        return number[key] = ++count
    }
    function corner(axis, side, u, v) {
        return axis == 0 ? vertex(side, u, v) : axis == 1 ? vertex(v, side, u) : vertex(u, v, side)
    }
    BEGIN {
        n = 6
        for (axis = 0; axis < 3; axis++) for (side = -n; side <= n; side += 2 * n)
            for (u = -n; u < n; u += 2) for (v = -n; v < n; v += 2) {
                a = corner(axis, side, u, v); b = corner(axis, side, u + 2, v)
                c = corner(axis, side, u + 2, v + 2); d = corner(axis, side, u, v + 2)
                faces = faces "f " (side > 0 ? a " " b " " c " " d : d " " c " " b " " a) "\n"
            }
        print "v 5 nan 5\n" faces "f 1 2 3 " count + 1
    }' >quads.obj
map quads.obj b.off -o quads --ascii
[[ $(grep -c '^4 ' quads/source_on_target.ply) == 216 && $(grep -c '^3 ' quads/source_on_target.ply) == 1 ]] ||
    fail "quads are not kept"
grep -q '^element face 217$' quads/source_on_target.ply || fail "faces of the exported mesh"
[[ $(grep -c '^4 ' quads/target_on_source.ply) == 0 ]] || fail "triangles became quads"
map quads.obj b.off -o quads --ascii
expect_ran ""
