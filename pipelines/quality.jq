# Joins quality.json: the numbers of varimap-remesh, then what the stages recorded of their runs, what they noted and warned
# of, and where everything comes from. Area and scale are those of the surface that was mapped: of a whole, of what was cut from it.
#   jq -n -R -f quality.jq --slurpfile numbers FILE --arg source MESH --arg target MESH
#       --arg source_import FILE --arg target_import FILE (what a mesh was imported from, or nothing) --arg landmarks_1 FILE
#       --arg landmarks_2 FILE --arg initial_map FILE --arg command TEXT --argjson options LIST --arg part (source, target or nothing) RUN_FILE...
def stage_and_artifact($file): .stage + " " + ($file | sub(".*/"; "") | sub("[.][a-z]+[.]run[.]json$"; ""));
def of_stage($stage): map(.value | select(.stage == $stage));
def mesh($file; $origin): {file: $file, hash: .inputs.mesh, area: (1 / (.scale * .scale)), scale}
    + if $origin == "" then {} else {imported_from: $origin} end;
def said($how): [.[] | .key as $file | .value | stage_and_artifact($file) as $stage | .[$how][]? | {stage: $stage, message: .}];
def list($role; $file): .inputs[$role] // empty | {file: $file, hash: .};

# Line by line, so that one damaged run file costs its own entry alone.
(reduce inputs as $line ({}; .[input_filename] += $line + "\n")) as $texts
| [$texts | to_entries[] | {key, value: (.value | try fromjson catch null)}] as $all
| ($all | map(select(.value | type == "object" and has("stage")))) as $runs
| ($runs | of_stage("preprocess")) as $surfaces
| $numbers[0]
+ ([$runs | of_stage("locate")[] | {part: ({is: $part} + {area_percent, scale, strain} + if has("lead") then {lead} else {} end)}] | add // {})
+ {stages: [$runs[] | {key: (.key as $file | .value | stage_and_artifact($file)),
        value: (.value | del(.stage, .version, .notes, .warnings, .artifact, .inputs))}] | from_entries,
    notes: ($runs | said("notes")),
    warnings: (($runs | said("warnings"))
        + [$all[] | select(.value == null or (.value | type != "object" or (has("stage") | not)))
            | {stage: "quality.json", message: "the run file \(.key) is damaged: that stage's times are missing"}]),
    provenance: ({
        schema: 1,
        version: ($runs | of_stage("remesh") | .[0].version),
        command: (if $command == "" then null else $command end),
        options: (if $command == "" then null else $options end),
        source: ($surfaces[0] | if . then mesh($source; $source_import) else null end),
        target: ($surfaces[-1] | if . then mesh($target; $target_import) else null end),
        landmarks: [$runs | of_stage("diffuse")[] | list("landmarks"; $landmarks_1), list("landmarks.A"; $landmarks_1),
            list("landmarks.B"; $landmarks_2)],
        initial_map: ([$runs | of_stage("diffuse")[] | list("initial-map"; $initial_map)] | .[0])}
    | del(.[] | nulls))}
