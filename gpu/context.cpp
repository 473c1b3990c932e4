#include "gpu/context.hpp"

#include <charconv>
#include <cstdlib>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "gpu/child_process.hpp"
#include "gpu/context_backend.hpp"
#include "gpu/context_trial.hpp"
#include "gpu/driver_call.hpp"
#include "gpu/environment.hpp"
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
    const DriverCall call("the start of a context");
    backend.make_current();
    current = &backend;
    gl::load([&](const char* name) { return backend.resolve(name); });
}

std::unique_ptr<ContextBackend> open(const ContextRequest& request) {
    const DriverCall call("the start of a context");
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

/// The same, found in a child process.
std::vector<ContextRequest> tried_order() {
    std::vector<ContextRequest> order;
    try {
        std::istringstream names(in_child({"the driver"}, [] {
            std::string lines;
            for (const ContextRequest& request : automatic_order())
                lines += context_request_text(request) + "\n";
            return lines;
        }));
        for (std::string name; std::getline(names, name);)
            order.push_back(parse_context_request(name));
    } catch (const NoChildProcess&) {
        return automatic_order();
    } catch (const ChildFailed&) {
        return {{Backend::osmesa, 0}, {Backend::egl, 0}};
    }
    return order;
}

/// Throws Error if a child process cannot open it. Where no process can be started nothing is known.
void try_in_child(const ContextRequest& request) {
    try {
        try_context(request);
    } catch (const NoChildProcess&) {
    }
}

/// The library that gives such contexts, as this process finds it.
std::string library_of(const ContextRequest& request) {
    const bool osmesa = request.backend == Backend::osmesa;
    const char* chosen = std::getenv(osmesa ? "LOCKSTEP_OSMESA_LIBRARY" : "LOCKSTEP_EGL_LIBRARY");
    return fmt::format("{} {}", osmesa, chosen != nullptr ? chosen : "");
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
    const std::string dangers = is_trial() ? "" : prepare_for_driver();
    std::vector<ContextRequest> attempts{request};
    if (request.backend == Backend::automatic)
        attempts = dangers.empty() ? automatic_order() : tried_order();
    std::string reasons;
    for (const ContextRequest& attempt : attempts) {
        const std::string name = context_request_text(attempt);
        try {
            // A child of a process that has used a library has its state, and none of its threads: it would hang.
            static std::set<std::string> used;
            if (!dangers.empty() && !used.contains(library_of(attempt)))
                try_in_child(attempt);
            used.insert(library_of(attempt));
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
    if (!dangers.empty())
        reasons += "; the environment may be why: " + dangers;
    throw Error(fmt::format("no GL context: {}", reasons));
}

Context::Context(Context&&) noexcept = default;

Context& Context::operator=(Context&& other) noexcept {
    std::swap(backend_, other.backend_);
    std::swap(info_, other.info_);
    return *this;
}

Context::~Context() {
    const DriverCall call("the end of a context");
    if (backend_ != nullptr && backend_.get() == current)
        release_current();
    backend_.reset();
}

void Context::make_current() { lockstep::make_current(*backend_); }

} // namespace lockstep
