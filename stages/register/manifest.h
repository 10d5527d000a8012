#pragma once

#include <optional>
#include <string>
#include <vector>

#include "stages/register/answers.h"
#include "varimap/landmarks/vertex_list.h"
#include "varimap/mesh/triangle_mesh.h"

namespace varimap {

/// Landmarks on a template, as many points as names. What the file gives no name is called by its number,
/// from 1.
struct TemplateLandmarks {
    std::vector<std::string> names;
    PointMap points;
    bool named = true;  ///< by the file, all of them

    void add_name(const std::string& name);  ///< of the next point; empty: the file has none
};

/// The specimens of a manifest, each by what its maps say of it: lists have one entry per specimen, in order.
struct Registration {
    TriangleMesh first;                          ///< the first template
    std::optional<TemplateLandmarks> landmarks;  ///< on it, where the manifest has some
    std::vector<std::string> names;
    std::vector<bool> is_part;                      ///< of what the template is
    std::vector<bool> is_mirrored;                  ///< of the other side of the body than the template
    std::vector<Space> spaces;                      ///< what the specimens' files say of their axes
    std::vector<Points> points;                     ///< where the vertices of `first` lie; NaN: nowhere
    std::vector<TransferredLandmarks> transferred;  ///< none without `landmarks`

    /// The points of a specimen as shapes are compared, which is of one side: mirrored where it is.
    Points shape(std::size_t specimen) const;
};

/// Reads the manifest that `varimap register` writes (README.md) and all that it names; at least one
/// specimen. Throws IoError; InputError naming the file that is malformed, that does not fit the meshes, or
/// whose landmarks lie far from the template. `reading`: of landmark files.
Registration read_registration(const std::string& path, const LandmarkReading& reading);

/// Reads the landmarks of `templates` in a manifest, `template` and `landmarks` each, the first template's
/// before the others'. Throws as read_registration does where they could not be carried.
void check_landmarks(const std::string& path, const LandmarkReading& reading);

}  // namespace varimap
