#include <cstdio>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "crosscheck/scene/decimate.hpp"

int main(int argc, char** argv) {
    std::string input;
    std::string output;
    std::size_t faces = 0;
    CLI::App app("Reduces a mesh to a number of triangles and writes it as OBJ");
    app.add_option("input", input, "OBJ or PLY file")->required();
    app.add_option("output", output, "OBJ file")->required();
    app.add_option("--faces", faces, "triangles wanted")->required()->check(CLI::Range(1, 100'000'000));
    CLI11_PARSE(app, argc, argv);
    try {
        const lockstep::Surface surface = lockstep::load_surface(input);
        const lockstep::Surface decimated = lockstep::decimate(surface, faces);
        lockstep::write_obj(decimated, output);
        fmt::print("{}: {} vertices, {} faces (of {} vertices, {} faces; {} faces wanted)\n", output,
                   decimated.positions.size(), decimated.indices.size() / 3, surface.positions.size(),
                   surface.indices.size() / 3, faces);
    } catch (const std::exception& error) {
        fmt::print(stderr, "lockstep-decimate: {}\n", error.what());
        return 2;
    }
}
