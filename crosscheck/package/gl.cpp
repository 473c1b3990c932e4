#include <cstdlib>

#include "crosscheck/files/threads.hpp"
#include "crosscheck/scene/kept_probe.hpp"
#include "crosscheck/scene/profiles.hpp"
#include "gpu/probe.hpp"
#include "lockstep/lockstep.hpp"

namespace lockstep {
namespace {

std::string asked_for(std::string_view context) {
    if (!context.empty())
        return std::string(context);
    const char* wanted = std::getenv("LOCKSTEP_GL");
    return wanted != nullptr && *wanted != '\0' ? wanted : "auto";
}

} // namespace

Gl::Gl(std::string_view context) : asked_(asked_for(context)) {
    const ContextRequest request = parse_context_request(asked_);
    have_waiting_threads_sleep_soon();
    try {
        context_.emplace(request);
    } catch (const Error& error) {
        missing_ = error.what();
        return;
    }
    probed_ = std::make_shared<const ProbeResult>(kept_probe(*context_));
    profile_ = measured_profile(*probed_);
}

Profile Gl::profile(const std::filesystem::path& shaders) const {
    return probed_ ? with_shaders(profile_, *probed_, shaders) : profile_;
}

Profile Gl::profile_without_precise(bool said_elsewhere) const {
    return probed_ ? without_precise(profile_, *probed_, said_elsewhere) : profile_;
}

std::string Gl::name() const { return context_ ? summary(context_->describe()) : missing_; }

} // namespace lockstep
