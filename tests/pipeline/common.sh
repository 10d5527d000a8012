# shellcheck shell=bash
# Shared by the tests of whole programs: a working folder, small surfaces, and checks that end the test.
# Needs VARIMAP_BIN (the executables) and VARIMAP_SOURCE (the project).
set -euo pipefail
shopt -s inherit_errexit
export LC_ALL=C
: "${VARIMAP_BIN:?}" "${VARIMAP_SOURCE:?}"
varimap=$VARIMAP_SOURCE/pipelines/varimap
for tool in make jq flock; do
    command -v "$tool" >/dev/null || { echo "skipped: $tool is missing"; exit 77; }
done

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() {
    echo "FAILED: $*"
    [[ ! -s log ]] || { echo "--- last log:"; tail -n 20 log; }
    exit 1
}

# own_disk: an empty disk of 8 MB in the folder `disk`, seen by this test alone, which starts once more for it: to be called
# first. Fails where that is not permitted.
own_disk() {
    local how
    mkdir disk
    if [[ -n ${VARIMAP_OWN_MOUNTS:-} ]]; then
        mount -t tmpfs -o size=8m none disk
        trap 'umount -l "$work/disk"; rm -rf "$work"' EXIT
        return
    fi
    for how in -m -rm; do
        unshare $how mount -t tmpfs none "$work/disk" 2>/dev/null || continue
        cd /
        rm -rf "$work"
        VARIMAP_OWN_MOUNTS=yes unshare $how bash "$VARIMAP_SOURCE/tests/pipeline/${0##*/}"
        exit
    done
    return 1
}

# figure FILE N [TWIST [LIMBS]]: a closed surface of 4 N^2 + 2 vertices without symmetry: an ellipsoid with five limbs
# of different sizes (times LIMBS; 0: with none), turned about its long axis by TWIST radians per unit length.
# Vertex i of every figure of the same N is the same point of the body.
figure() {
    awk -v n="$2" -v twist="${3:-0}" -v limbs="${4:-1}" '
        function vertex(x, y, z,    key) {
            key = x "," y "," z
            if (!(key in index_of)) { index_of[key] = count; X[count] = x; Y[count] = y; Z[count] = z; count++ }
            return index_of[key]
        }
        function face(a, b, c) { faces = faces "3 " a " " (mirrored ? c " " b : b " " c) "\n"; face_count++ }
        function octant(sx, sy, sz,    i, j, k) {
            mirrored = sx * sy * sz < 0
            for (i = 0; i < n; i++) for (j = 0; i + j < n; j++) {
                k = n - i - j
                face(vertex(sx * i, sy * j, sz * k), vertex(sx * (i + 1), sy * j, sz * (k - 1)),
                     vertex(sx * i, sy * (j + 1), sz * (k - 1)))
                if (k > 1)
                    face(vertex(sx * (i + 1), sy * j, sz * (k - 1)), vertex(sx * (i + 1), sy * (j + 1), sz * (k - 2)),
                         vertex(sx * i, sy * (j + 1), sz * (k - 1)))
            }
        }
        function limb(x, y, z, ux, uy, uz, length_, width,    l) {
            l = sqrt(ux * ux + uy * uy + uz * uz)
            return length_ * exp(((x * ux + y * uy + z * uz) / l - 1) / width)
        }
        BEGIN {
            count = face_count = 0
            for (o = 0; o < 8; o++) octant(o % 2 ? -1 : 1, int(o / 2) % 2 ? -1 : 1, o > 3 ? -1 : 1)
            printf "OFF\n%d %d 0\n", count, face_count
            for (v = 0; v < count; v++) {
                l = sqrt(X[v] ^ 2 + Y[v] ^ 2 + Z[v] ^ 2); x = X[v] / l; y = Y[v] / l; z = Z[v] / l
                r = limb(x, y, z, 1, .2, .9, .9, .1) + limb(x, y, z, -.9, .3, 1, .6, .12) \
                    + limb(x, y, z, .9, -.2, -1, .7, .08) + limb(x, y, z, -1, .1, -.8, .8, .1) \
                    + limb(x, y, z, .1, 1, .3, .5, .15)
                r = 1 + limbs * r
                x *= .7 * r; y *= .5 * r; z *= 1.3 * r
                printf "%.17g %.17g %.17g\n", x * cos(twist * z) - y * sin(twist * z), x * sin(twist * z) + y * cos(twist * z), z
            }
            printf "%s", faces
        }' >"$1"
}

# landmarks_of_figure FILE: the tips of its limbs, as lines of a landmark file between any two figures of that size.
landmarks_of_figure() {
    awk 'NR == 2 { n = $1 } NR > 2 && NR <= n + 2 {
            s[0] = $1 + $3; s[1] = -$1 + $3; s[2] = $1 - $3; s[3] = -$1 - $3; s[4] = $2
            for (k = 0; k < 5; k++) if (NR == 3 || s[k] > best[k]) { best[k] = s[k]; at[k] = NR - 3 }
        }
        END { for (k = 0; k < 5; k++) print at[k], at[k] }' "$1"
}

# upper_part FILE: its faces above z = -.3; all vertices stay.
upper_part() {
    awk 'NR == 2 { n = $1; m = $2 } NR > 2 && NR <= n + 2 { z[NR - 3] = $3; line[NR - 3] = $0 }
        NR > n + 2 && z[$2] > -.3 && z[$3] > -.3 && z[$4] > -.3 { face[count++] = $0 }
        END { printf "OFF\n%d %d 0\n", n, count; for (v = 0; v < n; v++) print line[v]; for (f = 0; f < count; f++) print face[f] }' "$1"
}

# coarse_pair: maps are coarse from here on; makes a.off and b.off, and the first map of one onto the other, in good.
coarse_pair() {
    small_picture+=("${coarse[@]}")
    figure a.off 6
    figure b.off 6 .5
    map a.off b.off -o good
}

# map ARGUMENTS: runs the front end, with a small picture; what the stages say goes to the file log.
small_picture=(--set render.width=64 --set render.samples=1)
# Besides, where the map itself does not matter: a few hundred vertices instead of 2500, which takes a second.
# shellcheck disable=SC2034
coarse=(--set preprocess.target_edge_length=.2 --set explore.random_starts=4)
# Where it matters a little: a thousand vertices.
# shellcheck disable=SC2034
smaller=(--set preprocess.target_edge_length=.15)
map() {
    "$varimap" map -v "${small_picture[@]}" "$@" >out.txt 2>log || fail "varimap map $* (exit $?)"
}

# ran: which stages ran since the last map, sorted, with how often.
ran() {
    sed -n 's/^\[\([a-z]*\)\] done:.*/\1/p' log | sort | uniq -c | awk '{ printf "%s%s%s", sep, $2, ($1 > 1 ? "*" $1 : ""); sep = " " }'
}

expect_ran() {  # STAGES: what `ran` must say
    [[ $(ran) == "$1" ]] || fail "ran '$(ran)', not '$1'"
}

# expect_exit CODE COMMAND...: the command fails with CODE and says why in one line on stderr.
expect_exit() {
    local code=0 expected=$1
    shift
    "$@" >out.txt 2>log </dev/null || code=$?
    ((code == expected)) || fail "exit $code, not $expected: $*"
    ((expected == 0)) && return
    local errors
    errors=$(grep -c 'error: ' log || true)
    ((errors == 1)) || fail "$errors error lines, not one: $*"
}

# report_on <FILE: what is said of that quality.json, for programs.
words_of_quality() { cat -- "$VARIMAP_SOURCE"/pipelines/{quality_words,report}.jq && echo; }  # as script.sh has it
report_on() { jq "$(words_of_quality)report"; }

same() {  # FILE FILE
    cmp -s "$1" "$2" || fail "$1 and $2 differ"
}

artifacts() {  # FOLDER: all artifacts in it
    find "$1" -maxdepth 1 -type f -regex '.*\.\(surface\|coarse\|basis\|hierarchy\|candidates\|diffusion\|plan\|map\|quality\)'
}

# same_results OUT OUT: the same tables, and the same bytes in all artifacts that the first has.
same_results() {
    local file
    for file in source_to_target.csv target_to_source.csv source_on_target.ply target_on_source.ply picture.png; do
        same "$1/$file" "$2/$file"
    done
    artifacts "$1/artifacts/" | while read -r file; do same "$file" "$2/artifacts/${file##*/}"; done
}

# same_batch OUT OUT: of batches: tables, meshes, artifacts, and what is said of them; times differ.
same_batch() {  # OUT OUT
    local pair
    same "$1/status.csv" "$2/status.csv"
    same "$1/index.html" "$2/index.html"
    for pair in "$1"/pairs/*; do same_results "$pair" "$2/pairs/${pair##*/}"; done
}

# nothing_left FOLDER...: no file of a run that has ended.
nothing_left() {
    local left
    left=$(find "$@" \( -name '*.tmp.*' -o -name '*.tmp' -o -name '?*.lock' \) -print)
    [[ -z $left ]] || fail "left behind: $left"
}

# victims KIND SESSION: of a run in a session of its own: all, the front end, a job of a batch, or a stage.
victims() {
    case $1 in
    all) pgrep -s "$2" || true ;;
    front_end) echo "$2" ;;
    job) pgrep -s "$2" job | head -n 1 || true ;;
    stage) pgrep -s "$2" varimap- | head -n 1 || true ;;
    esac
}

# printable_only FILE...: no byte that a terminal would obey.
printable_only() {
    ! grep -nP '[\x00-\x08\x0b-\x1f\x7f]' "$@" || fail "control characters reach the terminal"
    cat "$@" | iconv -f UTF-8 -t UTF-8 >/dev/null || fail "what is printed is not UTF-8"
}
