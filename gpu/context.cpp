#include "gpu/context.hpp"

#include <charconv>
#include <vector>

#include <fmt/format.h>

#include "gpu/context_backend.hpp"
#include "gpu/gl.hpp"
#include "reference/model/error.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep {
namespace {

using Backend = ContextRequest::Backend;

/// The one that is current. It is released before another library makes its own current: Mesa's libraries share their
/// dispatch table, and EGL would not notice.
ContextBackend* current = nullptr;

void release_current() {
    if (current == nullptr)
        return;
    gl::unload();
    current->release();
    current = nullptr;
}

void make_current(ContextBackend& backend) {
    if (current == &backend)
        return;
    release_current();
    backend.make_current();
    current = &backend;
    gl::load([&](const char* name) { return backend.resolve(name); });
}

std::unique_ptr<ContextBackend> open(const ContextRequest& request) {
    switch (request.backend) {
    case Backend::osmesa:
        return make_osmesa_context();
    case Backend::egl:
        return make_egl_surfaceless_context();
    default:
        return make_egl_device_context(request.device);
    }
}

/// A GPU first, since a shader is to be right on what it will run on. Then OSMesa, which needs nothing from the
/// machine but itself; then EGL without a surface; then EGL's software devices.
std::vector<ContextRequest> automatic_order() {
    std::vector<ContextRequest> hardware;
    std::vector<ContextRequest> software{{Backend::osmesa, 0}, {Backend::egl, 0}};
    for (int device = 0; device < egl_device_count(); ++device)
        (egl_device_is_hardware(device) ? hardware : software).push_back({Backend::egl_device, device});
    hardware.insert(hardware.end(), software.begin(), software.end());
    return hardware;
}

} // namespace

ContextRequest parse_context_request(std::string_view text) {
    if (text == "auto")
        return {Backend::automatic, 0};
    if (text == "osmesa")
        return {Backend::osmesa, 0};
    if (text == "egl")
        return {Backend::egl, 0};
    constexpr std::string_view prefix = "egl-device:";
    if (text.starts_with(prefix)) {
        const std::string_view number = text.substr(prefix.size());
        int device = -1;
        const auto [end, status] = std::from_chars(number.data(), number.data() + number.size(), device);
        if (status == std::errc{} && end == number.data() + number.size() && device >= 0)
            return {Backend::egl_device, device};
    }
    throw Error(fmt::format("unknown GL context '{}'; allowed are auto, osmesa, egl, egl-device:N (N = 0, 1, ...){}",
                            text, did_you_mean(text, {"auto", "osmesa", "egl", "egl-device:0"})));
}

std::string context_request_text(const ContextRequest& request) {
    switch (request.backend) {
    case Backend::automatic:
        return "auto";
    case Backend::osmesa:
        return "osmesa";
    case Backend::egl:
        return "egl";
    case Backend::egl_device:
        break;
    }
    return fmt::format("egl-device:{}", request.device);
}

Context::Context(const ContextRequest& request) {
    const bool automatic = request.backend == Backend::automatic;
    std::string reasons;
    for (const ContextRequest& attempt : automatic ? automatic_order() : std::vector{request}) {
        const std::string name = context_request_text(attempt);
        try {
            backend_ = open(attempt);
            make_current();
            info_ = query_context_info(name);
            return;
        } catch (const Error& error) {
            if (backend_ != nullptr && backend_.get() == current)
                release_current();
            backend_.reset();
            reasons += fmt::format("{}{}: {}", reasons.empty() ? "" : "; ", name, error.what());
        }
    }
    throw Error(fmt::format("no GL context: {}", reasons));
}

Context::Context(Context&&) noexcept = default;

Context& Context::operator=(Context&& other) noexcept {
    std::swap(backend_, other.backend_);
    std::swap(info_, other.info_);
    return *this;
}

Context::~Context() {
    if (backend_ != nullptr && backend_.get() == current)
        release_current();
}

void Context::make_current() { lockstep::make_current(*backend_); }

} // namespace lockstep
