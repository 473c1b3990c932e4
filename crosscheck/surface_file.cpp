#include "crosscheck/surface.hpp"

#include <cmath>
#include <fstream>
#include <string>

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <meshoptimizer.h>

#include "reference/model/error.hpp"

namespace lockstep {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, std::string_view what) {
    throw Error(fmt::format("{}: {}", file.string(), what));
}

/// Assimp's PLY reader does not return from a header without an end.
bool ends_its_header(const std::filesystem::path& ply) {
    std::ifstream stream(ply);
    for (std::string line; std::getline(stream, line);)
        if (line == "end_header" || line == "end_header\r")
            return true;
    return false;
}

/// What Assimp's later steps take for granted of its readers, and a damaged file does not keep.
void check(const aiMesh& part, const std::filesystem::path& file) {
    for (unsigned v = 0; v < part.mNumVertices; ++v)
        if (const aiVector3D& p = part.mVertices[v]; !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            fail(file, fmt::format("vertex {} is ({}, {}, {}); coordinates are finite numbers", v, p.x, p.y, p.z));
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
        const aiFace& face = part.mFaces[f];
        if (face.mNumIndices == 0)
            fail(file, fmt::format("face {} has no vertices", f));
        for (unsigned k = 0; k < face.mNumIndices; ++k)
            if (face.mIndices[k] >= part.mNumVertices)
                fail(file, fmt::format("face {} uses vertex {} of {}", f, face.mIndices[k], part.mNumVertices));
    }
}

/// All triangles, each vertex as often as the importer has it.
Surface read(const std::filesystem::path& file) {
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(file.string(), 0);
    for (unsigned m = 0; scene != nullptr && m < scene->mNumMeshes; ++m)
        check(*scene->mMeshes[m], file);
    if (scene != nullptr)
        scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
    if (scene == nullptr)
        fail(file, fmt::format("not a readable mesh: {}", importer.GetErrorString()));
    Surface surface;
    for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
        const aiMesh& part = *scene->mMeshes[m];
        const auto first = static_cast<std::uint32_t>(surface.positions.size());
        for (unsigned v = 0; v < part.mNumVertices; ++v)
            surface.positions.emplace_back(part.mVertices[v].x, part.mVertices[v].y, part.mVertices[v].z);
        for (unsigned f = 0; f < part.mNumFaces; ++f)
            if (const aiFace& face = part.mFaces[f]; face.mNumIndices == 3)
                for (unsigned k = 0; k < 3; ++k)
                    surface.indices.push_back(first + face.mIndices[k]);
    }
    return surface;
}

Surface merge_equal_vertices(const Surface& surface) {
    std::vector<unsigned> remap(surface.positions.size());
    const std::size_t count =
        meshopt_generateVertexRemap(remap.data(), surface.indices.data(), surface.indices.size(),
                                    surface.positions.data(), surface.positions.size(), sizeof(glm::dvec3));
    Surface merged;
    merged.positions.resize(count);
    merged.indices.resize(surface.indices.size());
    meshopt_remapVertexBuffer(merged.positions.data(), surface.positions.data(), surface.positions.size(),
                              sizeof(glm::dvec3), remap.data());
    meshopt_remapIndexBuffer(merged.indices.data(), surface.indices.data(), surface.indices.size(), remap.data());
    return merged;
}

} // namespace

Surface load_surface(const std::filesystem::path& file) {
    const auto kind = file.extension();
    if (kind != ".obj" && kind != ".ply")
        fail(file, "not a mesh file; a mesh is a .obj or .ply");
    if (!std::filesystem::is_regular_file(file))
        fail(file, "no such mesh; scripts/fetch_meshes.sh fetches the bunny and the dragon");
    if (kind == ".ply" && !ends_its_header(file))
        fail(file, "not a readable mesh: the PLY header has no end_header");
    const Surface surface = read(file);
    if (surface.indices.empty())
        fail(file, "the mesh has no faces; an obstacle needs at least one triangle");
    return merge_equal_vertices(surface);
}

} // namespace lockstep
