#include "tests/trace/small_trace.hpp"

#include <fstream>
#include <iterator>

#include "crosscheck/collision/record/trace_side.hpp"
#include "crosscheck/collision/record/trace_writer.hpp"
#include "crosscheck/record/seal.hpp"
#include "crosscheck/scene/scene_file.hpp"
#include "reference/collision/simulation.hpp"
#include "reference/model/error.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test {

Scene small_scene() {
    const TemporaryFolder folder;
    return load_scene(folder.write("small.json", R"({
      "constants": { "collision_range": 0.2 },
      "image": [24, 20], "render": [40, 30],
      "emitters": [{ "count": 60, "min": [-0.4, -0.4, -0.4], "max": [0.4, 0.4, 0.4], "speed": 0.5 }],
      "obstacles": [{ "shape": "plane", "size": [1, 1], "position": [0, -0.6, 0] }]
    })"));
}

TraceInfo small_info(bool has_cdt) {
    TraceInfo info;
    info.scene = small_scene();
    info.profile = named_profile("llvmpipe");
    info.renderer = "a renderer";
    info.settings = "the scene's";
    info.shaders = "shipped";
    info.has_cdt = has_cdt;
    return info;
}

void record(const std::filesystem::path& file, const TraceInfo& info, int frames, const Edit& edit) {
    TraceWriter writer(file, info);
    ReferenceSimulation reference(info.scene, followed_profile(info));
    for (int frame = 0; frame < frames; ++frame) {
        reference.step(frame_params(info.scene, frame));
        Particles particles = reference.particles();
        CollisionImage cdt = reference.cdt();
        if (edit)
            edit(frame, particles, cdt);
        writer.add(particles, info.has_cdt ? &cdt : nullptr);
    }
    writer.commit();
}

CheckReport check_trace(const std::filesystem::path& file, CheckMode mode) {
    TraceReader trace(file);
    TraceSide recorded(trace);
    CheckOptions options;
    options.mode = mode;
    options.frames = trace.info().frames;
    options.known = known_operations(trace.info());
    return check(trace.info().scene, followed_profile(trace.info()), recorded, options);
}

std::string error_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

void tamper(const std::filesystem::path& file, const std::function<void(std::string&)>& change) {
    std::string bytes = bytes_of(file);
    change(bytes);
    write_bytes(file, bytes);
    seal_file(file);
}

} // namespace lockstep::test
