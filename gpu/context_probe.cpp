#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "gpu/child_process.hpp"
#include "gpu/context_backend.hpp"
#include "gpu/context_trial.hpp"
#include "gpu/environment.hpp"
#include "gpu/object.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr ChildRules driver{"the driver"};
bool trial = false;

/// As the Error of a context of one kind begins.
std::string no_context(const ContextRequest& request) {
    return fmt::format("no GL context: {}: ", context_request_text(request));
}

/// Clears one texel and reads it back, which a rasteriser's threads do.
void draw_a_texel() {
    const GlTexture texture;
    gl::BindTexture(GL_TEXTURE_2D, texture.id());
    gl::TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    const GlFramebuffer framebuffer;
    gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    gl::FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.id(), 0);
    const float value[4] = {1.0F, 1.0F, 1.0F, 1.0F};
    gl::ClearBufferfv(GL_COLOR, 0, value);
    unsigned char read[4] = {};
    gl::ReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, read);
}

ContextProbe probe(const ContextRequest& request) {
    ContextProbe result{request, {}, {}};
    try {
        result.info = try_context(request);
    } catch (const Error& error) {
        result.error = fmt::format("{}: {}", context_request_text(request), error.what());
    }
    return result;
}

} // namespace

ContextInfo try_context(const ContextRequest& request) {
    const std::string answer = in_child(driver, [&] {
        trial = true;
        try {
            const Context context(request);
            draw_a_texel();
            return nlohmann::json(context.describe()).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
        } catch (const Error& error) {
            const std::string reason = error.what(), prefix = no_context(request);
            throw Error(reason.substr(reason.starts_with(prefix) ? prefix.size() : 0));
        }
    });
    return nlohmann::json::parse(answer).get<ContextInfo>();
}

bool is_trial() { return trial; }

std::vector<ContextProbe> available_contexts() {
    using Backend = ContextRequest::Backend;
    prepare_for_driver();
    std::vector<ContextProbe> probes{probe({Backend::osmesa, 0}), probe({Backend::egl, 0})};
    int devices = 0;
    try {
        devices = std::stoi(in_child(driver, [] { return std::to_string(egl_device_count()); }));
    } catch (const Error& error) {
        probes.push_back({{Backend::egl_device, 0}, {}, fmt::format("EGL devices: {}", error.what())});
    }
    for (int device = 0; device < devices; ++device)
        probes.push_back(probe({Backend::egl_device, device}));
    return probes;
}

} // namespace lockstep
