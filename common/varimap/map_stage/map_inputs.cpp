#include "varimap/map_stage/map_inputs.h"

namespace varimap {

MapInputs::MapInputs(Stage& stage)
    : source_(stage.input("source-mesh", "mesh the map starts from")),
      target_(stage.input("target-mesh", "mesh the map leads to")),
      there_(stage.input("source-to-target", "CSV of varimap-remesh")),
      back_(stage.input("target-to-source", "CSV of varimap-remesh")) {}

void MapInputs::declare_hashes(Stage& stage) {
    source_hash_ = &stage.option("source-hash", "content hash that the source's mesh must have");
    target_hash_ = &stage.option("target-hash", "content hash that the target's mesh must have");
}

void MapInputs::require_unchanged() const {
    if (source_hash_ != nullptr) varimap::require_unchanged(source_, *source_hash_);
    if (target_hash_ != nullptr) varimap::require_unchanged(target_, *target_hash_);
}

}  // namespace varimap
