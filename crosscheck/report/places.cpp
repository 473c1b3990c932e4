#include "crosscheck/report/places.hpp"

#include <fmt/format.h>

namespace lockstep {

std::string place_arguments(const Place& place, const Schema& schema, int width) {
    const Resource& resource = schema.resources[place.resource];
    const auto columns = static_cast<std::size_t>(width);
    const std::string item = resource.dimensions == 1
                                 ? std::to_string(place.index)
                                 : fmt::format("{},{}", place.index % columns, place.index / columns);
    return fmt::format("--frame {} --{} {}", place.frame, resource.item, item);
}

} // namespace lockstep
