#pragma once
#include <algorithm>

#include "reference/fluid/depth_code.hpp"
#include "reference/fluid/filtered_image.hpp"
#include "reference/fluid/linear_fetch.hpp"
#include "reference/model/fluid/schema.hpp"
#include "reference/readings/decided.hpp"
#include "reference/readings/exponential.hpp"
#include "reference/system/item_pass.hpp"
#include "reference/system/item_reads.hpp"

namespace lockstep::fluid {

/// The image that normals and shading take their depth from.
inline FieldId last_depth(const Host& host) { return host.filter_steps().empty() ? field::depth : field::smooth_depth; }
template <class R> FieldId last_depth(R& r, const Host& host) {
    const FieldId last = last_depth(host);
    return last != field::depth && !r.setting(site::reads_filtered, true) ? field::depth : last;
}

/// A depth image as a pass reads it. Twin of shaders/fluid/source.glsl.
template <class R> class DepthMap {
    using Real = typename R::Real;
    using Index = IndexOf<R>;

  public:
    /// `filtered`: filtered_image(), which lanes read; null: they filter each texel themselves, as all others do.
    DepthMap(R& r, const Host& host, const SystemView& state, FieldId from, const FilteredImage* filtered = nullptr)
        : r_(r), host_(host), state_(state), from_(from), filtered_(filtered), code_(r, host) {}

    /// What is stored at a pixel, the nearest one of the image.
    [[nodiscard]] Real at(At place, const Index& x, int y) const {
        const Settings& s = host_.settings();
        // Lanes come here only where a middle's place is its texel (lanes_filter).
        const bool is_texel = HasLanes<R> && host_.linear_filter() == LinearFilter::aligned;
        if (host_.switches().depth_fetch == DepthFetch::linear && !is_texel)
            return between_texels(place, x, y);
        if constexpr (!HasLanes<R>)
            if (!has(x, y) && !r_.setting(site::ends_at_edge, true))
                return r_.note(place, Real(0.0F));
        return r_.note(place, item_real(r_, place, state_, from_,
                                        item_of(clamped(x, 0, s.width - 1), clamped(y, 0, s.height - 1), s.width)));
    }
    [[nodiscard]] bool is_empty(At place, const Real& stored) const {
        return r_.decide(place, stored == Real(code_.empty()));
    }
    /// The same, to be chosen by.
    [[nodiscard]] auto has_nothing(At place, const Real& stored) const {
        return decided(r_, place, stored == Real(code_.empty()));
    }
    /// What NDC depth makes of fluid that is too near.
    [[nodiscard]] bool is_black(const Real& stored) const {
        return !code_.is_metric() && r_.decide(site::is_black, stored <= Real(0.0F));
    }
    [[nodiscard]] auto has(const Index& x, int y) const {
        return is_among(y, host_.settings().height) && is_among(x, host_.settings().width);
    }
    [[nodiscard]] const DepthCode<R>& code() const { return code_; }

  private:
    [[nodiscard]] Real between_texels(At place, const Index& x, int y) const {
        const Settings& s = host_.settings();
        if constexpr (HasLanes<R>)
            if (filtered_ != nullptr)
                return filtered_->at(x.v[0], y);
        const auto along = [&](const auto& i, int size, At size_at) {
            return r_.divide(place, r_.real(i) + Real(0.5F), r_.uniform(size_at, static_cast<float>(size)));
        };
        const auto texel = [this, &s](const Index& tx, const Index& ty) {
            return raw_real(state_, from_, item_of(tx, ty, s.width));
        };
        return linear_fetch(r_, place, host_.linear_filter(),
                            {along(x, s.width, site::width), along(y, s.height, site::height)},
                            Texels<decltype(texel)>{s.width, s.height, texel});
    }

    R& r_;
    const Host& host_;
    const SystemView& state_;
    FieldId from_;
    const FilteredImage* filtered_;
    DepthCode<R> code_;
};

/// e^x of x <= 0, as `transcendentals` has it.
template <class R> typename R::Real exponential_of(R& r, const Host& host, const typename R::Real& x) {
    if (host.switches().transcendentals == Transcendentals::portable)
        return portable_exponential(r, site::in_exponent, x);
    return built_in_exponential(r, site::exponent, x);
}
/// x^n of x >= 0.
template <class R> typename R::Real power_of(R& r, const Host& host, const typename R::Real& x, int n) {
    if (host.switches().transcendentals == Transcendentals::portable)
        return product_power(x, n);
    return built_in_power(r, site::exponent, x, n);
}

} // namespace lockstep::fluid
