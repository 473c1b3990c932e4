#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "crosscheck/command/command_line.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/scene/decimate.hpp"

using namespace lockstep;

namespace {

int run(const std::filesystem::path& input, const std::filesystem::path& output, std::size_t faces) {
    const Surface surface = load_surface(input);
    const Surface decimated = decimate(surface, faces);
    write_obj(decimated, output);
    fmt::print("{}: {} vertices, {} faces (of {} vertices, {} faces; {} faces wanted)\n", output.string(),
               decimated.positions.size(), decimated.indices.size() / 3, surface.positions.size(),
               surface.indices.size() / 3, faces);
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    std::filesystem::path input, output;
    std::size_t faces = 0;
    Verb program{"lockstep-decimate", "Reduces a mesh to a number of triangles and writes it as OBJ"};
    program.add(required(path_option("input", "FILE", input, "OBJ or PLY file")));
    program.add(required(path_option("output", "FILE", output, "OBJ file")));
    program.add(required(integer_option("--faces", "N", {1, 100'000'000}, faces, "triangles wanted")));
    program.run = [&](const Call&) { return run(input, output, faces); };
    try {
        return run_command_line(program, argc, argv, 2);
    } catch (const std::exception& error) {
        fmt::print(stderr, "lockstep-decimate: {}\n", error.what());
        return 2;
    }
}
