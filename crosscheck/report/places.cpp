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

std::string first_arguments(const CheckReport& report, int width) {
    if (report.verdicts && report.verdicts->first)
        return place_arguments(report.verdicts->first->place, report.schema, width);
    if (!report.rendered || !report.rendered->first)
        return "";
    const auto columns = static_cast<std::size_t>(report.rendered->width);
    const std::size_t pixel = report.rendered->first->index;
    return fmt::format("--frame {} --pixel {},{}", report.rendered->frame, pixel % columns, pixel / columns);
}

} // namespace lockstep
