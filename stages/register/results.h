#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "stages/register/comparison.h"
#include "stages/register/extent.h"
#include "stages/register/manifest.h"
#include "varimap/stage/stage_main.h"

namespace varimap {

// The files of a registration (pipelines/help/register.md) but its pictures.

/// Where they are written.
class ResultFolder {
  public:
    /// Makes the folder, and `specimens` in it. Throws IoError.
    ResultFolder(Stage& stage, const std::string& path);
    /// `name`: relative to the folder. Throws IoError.
    void write(const std::string& name, const std::string& bytes) const;

  private:
    Stage& stage_;
    std::filesystem::path path_;
};

/// points.npy, and specimens/NAME.csv and NAME.ply of each specimen.
void write_points(const ResultFolder& folder, const Registration& all, const Extents& extents);

/// landmarks.csv and landmarks.npy; only where there are some.
void write_landmarks(const ResultFolder& folder, const Registration& all);

/// aligned.npy, mean.ply, component_K_minus.ply and component_K_plus.ply, components.csv, specimens.csv, and
/// identity.csv, by which pictures show one of these meshes as a map onto another.
void write_shapes(const ResultFolder& folder, const Registration& all, const Extents& extents,
                  const ShapeComparison& shapes);

}  // namespace varimap
