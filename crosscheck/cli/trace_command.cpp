#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/system_verbs.hpp"
#include "crosscheck/collision/record/trace_reader.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/report/verdict_text.hpp"
#include "crosscheck/scene/profile_text.hpp"

namespace lockstep {
namespace {

int run(const std::filesystem::path& file) {
    if (const RegisteredSystem* system = system_of_recording(file))
        return tell_recording(*system, file);
    TraceReader trace(file);
    const TraceInfo& info = trace.info();
    Particles particles;
    CollisionImage cdt;
    for (int frame = 0; frame < info.frames; ++frame) {
        trace.read(frame, particles);
        if (info.has_cdt)
            trace.read(frame, cdt);
    }
    const auto line = [](const char* key, const std::string& text) { fmt::print("{:<10}{}\n", key, plain_line(text)); };
    line("trace", fmt::format("{}: {} bytes, sealed, every value read", file.string(),
                              grouped(std::filesystem::file_size(file))));
    line("program", info.program.empty() ? "untold" : info.program);
    line("scene",
         fmt::format("{}: {} particles, {} frames, {} triangles of obstacles", info.scene.name,
                     grouped(info.scene.start.size()), info.frames, grouped(info.scene.obstacles.triangle_count())));
    line("switches", info.settings.empty() ? "untold" : info.settings);
    line("GL", info.renderer.empty() ? "untold" : info.renderer);
    line("shaders", info.shaders.empty() ? "untold" : info.shaders);
    line("profile", info.profile ? describe(*info.profile)
                                 : "none: the reference is strict, and what differs is judged by GLSL's rules alone");
    line("CDT", info.has_cdt ? fmt::format("{}x{} texels", info.scene.width, info.scene.height)
                             : "none: the reference draws it of the recorded particles");
    for (const std::string& warning : info.warnings)
        line("warning", warning);
    return status_agree;
}

} // namespace

Verb trace_command() {
    auto file = std::make_shared<std::filesystem::path>();
    Verb verb{"trace", "read a recorded run whole, and report what is in it or what is wrong"};
    verb.add(required(path_option("trace", "FILE", *file,
                                  "what `lockstep record` wrote, or an engine of your own (docs/traces.md)")));
    verb.footer = "Exit status: 0 it can be checked, 2 it cannot.\nExample: lockstep trace run.h5";
    verb.run = [file](const Call&) { return run(*file); };
    return verb;
}

} // namespace lockstep
