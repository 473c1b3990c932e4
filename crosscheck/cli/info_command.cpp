#include <string>

#include <fmt/format.h>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "gpu/context.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

std::string reason(const ContextProbe& probe) {
    const std::string prefix = fmt::format("{}: ", context_request_text(probe.request));
    return probe.error.substr(probe.error.starts_with(prefix) ? prefix.size() : 0);
}

std::string text(const ContextProbe& probe) {
    const std::string name = context_request_text(probe.request);
    if (!probe.error.empty())
        return fmt::format("{:<14}none: {}\n", name, reason(probe));
    const ContextInfo& i = probe.info;
    const auto yes_no = [](bool value) { return value ? "yes" : "no"; };
    std::string out = fmt::format("{:<14}{}\n", name, i.renderer);
    const auto line = [&](std::string_view what, const std::string& value) {
        out += fmt::format("  {:<26}{}\n", what, value);
    };
    line("vendor", i.vendor);
    line("version", i.version);
    line("GLSL", i.glsl);
    line("sub-pixel bits", fmt::format("{}", i.subpixel_bits));
    line("precise", yes_no(i.precise));
    line("clip control", yes_no(i.clip_control));
    line("compute", yes_no(i.compute));
    line("texture side", fmt::format("{} texels", i.max_texture_size));
    line("viewport", fmt::format("{} x {} pixels", i.max_viewport_width, i.max_viewport_height));
    line("captured components", fmt::format("{}", i.max_xfb_interleaved_components));
    line("point size", fmt::format("{} to {} pixels", i.min_point_size, i.max_point_size));
    line("timer bits", fmt::format("{}", i.timer_bits));
    return out;
}

int run() {
    int found = 0;
    std::string reasons;
    for (const ContextProbe& probe : available_contexts()) {
        fmt::print("{}\n", plain_text(text(probe)));
        found += probe.error.empty() ? 1 : 0;
        reasons +=
            fmt::format("{}{}: {}", reasons.empty() ? "" : "; ", context_request_text(probe.request), reason(probe));
    }
    if (found == 0)
        throw Error(fmt::format("no GL context: {}", reasons));
    return status_agree;
}

} // namespace

Verb info_command() {
    Verb verb{"info", "list the GL contexts found, with renderer, version and limits"};
    verb.footer = "Exit status: 0 there is a context, 2 there is none.\n"
                  "Example: LOCKSTEP_EGL_LIBRARY=/opt/mesa/lib/libEGL.so.1 lockstep info";
    verb.run = [](const Call&) { return run(); };
    return verb;
}

} // namespace lockstep
