#pragma once

#include <string>

#include "varimap/results/correspondence.h"
#include "varimap/stage/stage_main.h"

namespace varimap {

/// The files that a stage reads of a finished map between two meshes.
class MapInputs {
  public:
    /// Declares the positional files source-mesh, target-mesh, source-to-target and target-to-source, in this
    /// order.
    explicit MapInputs(Stage& stage);
    /// Declares the options source-hash and target-hash, which hold the meshes to what the map was made from.
    void declare_hashes(Stage& stage);

    MapFiles files() const { return {source_, target_, there_, back_}; }
    /// Throws ArtifactError where a mesh is not the one whose hash was given (correspondence.h).
    void require_unchanged() const;

  private:
    const std::string &source_, &target_, &there_, &back_;
    const std::string *source_hash_ = nullptr, *target_hash_ = nullptr;
};

}  // namespace varimap
