#pragma once
#include <memory>
#include <vector>

#include "reference/fluid/curvature_flow.hpp"
#include "reference/fluid/narrow_range.hpp"
#include "reference/fluid/weighted_mean.hpp"
#include "reference/system/item_twin.hpp"
#include "reference/system/item_words.hpp"
#include "reference/system/pixel_boxes.hpp"

namespace lockstep::fluid {

/// A pass of the filter. Twin of shaders/fluid/depth_filter_pass.comp.
struct DepthFilterTwin {
    HostPtr host;
    FilterStep step;
    /// What the filter's weight() gives; null: of another filter, or never read by lanes.
    std::shared_ptr<const KnownNarrowWeights> narrow_weights = {};
    std::shared_ptr<const std::vector<float>> mean_weights = {};
    std::shared_ptr<const FilteredImage> image = {};

    [[nodiscard]] DepthFilterTwin at(const PassInput& /*in*/) const {
        DepthFilterTwin made = *this;
        made.image = filtered_image(*host, step.of_spheres ? field::depth : field::smooth_depth, reach());
        return made;
    }

    bool fast(const FastRun& run) const; // image_lanes.cpp

    template <class R, class Item> ItemWords<R> operator()(R& r, const PassInput& in, const Item& item) const {
        using Real = typename R::Real;
        const auto pixel = pixel_at(host->settings().width, item);
        const bool of_spheres = r.setting(site::reads_spheres, step.of_spheres);
        const DepthMap<R> map(r, *host, in.before, of_spheres ? field::depth : field::smooth_depth, image.get());
        const Real centre = map.at(site::centre_depth, pixel.x, pixel.y);
        ItemWords<R> words;
        words.add(r.note(site::smooth_depth, filtered(r, map, pixel, centre)));
        return words;
    }

  private:
    [[nodiscard]] int reach() const {
        switch (host->switches().filter) {
        case Filter::narrow_range:
            return most_narrow_reach;
        case Filter::curvature_flow:
            return 1;
        default:
            return host->settings().filter_radius;
        }
    }
    template <class R, class At>
    typename R::Real filtered(R& r, const DepthMap<R>& map, const At& pixel, const typename R::Real& centre) const {
        using Real = typename R::Real;
        if (map.is_empty(site::centre_empty, centre))
            return centre;
        if (map.is_black(centre))
            return Real(0.0F);
        const DepthCode<R>& code = map.code();
        switch (host->switches().filter) {
        case Filter::narrow_range: {
            const NarrowRange<R> filter(r, *host, map, narrow_weights.get());
            return code.stored(filter.at(pixel.x, pixel.y, step, code.decoded(centre)));
        }
        case Filter::curvature_flow: {
            const CurvatureFlow<R> filter(r, *host, map);
            return code.stored(filter.at(pixel.x, pixel.y, code.decoded(centre)));
        }
        default:
            break;
        }
        const WeightedMean<R> filter(r, *host, map, mean_weights.get());
        if (filter.is_metric())
            return code.stored(filter.at(pixel.x, pixel.y, step, code.decoded(centre)));
        return code.coded(filter.at(pixel.x, pixel.y, step, centre));
    }
};

} // namespace lockstep::fluid
