#include <cstdlib>

#include "crosscheck/profiles.hpp"
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
    try {
        context_.emplace(request);
    } catch (const Error& error) {
        missing_ = error.what();
        return;
    }
    profile_ = measured_profile(*context_);
}

std::string Gl::name() const { return context_ ? summary(context_->describe()) : missing_; }

} // namespace lockstep
