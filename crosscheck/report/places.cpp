#include "crosscheck/report/places.hpp"

#include <fmt/format.h>

#include "crosscheck/judge/item_place.hpp"

namespace lockstep {

std::string place_arguments(const Place& place, const Schema& schema, int width) {
    const Resource& resource = schema.resources[place.resource];
    return fmt::format("--frame {} --{} {}", place.frame, resource.item,
                       item_argument(resource, {static_cast<std::size_t>(width), 1, 1}, place.index));
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

int frames_to_repeat(const CheckReport& report) {
    if (report.verdicts && report.verdicts->first)
        return report.verdicts->first->place.frame + 1;
    return report.first_frame && !report.state_verdict ? *report.first_frame + 1 : report.first + report.frames;
}

} // namespace lockstep
