#!/usr/bin/env bash
# Many pairs: work on a surface is done once, one failing pair stops nobody, and a batch that is interrupted ends with the same
# bytes. (killed_batch_test.sh kills.)
# shellcheck source=tests/pipeline/common.sh
. "$(dirname "$0")/common.sh"
mkdir meshes
figure meshes/a.off 6
figure meshes/b.off 6 .5
figure meshes/c.off 6 .3

batch() {  # ARGUMENTS
    "$varimap" batch "${small_picture[@]}" "${coarse[@]}" "$@" >out.txt 2>log || fail "varimap batch $* (exit $?)"
}
column() {  # FILE NAME: that column of a table without commas in its fields
    awk -F, -v name="$2" '{ gsub(/"/, "") } NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) c = i; next } { print $c }' "$1"
}
# All pairs: each surface's stages once, those of its sketch beside it; the second run starts nothing.
batch --all-pairs meshes -o all -j 2
[[ $(column all/status.csv name | xargs) == "a--b a--c b--c" && $(column all/status.csv status | sort -u) == "done" ]] || fail "status.csv"
cat all/pairs/*/log.txt all/batch/surfaces/*/log.txt >log
for count in 3:preprocess 6:coarsen 6:eigen 6:hierarchy 3:explore 3:diffuse 3:relax 3:render; do
    [[ $(grep -c "^\[${count#*:}\] done" log) == "${count%:*}" ]] || fail "${count#*:} did not run ${count%:*} times"
done
[[ $(grep -c '<article' all/index.html) == 3 ]] || fail "the contact sheet"
: >all/pairs/a--b/log.txt
batch --all-pairs meshes -o all -j 1
grep -q '3 done already' log || fail "done pairs are not known"
[[ ! -s all/pairs/a--b/log.txt ]] || fail "a finished pair was started again"
map meshes/a.off meshes/b.off -o alone "${coarse[@]}"
same all/pairs/a--b/source_to_target.csv alone/source_to_target.csv
same all/artifacts/a--b.plan alone/artifacts/a--b.plan

# How far off these maps are, of which vertex i goes to vertex i.
mkdir lists_of
for surface in a b c; do seq 0 145 >lists_of/$surface.txt; done
"$VARIMAP_SOURCE/pipelines/batch/errors" all lists_of >errors.csv 2>log || fail "errors (exit $?)"
[[ $(column errors.csv pair | grep -c -- --) == 3 ]] || fail "errors of three pairs"
grep -q '^6 of 6 maps are right' errors.csv || fail "the maps are wrong: $(tail -n 3 errors.csv)"
expect_exit 6 "$VARIMAP_SOURCE/pipelines/batch/errors" all meshes
seq 0 100 >lists_of/b.txt
expect_exit 3 "$VARIMAP_SOURCE/pipelines/batch/errors" all lists_of
grep -q '^errors: error: a--b: cannot be evaluated; are the lists numbered from 0, and of the same length?$' log || fail "a list of another length: $(<log)"
! grep -q 'no pair' out.txt || fail "pairs are done, and said not to be"
expect_exit 6 env VARIMAP_BIN="$PWD/nowhere" "$VARIMAP_SOURCE/pipelines/batch/errors" all lists_of

# The cost model, from what this batch has cost: all rows, those of which it tells nothing as they were; what landmarks called for is
# no measure of what exploration costs.
fit=$VARIMAP_SOURCE/pipelines/batch/fit model=$VARIMAP_SOURCE/pipelines/batch/cost_model.csv
"$fit" all/costs.csv >model.csv 2>log || fail "fit (exit $?)"
[[ $(cut -d , -f 1,2 model.csv) == "$(cut -d , -f 1,2 "$model")" ]] || fail "rows of the cost model: $(<model.csv)"
for stage in locate explore_if_needed; do grep -qxF "$(grep "^$stage," "$model")" model.csv || fail "$stage of the cost model: $(<model.csv)"; done
! grep -qxF "$(grep '^explore,' "$model")" model.csv || fail "a batch does not tell what exploration costs"
{ cat all/costs.csv; echo explore,a--b.landmarks.candidates,,9999,9999,9999; } >doubted.csv
"$fit" doubted.csv | diff model.csv - >log || fail "exploration with landmarks in the cost model: $(<log)"
expect_exit 2 "$fit"
expect_exit 6 "$fit" absent.csv

# A folder that is called as what jobs leave when they are killed is none of it.
mkdir all/pairs/a.tmp.b
touch all/pairs/a.tmp.b/mine all/pairs/a--b/mine.tmp.1
batch --all-pairs meshes -o all -j 1
[[ -e all/pairs/a.tmp.b/mine && ! -e all/pairs/a--b/mine.tmp.1 ]] || fail "what killed jobs left"
rm -r all/pairs/a.tmp.b

# As job arrays, by the shell of sbatch, in a folder of any name.
mkdir programs
cat >programs/sbatch <<'TEXT'
#!/usr/bin/env bash
# The tasks one after another, each by sh, as SLURM does it. In a log's name it replaces patterns, or, where there are some,
# drops backslashes; the folder that it works in goes before that as it is.
tasks=1
for ((i = 1; i < $#; ++i)); do
    next=$((i + 1))
    case ${!i} in
        --array=1-*) tasks=${!i#--array=1-} ;;
        --chdir=*) cd -- "${!i#--chdir=}" || exit ;;
        -o) log=${!next} ;;
    esac
done
for ((i = 1; i <= tasks; ++i)); do
    name=${log//%A/7} name=${name//%a/$i}
    [[ $log != *\\* ]] || name=${log//\\/}
    SLURM_ARRAY_TASK_ID=$i sh -c "${!#}" >"$name" 2>&1 || true
done
echo 7
TEXT
chmod +x programs/sbatch
mkdir few
cp meshes/a.off meshes/b.off few
arrays=$'\xc3\xb6\'s \\tables %A'
batch --all-pairs few -o "$arrays" --plan
PATH=$PWD/programs:$PATH "$VARIMAP_SOURCE/pipelines/batch/slurm" "$arrays" 08 >out.txt 2>log || fail "job arrays (exit $?)"
[[ $(<out.txt) == "7 7 7" ]] || fail "numbers of the jobs: $(<out.txt)"
[[ $(column "$arrays/status.csv" status) == "done" ]] || fail "job arrays: $(cat "$arrays"/batch/*.log)"
for log in slurm-7_1.log report.log; do [[ -e $arrays/batch/$log ]] || fail "$log of job arrays: $(ls "$arrays/batch")"; done
same "$arrays/pairs/a--b/source_to_target.csv" all/pairs/a--b/source_to_target.csv
batch --all-pairs few -o "$arrays" --plan
! grep -q . "$arrays/batch/pending" || fail "what job arrays have done is not known"

# Who holds OUT is told to whoever waits for it.
exec {held}>all/.lock
flock $held
"$varimap" batch "${small_picture[@]}" "${coarse[@]}" --all-pairs meshes -o all -j 1 >out.txt 2>log {held}>&- &
until grep -q 'waiting for another run' log || ! kill -0 $! 2>/dev/null; do sleep .05; done
exec {held}>&-
wait $! || fail "a batch that waited (exit $?)"
grep -q '^batch: the other run is process [0-9]* on .*, kill -- -[0-9]* ends these$' log || fail "who holds OUT: $(cat log)"

# What separates columns the first line tells.
for separator in ',' ';' $'\t'; do
    printf 'source%starget\n%s\n' "$separator" "meshes/a.off${separator}meshes/b.off" >separated.csv
    batch separated.csv -o separated --plan
    cut -d ' ' -f 1,2 separated/batch/pending >"separated as $(printf %d "'$separator").txt"
done
[[ $(cat separated\ as\ *.txt | sort | uniq -c | awk '$1 == 3 { print $2, $3 }' | xargs) == "pair a--b surface a surface b" ]] ||
    fail "lists with semicolons or tabs: $(cat separated\ as\ *.txt)"

# What is replaced while a batch runs is not done, and told.
mkdir moving
cp meshes/a.off meshes/b.off moving
batch --all-pairs moving -o moved --plan
cp meshes/c.off moving/b.off
"$VARIMAP_SOURCE/pipelines/batch/job" "$PWD/moved" surface b >out.txt 2>log || fail "the job of a changed surface (exit $?)"
[[ ! -e moved/batch/surfaces/b/result ]] || fail "a changed surface is called done"
"$VARIMAP_SOURCE/pipelines/batch/job" "$PWD/moved" pair a--b >out.txt 2>log || fail "the job of a changed pair (exit $?)"
jq -e --arg file "$(readlink -f moving/b.off)" '.status == "failed" and .code == 4
    and .message == "batch: error: \($file): changed while the batch ran; start it again"' moved/pairs/a--b/result.json >/dev/null ||
    fail "a mesh that changed: $(<moved/pairs/a--b/result.json)"

# A pair whose folder cannot be made has failed, and says why.
rm -r moved/pairs/a--b
touch moved/pairs/a--b
code=0
"$varimap" batch "${small_picture[@]}" "${coarse[@]}" --all-pairs moving -o moved -j 1 >out.txt 2>log || code=$?
((code == 1)) || fail "exit $code with a folder that cannot be made"
[[ $(column moved/status.csv status) == failed && $(column moved/status.csv code) == 6 ]] || fail "a folder that cannot be made: $(<moved/status.csv)"
grep -q '^failed   a--b: batch: error: .*/moved/pairs/a--b: cannot be written' out.txt || fail "a folder that cannot be made is not said"
rm moved/pairs/a--b
batch --all-pairs moving -o moved -j 1
same moved/pairs/a--b/source_to_target.csv all/pairs/a--c/source_to_target.csv

# A folder of meshes and maps may be moved as a whole.
mkdir project
mv moving moved project
batch --all-pairs project/moving -o project/moved -j 1
mv project elsewhere
"$varimap" report elsewhere/moved/pairs/a--b >out.txt 2>log || fail "a report of a batch that was moved"
! grep -q 'not there' out.txt || fail "meshes that were moved with a batch: $(grep 'not there' out.txt)"
echo 0 >zero.txt
"$varimap" transfer elsewhere/moved/pairs/a--b --points zero.txt -o zero >out.txt 2>log || fail "transfer of a batch that was moved: $(cat log)"

# gltf OFF NAME: the mesh as scenes/NAME.gltf, with its numbers in scenes/parts/NAME.bin.
gltf() {
    local vertices faces
    read -r vertices faces _ < <(sed -n 2p "$1")
    mkdir -p scenes/parts
    printf '%b' "$(awk '
        function bytes(number, n) { for (; n--; number = int(number / 256)) printf "\\0%03o", number % 256 }
        function float(x,    sign, e) {
            sign = x < 0; if (sign) x = -x
            if (!x) return 0
            e = int(log(x) / log(2) + 200) - 200
            return sign * 2 ^ 31 + (e + 127) * 2 ^ 23 + int((x / 2 ^ e - 1) * 2 ^ 23)
        }
        NR > 2 && NF == 3 { for (i = 1; i <= 3; i++) bytes(float($i), 4) }
        NR > 2 && NF == 4 { for (i = 2; i <= 4; i++) bytes($i, 2) }' "$1")" >"scenes/parts/$2.bin"
    jq -n --argjson v "$vertices" --argjson f "$faces" --arg name "$2" '{asset: {version: "2.0"}, scene: 0, scenes: [{nodes: [0]}],
        nodes: [{mesh: 0}], meshes: [{primitives: [{attributes: {POSITION: 0}, indices: 1}]}],
        buffers: [{uri: "parts/\($name).bin", byteLength: (12 * $v + 6 * $f)}],
        bufferViews: [{buffer: 0, byteLength: (12 * $v)}, {buffer: 0, byteOffset: (12 * $v), byteLength: (6 * $f)}],
        accessors: [{bufferView: 0, componentType: 5126, count: $v, type: "VEC3", min: [-9, -9, -9], max: [9, 9, 9]},
            {bufferView: 1, componentType: 5123, count: (3 * $f), type: "SCALAR"}]}' >"scenes/$2.gltf"
}
# A mesh whose points are in a file beside it, under another name, and that file changed.
if [[ -x $VARIMAP_BIN/varimap-import ]]; then
    gltf meshes/a.off a
    gltf meshes/b.off b
    printf 'mesh,name\nscenes/a.gltf,one\nscenes/b.gltf,\n' >scenes.csv
    batch scenes.csv -o imported -j 1
    [[ $(column imported/status.csv name) == one--b && $(column imported/status.csv status) == "done" ]] || fail "scenes: $(<imported/status.csv)"
    jq -e '.provenance.source.imported_from | endswith("/scenes/a.gltf")' imported/pairs/one--b/quality.json >/dev/null || fail "what was imported"
    batch scenes.csv -o imported --plan
    ! grep -q . imported/batch/pending || fail "a batch of scenes is not known to be done"
    "$varimap" report imported/pairs/one--b >out.txt 2>log || fail "report of scenes: $(<log)"
    ! grep '^verdict ' out.txt | grep 'not there\|no longer\|changed' || fail "report of scenes as they were: $(<out.txt)"
    gltf meshes/c.off b
    "$varimap" report imported/pairs/one--b >out.txt 2>log || fail "report of a scene that was replaced: $(<log)"
    grep -q '^verdict  look here: .*b.gltf: is no longer the scene that was mapped' out.txt || fail "report of a scene that was replaced: $(<out.txt)"
    batch scenes.csv -o imported --plan
    [[ $(cut -d ' ' -f 1,2 imported/batch/pending | xargs) == "pair one--b surface b" ]] || fail "a changed buffer: $(<imported/batch/pending)"
    # What was imported is found, or imported again, where the folder was moved.
    "$varimap" register "${small_picture[@]}" "${coarse[@]}" meshes/b.off scenes/a.gltf -o registered -j 1 >out.txt 2>log || fail "register of a scene: $(<log)"
    cp registered/specimens/a.csv before.csv
    mv registered elsewhere
    for try in "in a folder that was moved" "whose import is gone"; do
        "$varimap" register "${small_picture[@]}" "${coarse[@]}" meshes/b.off scenes/a.gltf -o elsewhere -j 1 >out.txt 2>log || fail "register of a scene $try: $(<log)"
        same elsewhere/specimens/a.csv before.csv
        rm elsewhere/maps/artifacts/a.obj
    done
fi

# As far as a stage, and then on.
map meshes/a.off meshes/b.off -o part "${coarse[@]}" --until diffuse
[[ -s part/artifacts/a--b.diffusion && ! -e part/artifacts/a--b.plan && ! -e part/quality.json ]] || fail "--until diffuse"
"$varimap" map meshes/a.off meshes/b.off -o part "${small_picture[@]}" "${coarse[@]}" --until diffuse --json >out.txt 2>log || fail "--until diffuse --json"
jq -e '.until == "diffuse" and (.warnings | type == "array")' out.txt >/dev/null || fail "--until diffuse --json: $(<out.txt)"
map meshes/a.off meshes/b.off -o part "${coarse[@]}"
expect_ran "refine relax remesh render"
same_results alone part
expect_exit 2 "$varimap" map meshes/a.off meshes/b.off -o part --until plan
expect_exit 2 "$varimap" batch --all-pairs meshes -o none --plan --landmark-weight .2
grep -q -- '--landmark-weight: none of the pairs has landmarks' log || fail "an option of landmarks without any: $(<log)"
printf 'source,target,mirror\na.off,b.off,yes\nb.off,a.off,\n' >meshes/mirrored.csv
"$varimap" batch meshes/mirrored.csv -o mirrored --plan >/dev/null 2>log || fail "a list with mirrored pairs: $(<log)"
[[ $(cut -f 1,7 mirrored/batch/pairs.tsv | xargs) == 'a--b yes b--a -' ]] || fail "which pair is mirrored"
sed -i 's/yes/true/' meshes/mirrored.csv
expect_exit 3 "$varimap" batch meshes/mirrored.csv -o mirrored --plan
grep -q 'mirror is true; say yes or no' log || fail "what a column takes"
rm meshes/mirrored.csv

# One job at a time where memory is for one only, and the same bytes.
narrow="out of \$HOME & 'more'"
batch --all-pairs meshes -o "$narrow" -j 2 --memory 60
same_batch all "$narrow"

# A list of pairs, with names, landmarks, quotes and folders; a mesh that is none fails alone, and says why.
echo nonsense >meshes/broken.off
landmarks_of_figure meshes/a.off >tips.txt
head -n 3 tips.txt | cut -d ' ' -f 1 >three.txt
mkdir lists
cat >lists/pairs.csv <<'TEXT'
name,source,target,landmarks,source_landmarks,target_landmarks,remark
# with tips
tips,"meshes/a.off",meshes/b.off,tips.txt,,,"a, ""b"""

three,meshes/c.off,meshes/a.off,,three.txt,three.txt,
bad,meshes/a.off,meshes/broken.off,,,,
none,meshes/a.off,meshes/c.off,,,,
TEXT
expect_list() {
    local code=0
    "$varimap" batch "${small_picture[@]}" "${coarse[@]}" lists/pairs.csv -o listed -j 2 >out.txt 2>log || code=$?
    ((code == 1)) || fail "exit $code, not 1, with a pair that fails"
    [[ $(column listed/status.csv status | xargs) == "done done failed done" ]] || fail "status of the list"
    grep -q '^failed   bad: .*broken.off' out.txt || fail "the summary does not say what failed"
}
expect_list
[[ $(column listed/status.csv code | xargs) == "0 0 3 0" ]] || fail "codes of the list"
jq -e '.landmarks | length == 5' listed/pairs/tips/quality.json >/dev/null || fail "landmarks of a pair"
jq -e '.landmarks | length == 3' listed/pairs/three/quality.json >/dev/null || fail "two lists of a pair"
same listed/pairs/none/source_to_target.csv all/pairs/a--c/source_to_target.csv
# Changed landmarks run their pair alone.
stamp=$(stat -c %y listed/pairs/tips/result.json)
head -n 2 three.txt >fewer.txt
mv fewer.txt three.txt
expect_list
grep -q '2 done already' log || fail "changed landmarks"
jq -e '.landmarks | length == 2' listed/pairs/three/quality.json >/dev/null || fail "changed landmarks were not used"
[[ $(stat -c %y listed/pairs/tips/result.json) == "$stamp" ]] || fail "other pairs ran too"
rm meshes/broken.off
# A small probability is not called none, nor a large one 1.
jq -c '.sure = false | .probability = 0 | .badness = 2' listed/pairs/none/result.json >result.json && mv result.json listed/pairs/none
jq -c '.sure = true | .probability = 1' listed/pairs/tips/result.json >result.json && mv result.json listed/pairs/tips
"$VARIMAP_SOURCE/pipelines/batch/report" listed >out.txt 2>log || true
grep -q '^look at  none: .*, not sure (below 0.01), ' out.txt || fail "a small probability in the summary"
grep -q 'not sure</a> (below 0.01)' listed/index.html || fail "a small probability in the sheet"
grep -q 'sure (above 0.99)' listed/index.html || fail "a large probability in the sheet"

# A template and its specimens, with landmarks that are found by name. Then a damaged artifact.
mkdir points
cut -d ' ' -f 1 tips.txt | tee points/a.txt >points/c.txt
batch --star meshes/b.off meshes -o star --landmarks-from points -j 2
[[ $(column star/status.csv name | xargs) == "b--a b--c" ]] || fail "pairs of a template"
cp points/a.txt points/a.vts
batch --star meshes/b.off meshes -o star --landmarks-from points -j 2
grep -q '^batch: warning: points: landmarks are read from a.txt, not from a.vts$' log || fail "two files of landmarks for one mesh"
rm points/a.vts
mkdir same
cp meshes/c.off same/a.off
printf 'source,target\nmeshes/b.off,meshes/a.off\nmeshes/b.off,same/a.off\n' >same.csv
expect_exit 3 "$varimap" batch same.csv -o none --landmarks-from points
grep -q 'same/a.off: .*meshes/a.off has the same landmarks by its name, a.txt; rename one' log || fail "two meshes with one file of landmarks"
head -c 100 all/artifacts/b.basis >short
cp short all/artifacts/b.basis
batch --all-pairs meshes -o all --check -j 2
same_batch "$narrow" all
grep -q "b.basis' is damaged.*making it anew" all/batch/surfaces/b/log.txt || fail "a damaged artifact is not said"

# Loops of three: these close with the first maps, which stay.
batch --all-pairs meshes -o together --consistent -j 2
[[ $(column together/cycles.csv name | xargs) == "a--b a--c b--c" && $(column together/cycles.csv candidate | sort -u) == 1 ]] ||
    fail "cycles.csv"
[[ $(column together/cycles.csv loops | sort -u) == 1 && $(column together/cycles.csv closed | sort -u) == 1 ]] || fail "loops do not close"
grep -q '^cycles   100 % of the loops' out.txt || fail "loops are not told"
same together/pairs/b--c/source_to_target.csv all/pairs/b--c/source_to_target.csv
batch --all-pairs meshes -o together --consistent -j 2
grep -q '3 done already' log || fail "consistent pairs are not known"
# One that was continued from another map than is chosen now is done again, alone.
jq -c '.candidate = "2"' together/pairs/a--c/result.json >result
mv result together/pairs/a--c/result.json
for pair in together/pairs/*; do : >"$pair/log.txt"; done
batch --all-pairs meshes -o together --consistent -j 2
[[ -s together/pairs/a--c/log.txt && ! -s together/pairs/a--b/log.txt ]] || fail "a pair whose choice changed"
[[ $(jq -r .candidate together/pairs/a--c/result.json) == 1 ]] || fail "the map that is chosen now"

# A composed map is the way that a pair begins with; another choice, and the pair is done again.
mkdir -p together/batch/composed
cp all/pairs/a--b/source_to_target.csv together/batch/composed/a--b.csv
printf 'a--b\tcomposed-0123456789abcdef\n' >together/batch/candidates.tsv
"$VARIMAP_SOURCE/pipelines/batch/job" "$PWD/together" pair a--b 1 >out.txt 2>log || fail "the job of a composed pair (exit $?)"
[[ $(jq -r '.candidate, .status' together/pairs/a--b/result.json | xargs) == "composed-0123456789abcdef done" ]] || fail "a composed pair"
jq -e '.exploration == null' together/pairs/a--b/quality.json >/dev/null || fail "a composed pair was explored"
batch --all-pairs meshes -o together --consistent -j 2
same together/pairs/a--b/source_to_target.csv all/pairs/a--b/source_to_target.csv

# A part and two wholes: what places it is of the pairs; maps are those of each pair alone.
mkdir wholes tips
figure rest.off 12
figure wholes/d.off 12 .3
figure wholes/e.off 12 .2
upper_part rest.off >upper.off
landmarks_of_figure rest.off | sed -n '1p;2p;5p' | cut -d ' ' -f 1 | tee tips/upper.txt tips/d.txt >tips/e.txt
"$varimap" batch "${small_picture[@]}" --star upper.off wholes --landmarks-from tips --part source --fill-holes 3 -o parts -j 1 >out.txt 2>log ||
    fail "a batch of parts (exit $?)"
[[ $(column parts/status.csv status | xargs) == "done done" ]] || fail "status of parts: $(<parts/status.csv)"
column parts/status.csv strain | awk '!($1 > 0 && $1 < .1) { exit 1 }' || fail "strain of parts: $(<parts/status.csv)"
[[ -z $(column all/status.csv strain | xargs) ]] || fail "strain without parts: $(<all/status.csv)"
jq -e '.part.is == "source" and .part.strain < .1' parts/pairs/upper--d/quality.json >/dev/null || fail "a batch does not place parts"
map upper.off wholes/d.off -o part_alone --landmarks tips/upper.txt tips/d.txt --part source --fill-holes 3
same parts/pairs/upper--d/source_to_target.csv part_alone/source_to_target.csv
"$varimap" batch "${small_picture[@]}" --star upper.off wholes --landmarks-from tips --part source --fill-holes 3 -o parts --plan >out.txt 2>log ||
    fail "--plan of parts"
! grep -q . parts/batch/pending || fail "finished parts are not known: $(<parts/batch/pending)"
grep -q '^pair upper--d locate [1-9]' parts/batch/costs || fail "placing parts costs nothing"
# In a list each pair says so itself, and needs no landmarks.
printf 'source,target,part\nupper.off,wholes/d.off,source\nwholes/e.off,wholes/d.off,\n' >lists/parts.csv
"$varimap" batch "${coarse[@]}" lists/parts.csv -o listed -j 2 >out.txt 2>log || fail "a list of parts (exit $?)"
jq -e '.part.is == "source"' listed/pairs/upper--d/quality.json >/dev/null || fail "a list does not say what is a part"
jq -e '.part == null and .exploration != null' listed/pairs/e--d/quality.json >/dev/null || fail "a whole pair beside a part"
"$varimap" batch "${coarse[@]}" lists/parts.csv -o listed --plan >out.txt 2>log || fail "--plan of a list of parts"
! grep -q . listed/batch/pending || fail "finished parts of a list are not known"
cut -d ' ' -f 1-3 listed/batch/costs | grep '^pair' | grep -E 'locate|explore' | xargs -n 3 | diff - <(printf 'pair upper--d locate\npair e--d explore\n') ||
    fail "what a part and a whole cost"
"$VARIMAP_SOURCE/pipelines/batch/job" "$PWD/listed" pair e--d 1 locate >out.txt 2>log || fail "nothing to locate (exit $?)"
grep -q $'^pair:locate\te--d\t0\t' out.txt || fail "a whole pair has nothing to locate"
sed 's/source$/both/' lists/parts.csv >lists/bad_parts.csv
expect_exit 3 "$varimap" batch lists/bad_parts.csv -o none --plan
grep -q 'part is both; say source or target' log || fail "a part that is neither is not told"
expect_exit 2 "$varimap" batch lists/parts.csv -o none --plan --consistent
expect_exit 2 "$varimap" batch --star upper.off wholes -o none --plan --part
expect_exit 2 "$varimap" batch --star upper.off wholes -o none --plan --part whole
expect_exit 2 "$varimap" batch --star upper.off wholes -o none --plan --part source --fill-holes all
expect_exit 2 "$varimap" batch --star upper.off wholes -o none --plan --part source --consistent

# Bad input: one line, and nothing is made.
expect_exit 2 "$varimap" batch
expect_exit 2 "$varimap" batch lists/pairs.csv
expect_exit 2 "$varimap" batch --star meshes/a.off -o none
expect_exit 2 "$varimap" batch lists/pairs.csv -o none --memory much
# Options of maps are looked at before anything is done.
printf '[eigen]\ncuont = 3\n' >bad.toml
for option in --set=eigen.cout=3 --set=eigen.count=many --area-bound=0.5 --config=bad.toml --fill-holes=some --landmark-weight=2; do
    expect_exit 2 "$varimap" batch --all-pairs meshes -o none --plan $option
done
grep -q '^batch: error: --landmark-weight 2: ' log || fail "a wrong option is not said: $(<log)"
expect_exit 2 "$varimap" batch --all-pairs meshes -o none --set eigen.count=abc
grep -q '^batch: error: --set eigen.count=abc: ' log || fail "which stage has no such value is not said: $(<log)"
expect_exit 2 "$varimap" batch --all-pairs meshes -o none -j 9999
printf 'source,target,name\nmeshes/a.off,meshes/b.off,%0201d\n' 1 >long.csv
expect_exit 3 "$varimap" batch long.csv -o none
mkdir own
cp -r meshes own
expect_exit 2 "$varimap" batch --all-pairs own/meshes -o own --plan
same own/meshes/a.off meshes/a.off
expect_exit 6 "$varimap" batch absent.csv -o none
expect_exit 6 "$varimap" batch lists/pairs.csv -o none
printf 'a,b\n1,2\n' >columns.csv
expect_exit 3 "$varimap" batch columns.csv -o none
printf 'source,target\nmeshes/a.off,meshes/b.off\nmeshes/a.off,meshes/b.off\n' >twice.csv
expect_exit 3 "$varimap" batch twice.csv -o none
printf 'mesh,name\n"meshes/a.off,x\n' >quotes.csv
expect_exit 3 "$varimap" batch quotes.csv -o none
cp meshes/a.off bare
printf 'source,target\nbare,meshes/b.off\n' >bare.csv
expect_exit 3 "$varimap" batch bare.csv -o none
grep -q '^batch: error: .*/bare: a name without an ending' log || fail "a mesh without an ending: $(<log)"
echo '0 0' >'back\slash.txt'
printf 'source,target,landmarks\nmeshes/a.off,meshes/b.off,back\\slash.txt\n' >slash.csv
expect_exit 3 "$varimap" batch slash.csv -o none
printf 'source,target,source_landmarks\nmeshes/a.off,meshes/b.off,one.txt\n' >one_side.csv
echo 0 >one.txt
expect_exit 3 "$varimap" batch one_side.csv -o none
printf 'source,target\nmeshes/a.off,meshes/b.off\n' >pair.csv
expect_exit 2 "$varimap" batch pair.csv -o none --directed
expect_exit 2 "$varimap" batch --star meshes/a.off meshes -o none --directed
printf 'source,target,mesh\nmeshes/a.off,meshes/b.off,meshes/c.off\n' >both.csv
expect_exit 3 "$varimap" batch both.csv -o none
grep -q '^batch: error: both.csv: a row with mesh as well as source or target: ' log || fail "a row of a pair and a mesh"
printf 'source,target\nmeshes/a.off,meshes/b.off,one.txt\n' >beyond.csv
expect_exit 3 "$varimap" batch beyond.csv -o none
grep -q '^batch: error: beyond.csv: a row with more fields than columns: ' log || fail "a field beyond the columns"
printf 'source,target,source\nmeshes/a.off,meshes/b.off,meshes/c.off\n' >column_twice.csv
expect_exit 3 "$varimap" batch column_twice.csv -o none
grep -q '^batch: error: column_twice.csv: .* names the column source twice' log || fail "a column that is there twice"
mkdir dangling
cp meshes/a.off meshes/b.off dangling
ln -s absent.off dangling/c.off
for command in "batch -o none --all-pairs" survey; do
    # shellcheck disable=SC2086
    expect_exit 6 "$varimap" $command dangling
    grep -q 'error: .*dangling/c.off: no such file' log || fail "$command passes over a link that leads nowhere"
done
mkdir named
cp one.txt named/nobody.txt
expect_exit 3 "$varimap" batch --all-pairs meshes -o none --landmarks-from named
grep -q 'named: no landmarks by the name of any of the 3 surfaces; name those of a.off a with .mrk.json, .fcsv, .pp, .pts, .txt, .csv or .vts$' log ||
    fail "what landmarks are to be called is not said: $(<log)"
[[ ! -e none ]] || fail "a refused batch left files"
cp one.txt named/a.txt
"$varimap" batch --all-pairs meshes -o planned --plan --landmarks-from named >out.txt 2>log || fail "--plan with landmarks"
grep -q 'no landmarks for . of . surfaces' log || fail "who has no landmarks is not said"
! grep -q 'files of other names' log || fail "files are named that begin as no mesh does: $(<log)"
# Those that may be a mesh's, though called otherwise; not another's, nor what holds no landmarks.
touch named/b_left.txt named/b-right.csv named/b_skin.png named/bc.txt
"$varimap" batch --all-pairs meshes -o planned --plan --landmarks-from named >out.txt 2>log || fail "--plan with landmarks"
grep -q 'no landmarks for 2 of 3 surfaces (b, c);.*; there are files of other names: b-right.csv, b_left.txt$' log ||
    fail "landmarks of other names are not said: $(<log)"
printf 'mesh,landmarks\nmeshes/a.off,one.txt\nmeshes/b.off,one.txt\nmeshes/a.off,three.txt\n' >twice_picked.csv
expect_exit 3 "$varimap" batch twice_picked.csv -o none --plan
grep -q 'meshes/a.off: is listed with two files of landmarks, .*/one.txt and .*/three.txt; list it with one$' log || fail "two files of landmarks: $(<log)"
"$varimap" batch --all-pairs meshes -o planned --plan >out.txt 2>log || fail "--plan"
grep -q 'core-hours for 3 surfaces and 3 pairs' out.txt || fail "what a batch will cost"
[[ -z $(ls planned/pairs) ]] || fail "--plan runs something"
"$varimap" batch --all-pairs meshes -o planned --plan --consistent >out.txt 2>log || fail "--plan --consistent"
grep -q '^batch: warning: --consistent with --plan: .* run this command once more without --plan' log || fail "what comes after --plan --consistent"
if ! command -v sbatch >/dev/null; then
    expect_exit 6 "$VARIMAP_SOURCE/pipelines/batch/slurm" planned
    grep -q 'apt-get install slurm-client' log || fail "which package has sbatch"
fi
# Files that are not links of its own stay; who is called otherwise than asked for is told.
touch planned/meshes/a.txt planned/meshes/a.ply
printf 'name,mesh,source,target\nz.1,meshes/a.off,,\nz_1,meshes/b.off,,\nx,meshes/a.off,,\n' >names.csv
"$varimap" batch names.csv -o planned --plan >out.txt 2>log || fail "--plan with names"
grep -q '^batch: warning: other names, .*: z.1 is z_1, z_1 is z_1-2;' log || fail "other names are not told: $(<log)"
grep -q '^batch: warning: .* twice have one name: x is z_1$' log || fail "a second name is not told: $(<log)"
[[ $(sed -n 3p planned/surfaces.csv) == "z_1-2,\"$PWD/meshes/b.off\"" ]] || fail "surfaces.csv: $(<planned/surfaces.csv)"
echo ,,meshes/a.off,meshes/c.off >>names.csv
"$varimap" batch names.csv -o planned --plan >out.txt 2>log || fail "--plan with rows of both kinds"
grep -q '^batch: warning: names.csv: rows of a mesh alone, beside rows of pairs: 3,' log || fail "rows that count for nothing: $(<log)"
"$varimap" batch --all-pairs meshes -o planned --plan >out.txt 2>log || fail "--plan"
[[ -e planned/meshes/a.txt && ! -L planned/meshes/a.ply && -L planned/meshes/a.off ]] || fail "files in OUT/meshes"
"$varimap" batch --star meshes/b.off meshes -o planned --landmarks-from points --plan --cut-handles none --fill-holes=30 >out.txt 2>log ||
    fail "--plan with landmarks"
tr '\n' ' ' <planned/batch/options | grep -q -- '--cut-handles none --fill-holes 30 ' || fail "repairs of all surfaces of a batch"
grep -q '^pair b--a explore [1-9]' planned/batch/costs || fail "exploration with few landmarks costs nothing"
# Names that begin with none of our letters.
mkdir foreign
for mesh in éa _b '(c)' ' d' -e; do cp meshes/a.off "foreign/$mesh.off"; done
"$varimap" batch --all-pairs foreign -o planned --plan >out.txt 2>log || fail "--plan with foreign letters: $(<log)"
[[ $(tail -n +2 planned/surfaces.csv | cut -d , -f 1 | sort | xargs) == "__a _b _c_ _d e" ]] || fail "foreign names: $(<planned/surfaces.csv)"
printf 'source,target,name\nmeshes/a.off,meshes/b.off,.x\n' >dotted.csv
expect_exit 3 "$varimap" batch dotted.csv -o planned --plan
"$varimap" batch --star meshes/b.off meshes -o planned --landmarks-from points --plan >out.txt 2>log || fail "--plan of a star"
# A job finds its row by name, or at the byte that the plan tells; what is not in the plan is refused.
while read -r kind job _ _ byte; do
    [[ $(tail -c "+$byte" "planned/batch/${kind}s.tsv" | cut -f 1 | head -n 1) == "$job" ]] || fail "the row of $job"
done <planned/batch/pending
expect_exit 2 "$VARIMAP_SOURCE/pipelines/batch/job" "$PWD/planned" pair a--b

# Lists of pairs and of surfaces find the landmarks too; those that a list names go before them.
landmarks_in() { cut -f 4,5 planned/batch/pairs.tsv | sed 's|[^\t]*/||g' | tr '\t\n' '  '; }
expect_landmarks() {  # EXPECTED ARGUMENTS
    "$varimap" batch "${@:2}" -o planned --landmarks-from points --plan >out.txt 2>log || fail "--plan ${*:2} with landmarks"
    [[ $(landmarks_in) == "$1 " ]] || fail "landmarks of ${*:2}: $(landmarks_in)"
}
printf 'source,target,landmarks\nmeshes/a.off,meshes/c.off,\nmeshes/c.off,meshes/a.off,tips.txt\nmeshes/a.off,meshes/b.off,\n' >some.csv
expect_landmarks "a.txt c.txt tips.txt - - -" some.csv
grep -q 'no landmarks for 1 of 3 surfaces (b)' log || fail "which surface of a list has no landmarks is not said"
printf 'mesh,landmarks\nmeshes/a.off,\nmeshes/b.off,three.txt\nmeshes/c.off,\n' >surfaces.csv
expect_landmarks "a.txt three.txt a.txt c.txt three.txt c.txt" surfaces.csv
expect_landmarks "three.txt a.txt three.txt c.txt" --star meshes/b.off surfaces.csv
# Without --landmarks-from those that lack them are named, too; capitals, blanks and dashes of a heading do not matter.
printf 'Mesh,Landmarks\nmeshes/a.off,\nmeshes/b.off,three.txt\nmeshes/c.off,three.txt\n' >surfaces.csv
"$varimap" batch surfaces.csv -o planned --plan >out.txt 2>log || fail "--plan of surfaces with landmarks: $(<log)"
[[ $(landmarks_in) == "- - - - three.txt three.txt " ]] || fail "landmarks of a list of surfaces: $(landmarks_in)"
grep -q 'surfaces.csv: no landmarks for 1 of 3 surfaces (a)' log || fail "which surface of a list has no landmarks is not said: $(<log)"
printf 'source,target,Source Landmarks,target-landmarks\nmeshes/a.off,meshes/b.off,tips.txt,three.txt\n' >headings.csv
"$varimap" batch headings.csv -o planned --plan >out.txt 2>log || fail "--plan with other headings: $(<log)"
[[ $(landmarks_in) == "tips.txt three.txt " ]] || fail "headings with capitals and blanks: $(landmarks_in)"

# Ended by an interrupt: all that it started ends with it, and it says so.
end_by_interrupt() {  # the batch that leads `session`
    local code=0
    kill -TERM $session || fail "ended before it was interrupted: $(<log)"
    wait $session || code=$?
    ((code == 143)) || fail "exit $code after an interrupt"
    # shellcheck disable=SC2009  # pgrep counts those that have ended, too
    [[ -z $(ps -o stat= -s $session | grep -v Z || true) ]] || fail "what a batch began goes on after an interrupt"
    grep -q 'interrupted; what is finished is kept' log || fail "an interrupt is not said"
}
setsid "$varimap" batch "${small_picture[@]}" "${coarse[@]}" --all-pairs meshes -o stopped -j 2 >out.txt 2>log </dev/null &
session=$!
for ((i = 0; i < 600; ++i)); do
    # Stages are asked for versions and parameters before jobs run.
    [[ ! -s stopped/batch/running ]] || ! pgrep -s $session 'varimap-(eigen|explore|diffuse|refine|relax|remesh)' >/dev/null || break
    sleep .1
done
end_by_interrupt
! grep -qE '[1-9][0-9]* failed|failed \(' log || fail "an interrupted job is counted as failed: $(grep failed log)"
[[ -z $(find stopped/pairs -name result.json -exec grep -l failed {} +) ]] || fail "an interrupted pair is called failed"
batch --all-pairs meshes -o stopped -j 2
same_batch all stopped
# So does what chooses consistent maps.
mkdir slow
ln -s "$VARIMAP_BIN"/* slow
rm slow/varimap-cycles
printf '#!/bin/sh\ntouch "%s/choosing"\nsleep 60\n' "$PWD" >slow/varimap-cycles
chmod +x slow/varimap-cycles
VARIMAP_BIN=$PWD/slow setsid "$varimap" batch "${small_picture[@]}" "${coarse[@]}" --all-pairs meshes --consistent -o stopped -j 2 >out.txt 2>log </dev/null &
session=$!
until [[ -e choosing ]] || ! kill -0 $session 2>/dev/null; do sleep .05; done
end_by_interrupt
