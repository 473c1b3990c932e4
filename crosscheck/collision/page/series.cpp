#include "crosscheck/collision/page/series.hpp"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "reference/model/collision/collision_state.hpp"

namespace lockstep {

DifferenceSeries::DifferenceSeries(const Scene& scene, Profile profile, CheckMode mode)
    : mode_(mode), other_(scene, std::move(profile)) {}

DifferenceSeries::Amount DifferenceSeries::amount(const Comparison& comparison) {
    return {comparison.differing(collision::particles), comparison.differing(collision::cdt),
            comparison.worst.empty() ? 0 : comparison.worst.front().ulp};
}

void DifferenceSeries::merge(Amount& a, const Amount& b) {
    a.particles = std::max(a.particles, b.particles);
    a.texels = std::max(a.texels, b.texels);
    a.worst_ulp = std::max(a.worst_ulp, b.worst_ulp);
}

void DifferenceSeries::add(const ComparedFrame& frame, const Particles& before, const CollisionImage& cdt_before,
                           const FrameParams& params) {
    Point point{.frame = frame.frame, .own = amount(frame.comparison), .other = {}};
    // As long as every bit agrees, both modes make the same step.
    if (!differed_ && !frame.comparison.agree()) {
        differed_ = true;
        other_.step_from(before, cdt_before, params);
        point.other = point.own;
    } else if (differed_) {
        if (mode_ == CheckMode::resync)
            other_.step(params);
        else
            other_.step_from(before, cdt_before, params);
        Comparison comparison = compare(other_.particles(), frame.gpu);
        comparison.add(compare(other_.cdt(), frame.gpu_cdt));
        point.other = amount(comparison);
    }
    if (frame.verdicts != nullptr) {
        for (const ItemVerdict& verdict : frame.verdicts->particles)
            ++point.particles[static_cast<std::size_t>(verdict.kind)];
        for (const ItemVerdict& verdict : frame.verdicts->texels)
            ++point.texels[static_cast<std::size_t>(verdict.kind)];
    }
    append(point);
}

void DifferenceSeries::append(const Point& point) {
    const auto add = [](std::vector<Point>& points, const Point& next, int stride) {
        if (points.empty() || next.frame - points.back().frame >= stride) {
            points.push_back(next);
            return;
        }
        Point& last = points.back();
        merge(last.own, next.own);
        merge(last.other, next.other);
        for (std::size_t k = 0; k < class_names.size(); ++k) {
            last.particles[k] = std::max(last.particles[k], next.particles[k]);
            last.texels[k] = std::max(last.texels[k], next.texels[k]);
        }
    };
    add(points_, point, stride_);
    if (points_.size() <= most_points)
        return;
    stride_ *= 2;
    std::vector<Point> fewer;
    for (const Point& old : points_)
        add(fewer, old, stride_);
    points_ = std::move(fewer);
}

nlohmann::json DifferenceSeries::json() const {
    using nlohmann::json;
    const auto column = [&](const auto& value) {
        json numbers = json::array();
        for (const Point& point : points_)
            numbers.push_back(value(point));
        return numbers;
    };
    const auto amounts = [&](Amount Point::*side) {
        return json{{"particles", column([&](const Point& p) { return (p.*side).particles; })},
                    {"texels", column([&](const Point& p) { return (p.*side).texels; })},
                    // No double holds INT64_MAX: null.
                    {"ulp", column([&](const Point& p) {
                         return (p.*side).worst_ulp == INT64_MAX ? json() : json((p.*side).worst_ulp);
                     })}};
    };
    const bool resync = mode_ == CheckMode::resync;
    return {{"stride", stride_},
            {"frame", column([](const Point& p) { return p.frame; })},
            {"resync", amounts(resync ? &Point::own : &Point::other)},
            {"free", amounts(resync ? &Point::other : &Point::own)},
            {"classes",
             {{"names", class_names},
              {"particles", column([](const Point& p) { return p.particles; })},
              {"texels", column([](const Point& p) { return p.texels; })}}}};
}

} // namespace lockstep
