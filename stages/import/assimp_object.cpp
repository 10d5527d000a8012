#include "stages/import/private/assimp_object.h"

#include <algorithm>
#include <cstring>

#include "varimap/core/error.h"

namespace varimap {

namespace {

Vec3 to_vec3(const aiVector3D& v) {
    return {double(v.x), double(v.y), double(v.z)};
}

bool have_same_vertices(const aiMesh& a, const aiMesh& b) {
    return a.mNumVertices == b.mNumVertices &&
           std::equal(a.mVertices, a.mVertices + a.mNumVertices, b.mVertices,
                      [](const auto& x, const auto& y) { return std::memcmp(&x, &y, sizeof x) == 0; });
}

void find_places(const aiNode& node, const Affine& parent, Places& places) {
    const Affine here = composed(parent, to_affine(node.mTransformation));
    places.emplace(node.mName.C_Str(), here);
    for (unsigned i = 0; i < node.mNumChildren; ++i) find_places(*node.mChildren[i], here, places);
}

std::vector<Vec3> vertices_of(const aiMesh& mesh) {
    std::vector<Vec3> points;
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) points.push_back(to_vec3(mesh.mVertices[v]));
    return points;
}

/// Where the joints take the vertices of a skin; as they stand in the file if a joint is none of the nodes.
std::vector<Vec3> skinned_vertices_of(const aiMesh& mesh, const Places& joints) {
    const std::vector<Vec3> points = vertices_of(mesh);
    std::vector<Vec3> sum(points.size(), Vec3::Zero());
    std::vector<double> weights(points.size(), 0);
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
        const aiBone& bone = *mesh.mBones[b];
        const auto joint = joints.find(bone.mName.C_Str());
        if (joint == joints.end()) return points;
        const Affine motion = composed(joint->second, to_affine(bone.mOffsetMatrix));
        for (unsigned w = 0; w < bone.mNumWeights; ++w) {
            const std::size_t v = bone.mWeights[w].mVertexId;
            if (v >= points.size()) throw InputError("a joint names a vertex that is not there");
            const auto weight = double(bone.mWeights[w].mWeight);
            sum[v] += weight * (motion * points[v].homogeneous());
            weights[v] += weight;
        }
    }
    for (std::size_t v = 0; v < points.size(); ++v) sum[v] = weights[v] > 0 ? sum[v] / weights[v] : points[v];
    return sum;
}

}  // namespace

Affine to_affine(const aiMatrix4x4& m) {
    Affine result;
    for (unsigned r = 0; r < 3; ++r)
        for (unsigned c = 0; c < 4; ++c) result(r, c) = double(m[r][c]);
    return result;
}

Affine composed(const Affine& outer, const Affine& inner) {
    Affine result;
    result.leftCols<3>() = outer.leftCols<3>() * inner.leftCols<3>();
    result.col(3) = outer.leftCols<3>() * inner.col(3) + outer.col(3);
    return result;
}

Places places_of(const aiScene& scene) {
    Places places;
    find_places(*scene.mRootNode, Affine::Identity(), places);
    return places;
}

bool has_skin(const aiScene& scene, const aiNode& node) {
    return std::any_of(node.mMeshes, node.mMeshes + node.mNumMeshes,
                       [&](unsigned mesh) { return scene.mMeshes[mesh]->HasBones(); });
}

SceneObject object_of(const aiScene& scene, const aiNode& node, const Places& joints) {
    SceneObject object;
    bool has_uv = true;
    const aiMesh* last = nullptr;
    long long first = 0;
    for (unsigned m = 0; m < node.mNumMeshes; ++m) {
        const aiMesh& mesh = *scene.mMeshes[node.mMeshes[m]];
        has_uv = has_uv && mesh.HasTextureCoords(0);
        if (last == nullptr || !have_same_vertices(*last, mesh)) {
            first = static_cast<long long>(object.soup.points.size());
            const auto points = joints.empty() ? vertices_of(mesh) : skinned_vertices_of(mesh, joints);
            object.soup.points.insert(object.soup.points.end(), points.begin(), points.end());
        }
        last = &mesh;
        for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
            const aiFace& face = mesh.mFaces[f];
            if (face.mNumIndices < 3) continue;
            for (unsigned k = 0; k < face.mNumIndices; ++k) {
                const unsigned v = face.mIndices[k];
                if (v >= mesh.mNumVertices) throw InputError("a face names a vertex that is not there");
                object.soup.corners.push_back(first + v);
                if (has_uv)
                    object.uv.emplace_back(double(mesh.mTextureCoords[0][v].x),
                                           double(mesh.mTextureCoords[0][v].y));
            }
            object.soup.end_polygon();
            object.material.push_back(mesh.mMaterialIndex);
        }
    }
    if (!has_uv) object.uv.clear();
    return object;
}

}  // namespace varimap
