#include <catch2/catch.hpp>

#include <cmath>
#include <string>

#include <sys/stat.h>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "crosscheck/scene/surface.hpp"
#include "reference/model/error.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::surface_test {

using lockstep::test::TemporaryFolder;

namespace {

double volume(const Surface& s) {
    double six_volumes = 0.0;
    for (std::size_t i = 0; i < s.indices.size(); i += 3)
        six_volumes += glm::dot(s.positions[s.indices[i]],
                                glm::cross(s.positions[s.indices[i + 1]], s.positions[s.indices[i + 2]]));
    return six_volumes / 6.0;
}

constexpr std::string_view two_triangles = "v 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nf 1 2 3\nf 1 3 4\n";

} // namespace

TEST_CASE("surface: generated solids are closed, face outwards and have their volume") {
    CHECK(volume(box_surface({1.0, 2.0, 3.0})) == Approx(6.0));
    CHECK(volume(sphere_surface(0.5, 64)) == Approx(4.0 / 3.0 * M_PI * 0.125).epsilon(0.002));
    CHECK(volume(torus_surface(1.0, 0.25, 256)) == Approx(2.0 * M_PI * M_PI * 0.0625).epsilon(0.002));
}

TEST_CASE("surface: all vertices of a sphere lie on it") {
    for (const glm::dvec3& p : sphere_surface(0.5, 7).positions)
        REQUIRE(glm::length(p) == Approx(0.5).epsilon(1e-12));
}

TEST_CASE("surface: a plane is two triangles facing up") {
    const Surface plane = plane_surface(2.0, 4.0);
    REQUIRE(plane.indices.size() == 6);
    for (std::size_t i = 0; i < 6; i += 3) {
        const glm::dvec3 a = plane.positions[plane.indices[i]];
        const glm::dvec3 b = plane.positions[plane.indices[i + 1]];
        const glm::dvec3 c = plane.positions[plane.indices[i + 2]];
        CHECK(glm::cross(b - a, c - a) == glm::dvec3(0.0, 8.0, 0.0));
    }
}

TEST_CASE("surface: placing scales to the height, turns about y and moves the centre to the position") {
    Mesh mesh;
    place(box_surface({1.0, 2.0, 4.0}), {.height = 1.0, .rotate_y = 90.0, .position = {10.0, 20.0, 30.0}}, mesh);
    glm::vec3 low(1e9F);
    glm::vec3 high(-1e9F);
    for (const glm::vec3& p : mesh.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    CHECK(low == glm::vec3(9.0F, 19.5F, 29.75F));
    CHECK(high == glm::vec3(11.0F, 20.5F, 30.25F));
}

TEST_CASE("surface: a quarter turn about y takes x to -z and z to x") {
    Mesh mesh;
    place({{{1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {-1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}}, {}}, {.rotate_y = 90.0}, mesh);
    CHECK(glm::distance(mesh.positions[0], glm::vec3(0.0F, 0.0F, -1.0F)) < 1e-6F);
    CHECK(glm::distance(mesh.positions[1], glm::vec3(1.0F, 0.0F, 0.0F)) < 1e-6F);
}

TEST_CASE("surface: a second obstacle follows the first, its indices shifted") {
    Mesh mesh;
    place(plane_surface(1.0, 1.0), {}, mesh);
    place(plane_surface(1.0, 1.0), {}, mesh);
    REQUIRE(mesh.triangle_count() == 4);
    CHECK(mesh.positions.size() == 8);
    CHECK(mesh.indices[0] == 0);
    CHECK(mesh.indices[6] == 4);
}

TEST_CASE("surface: an OBJ keeps its triangles in order and shares equal vertices") {
    const TemporaryFolder folder;
    const Surface s = load_surface(folder.write("a.obj", two_triangles));
    REQUIRE(s.indices.size() == 6);
    CHECK(s.positions.size() == 4);
    CHECK(s.positions[s.indices[0]] == glm::dvec3(0.0, 0.0, 0.0));
    CHECK(s.positions[s.indices[2]] == glm::dvec3(1.0, 2.0, 0.0));
    CHECK(s.positions[s.indices[5]] == glm::dvec3(0.0, 2.0, 0.0));
}

TEST_CASE("surface: a PLY is read too, and a quadrilateral becomes two triangles") {
    const TemporaryFolder folder;
    const Surface s = load_surface(folder.write(
        "a.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                 "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                 "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"));
    CHECK(s.indices.size() == 6);
    CHECK(s.positions.size() == 4);
}

TEST_CASE("surface: a mesh that cannot be an obstacle is told with the reason") {
    const TemporaryFolder folder;
    const auto file = [&](const char* name) { return (folder.path() / name).string(); };
    CHECK_THROWS_WITH(load_surface(file("none.obj")),
                      file("none.obj") + ": no such mesh; scripts/fetch_meshes.sh fetches the bunny and the dragon");
    CHECK_THROWS_WITH(load_surface(folder.write("a.stl", "solid")),
                      file("a.stl") + ": not a mesh file; a mesh is a .obj or .ply");
    CHECK_THROWS_WITH(load_surface(folder.write("empty.obj", "")),
                      Catch::StartsWith(file("empty.obj") + ": not a readable mesh: "));
    CHECK_THROWS_WITH(load_surface(folder.write("cut.ply", "ply\nformat ascii 1.0\nelement vertex 3\n")),
                      file("cut.ply") + ": not a readable mesh: the PLY header has no end_header");
    CHECK_THROWS_WITH(load_surface(folder.write("points.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\n")),
                      file("points.obj") + ": the mesh has no faces; an obstacle needs at least one triangle");
    CHECK_THROWS_WITH(load_surface(folder.write("lines.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n")),
                      file("lines.obj") + ": the mesh has no faces; an obstacle needs at least one triangle");
    CHECK_THROWS_WITH(load_surface(folder.write("nan.obj", "v 0 0 0\nv nan 0 0\nv 1 1 0\nf 1 2 3\n")),
                      file("nan.obj") + ": vertex 1 is (nan, 0, 0); coordinates are finite numbers");
    CHECK_THROWS_WITH(load_surface(folder.write("range.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 9\n")),
                      Catch::StartsWith(file("range.obj") + ": "));
    const std::string ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                            "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                            "0 0 0\n1 0 0\n1 1 0\n";
    CHECK_THROWS_WITH(load_surface(folder.write("range.ply", ply + "3 0 1 7\n")),
                      file("range.ply") + ": face 0 uses vertex 7 of 3");
    CHECK_THROWS_WITH(load_surface(folder.write("nothing.ply", ply + "0\n")),
                      file("nothing.ply") + ": face 0 has no vertices");
    CHECK_THROWS_WITH(load_surface(folder.write("short.ply", ply)), Catch::StartsWith(file("short.ply") + ": "));
}

TEST_CASE("surface: a PLY that is cut off is refused wherever it was cut") {
    const TemporaryFolder folder;
    std::string ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                      "element face 2900\nproperty list uchar int vertex_indices\nend_header\n"
                      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    for (int face = 0; face < 900; ++face)
        ply += face % 2 == 0 ? "3 0 1 2\n" : "4 0 1 2 3\n";
    CHECK_THROWS_WITH(load_surface(folder.write("cut.ply", ply)),
                      (folder.path() / "cut.ply").string() +
                          ": cut off: 904 of the 2904 lines that its header promises are here");
    std::string binary = "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                         "property float z\nelement face 40\nproperty list uchar int vertex_indices\nend_header\n";
    binary += std::string(36, '\0');
    const std::string face("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13);
    const std::size_t header = binary.size();
    for (int i = 0; i < 40; ++i)
        binary += face;
    CHECK(load_surface(folder.write("whole.ply", binary)).indices.size() == 120);
    std::string many = binary;
    many.replace(many.find("vertex 3"), 8, "vertex 4000000000");
    CHECK_THROWS_WITH(load_surface(folder.write("many.ply", many)),
                      Catch::Contains("many.ply: cut off: its header promises 4000000040 elements, in "));
    for (std::size_t kept = header - 20; kept < binary.size(); kept += 7)
        CHECK_THROWS_AS(load_surface(folder.write("cut.ply", binary.substr(0, kept))), Error);
}

TEST_CASE("surface: a PLY has every element that it declares, in each format") {
    const TemporaryFolder folder;
    const std::string kinds[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    for (const std::string& kind : kinds) {
        const auto put = [&](auto value) {
            std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
            if (kind == kinds[2])
                std::reverse(bytes.begin(), bytes.end());
            return kind == "ascii" ? fmt::format("{} ", static_cast<double>(value)) : bytes;
        };
        const auto end = [&] { return kind == "ascii" ? std::string("\n") : std::string(); };
        constexpr int vertices = 1500, faces = 2900;
        std::string ply = fmt::format("ply\nformat {} 1.0\ncomment cut\nelement vertex {}\nproperty float x\n"
                                      "property float y\nproperty float z\nproperty uchar red\nelement face {}\n"
                                      "property list uchar int vertex_indices\nproperty list uchar float texcoord\n"
                                      "element note 1\nproperty double time\nend_header\n",
                                      kind, vertices, faces);
        for (int v = 0; v < vertices; ++v)
            ply += put(float(v)) + put(float(v % 7)) + put(float(v % 11)) + put(static_cast<unsigned char>(v)) + end();
        std::vector<std::size_t> ends;
        for (int f = 0; f < faces; ++f) {
            ply += put(static_cast<unsigned char>(3));
            for (int k = 0; k < 3; ++k)
                ply += put(std::int32_t((f + k) % vertices));
            ply += put(static_cast<unsigned char>(1)) + put(0.5F) + end();
            ends.push_back(ply.size());
        }
        ply += put(1.5) + end();
        CAPTURE(kind);
        CHECK(load_surface(folder.write("whole.ply", ply)).indices.size() == 3 * std::size_t{faces});
        for (const std::size_t kept : {ends[899], ends[899] - 3, ends[2899], ends[1] / 2})
            CHECK_THROWS_WITH(load_surface(folder.write("cut.ply", ply.substr(0, kept))),
                              Catch::Contains("cut.ply: cut off: "));
        CHECK_THROWS_WITH(load_surface(folder.write("cut.ply", ply.substr(0, ends[899]))),
                          Catch::Contains(kind == "ascii"
                                              ? "2400 of the 4401 lines that its header promises are here"
                                              : "900 of the 2900 elements 'face' that its header promises are here"));
    }
    CHECK_THROWS_WITH(load_surface(folder.write("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                                                         "property float y\nproperty float z\nelement face 1\n"
                                                         "property list uchar int vertex_indices\nend_header\n"
                                                         "0 0 0\n1 0\n1 1 0\n3 0 1 2\n")),
                      Catch::Contains("a.ply: element 1 of 'vertex' has fewer numbers than its header promises: 1 0"));
}

TEST_CASE("surface: a polygon with hundreds of thousands of corners is refused at once") {
    const TemporaryFolder folder;
    std::string obj, face = "f";
    for (int i = 1; i <= 200'000; ++i) {
        obj += fmt::format("v {} {} 0\n", std::cos(i), std::sin(i));
        face += fmt::format(" {}", i);
    }
    const auto file = folder.write("round.obj", obj + face + "\n");
    CHECK_THROWS_WITH(load_surface(file), file.string() + ": face 0 has 200000 corners; right is at most 1024");
}

TEST_CASE("surface: materials that a mesh names are not looked for, even where a pipe is there that nobody writes") {
    const TemporaryFolder folder;
    REQUIRE(mkfifo((folder.path() / "pipe.mtl").c_str(), 0600) == 0);
    CHECK(load_surface(folder.write("a.obj", "mtllib pipe.mtl\nusemtl a\n" + std::string(two_triangles)))
              .indices.size() == 6);
}

TEST_CASE("surface: a flat one cannot be scaled to a height, and none may reach beyond what a float holds") {
    Mesh mesh;
    CHECK_THROWS_WITH(place(plane_surface(1.0, 1.0), {.height = 2.0}, mesh),
                      "flat: all its vertices are at y = 0, so it cannot be scaled to a height of 2");
    CHECK_THROWS_WITH(place(box_surface({1e38, 1.0, 1.0}), {.height = 1e30}, mesh),
                      Catch::StartsWith("reaches beyond what a float holds"));
    CHECK_NOTHROW(place(plane_surface(1.0, 1.0), {}, mesh));
}

} // namespace lockstep::test::surface_test
