#include "crosscheck/scene/surface.hpp"

#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <meshoptimizer.h>

#include "crosscheck/files/opened_file.hpp"
#include "crosscheck/scene/ply_counts.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr std::uint64_t largest_file = std::uint64_t{1} << 30U; // bytes
constexpr unsigned most_corners = 1024;                         // of a polygon: triangulating takes their square

/// A mesh is one file: materials that it names, which may be pipes and devices, are not looked for.
class NoOtherFiles : public Assimp::IOSystem {
  public:
    bool Exists(const char* /*name*/) const override { return false; }
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* /*name*/, const char* /*mode*/) override { return nullptr; }
    void Close(Assimp::IOStream* /*file*/) override {}
};

/// What Assimp's later steps take for granted of its readers, and a damaged file does not keep.
void check(const aiMesh& part, const std::filesystem::path& file) {
    for (unsigned v = 0; v < part.mNumVertices; ++v)
        if (const aiVector3D& p = part.mVertices[v]; !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            fail_on(file, fmt::format("vertex {} is ({}, {}, {}); coordinates are finite numbers", v, p.x, p.y, p.z));
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
        const aiFace& face = part.mFaces[f];
        if (face.mNumIndices == 0)
            fail_on(file, fmt::format("face {} has no vertices", f));
        if (face.mNumIndices > most_corners)
            fail_on(file,
                    fmt::format("face {} has {} corners; right is at most {}", f, face.mNumIndices, most_corners));
        for (unsigned k = 0; k < face.mNumIndices; ++k)
            if (face.mIndices[k] >= part.mNumVertices)
                fail_on(file, fmt::format("face {} uses vertex {} of {}", f, face.mIndices[k], part.mNumVertices));
    }
}

/// All triangles, each vertex as often as the importer has it.
Surface read_surface(const std::string& bytes, bool is_ply, const std::filesystem::path& file) {
    const std::size_t promised = is_ply ? ply_faces(bytes, file) : 0;
    Assimp::Importer importer;
    importer.SetIOHandler(std::make_unique<NoOtherFiles>().release()); // the importer deletes it
    const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, is_ply ? "ply" : "obj");
    std::size_t faces = 0;
    for (unsigned m = 0; scene != nullptr && m < scene->mNumMeshes; ++m) {
        check(*scene->mMeshes[m], file);
        faces += scene->mMeshes[m]->mNumFaces;
    }
    if (scene != nullptr && faces < promised)
        fail_on(file, fmt::format("cut off: {} of the {} faces that its header promises are here", faces, promised));
    if (scene != nullptr)
        scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
    if (scene == nullptr)
        fail_on(file, fmt::format("not a readable mesh: {}", importer.GetErrorString()));
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
        fail_on(file, "not a mesh file; a mesh is a .obj or .ply");
    if (!std::filesystem::is_regular_file(file))
        fail_on(file, "no such mesh; scripts/fetch_meshes.sh fetches the bunny and the dragon");
    const OpenedFile opened(file, "mesh");
    if (opened.size() > largest_file)
        fail_on(file, fmt::format("{} bytes; a mesh file has at most {}", opened.size(), largest_file));
    const Surface surface = read_surface(opened.text(), kind == ".ply", file);
    if (surface.indices.empty())
        fail_on(file, "the mesh has no faces; an obstacle needs at least one triangle");
    return merge_equal_vertices(surface);
}

} // namespace lockstep
