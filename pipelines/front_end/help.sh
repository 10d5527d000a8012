# shellcheck shell=bash
# What there is to call, and help on it. To be sourced.
# shellcheck disable=SC2154  # what other files of the front end set

scripts=(batch register survey bench bench-list selftest scaling torus gallery)
is_script() { [[ " ${scripts[*]} " == *" $1 "* && -x $(script_of "$1") ]]; }
script_of() {  # NAME
    [[ -d $share/$1 ]] && echo "$share/$1/$1" || echo "$share/$1"
}

# The names of the executables beside the stages: varimap-NAME.
tools() {
    local tool
    for tool in "$VARIMAP_BIN"/varimap-*; do
        [[ ! -x $tool ]] || echo "${tool##*/varimap-}"
    done
}

topics() {
    local page
    for page in "$share"/help/*.md; do
        page=${page##*/}
        echo "${page%.md}"
    done
}

all_topics() { { topics; printf '%s\n' "${scripts[@]}"; tools; } | sort -u; }

overview() {
    local IFS=' '
    cat <<TEXT
Maps one surface onto another, in both directions.

  varimap map SOURCE TARGET -o OUT [options]   the whole way; varimap help map lists the options
  varimap batch LIST -o OUT [options]          many pairs: all that can run at once, resumed where it ended
  varimap register TEMPLATE SPECIMEN... -o OUT corresponding points of many specimens, their mean and components
  varimap transfer OUT [options]               carries points, values, textures, shapes through the map in OUT
  varimap view OUT                             makes a page that shows OUT in a browser, and takes landmarks
  varimap report OUT [--json]                  how good the map in OUT is, and what was done
  varimap TOOL ...                             one executable: $(tools | xargs)
  varimap SCRIPT ...                           ${scripts[*]}
  varimap help [TOPIC]                         $(topics | xargs), or the name of a tool or script
  varimap --version
TEXT
}

asks_for_help() {
    [[ $1 == -h || $1 == --help ]]
}

help() {  # [TOPIC]
    local near=()
    [[ -n ${1:-} ]] || { say "$(overview)"; return; }
    help_on "$1"
    # Singular and plural, or how just one of them begins.
    help_on "$1s"
    help_on "${1%s}"
    mapfile -t near < <(all_topics | begin_with "$1")
    ((${#near[@]} != 1)) || help_on "${near[0]}"
    ((${#near[@]} == 0)) || fail 2 "no help on $1; did you mean one of: ${near[*]}?"
    fail 2 "no help on $1; there is help on $(all_topics | xargs)"
}

begin_with() {  # TEXT: the lines that do
    local line
    while IFS= read -r line; do [[ $line != "$1"* ]] || echo "$line"; done
}

help_on() {  # TOPIC: prints it and ends the script; returns where there is none
    ! help_topic "$1" || exit 0
    ! is_script "$1" || exec "$(script_of "$1")" --help
    ! is_tool "$1" || help_of_tool "$1"
}

help_of_tool() {  # NAME: its options, then its page, and ends the script
    local text page=$share/stages/$1.md  # where varimap is installed
    [[ -r $page ]] || page=$share/../stages/$1/README.md
    text=$("$VARIMAP_BIN/varimap-$1" --help; [[ ! -r $page ]] || { echo; awk -f "$share/plain_text.awk" "$page"; })
    say "$text"
    exit 0
}
