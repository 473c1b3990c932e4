#include "crosscheck/record/layout.hpp"

#include <fmt/format.h>

namespace lockstep::layout {

std::string group(const Resource& buffer, const Field& field) {
    // H5MD: particles/GROUP/ELEMENT; a buffer that is called particles holds all of them.
    return fmt::format("particles/{}/{}", buffer.name == "particles" ? "all" : buffer.name, field.name);
}

std::string value(const Resource& buffer, const Field& field) { return group(buffer, field) + "/value"; }

std::string state(const Resource& resource) { return fmt::format("state/{}", resource.name); }

std::string state_value(const Resource& resource, const Field& field) {
    return fmt::format("{}/{}/value", state(resource), field.name);
}

} // namespace lockstep::layout
