#pragma once
#include <bit>
#include <cstdint>
#include <optional>

#include "reference/lifecycle/counters.hpp"

/// Sums of distances: by blocks of floats, or in 2^-16 units without rounding. Twin of shaders/lifecycle/lengths.glsl
/// and length_scan.glsl.
namespace lockstep::lifecycle {

/// One of either kind.
template <class R> struct Length {
    typename R::Real real{0.0F};
    std::uint32_t units = 0;
};

template <class R> class Lengths {
    using Real = typename R::Real;

  public:
    Lengths(R& reading, const Switches& switches) : r(reading), fixed_(switches.distance_sum == DistanceSum::fixed) {}

    [[nodiscard]] Length<R> plus(const Length<R>& a, const Length<R>& b) const {
        return fixed_ ? Length<R>{{}, a.units + b.units} : Length<R>{a.real + b.real, 0};
    }
    [[nodiscard]] Length<R> of(const Real& distance) const {
        if (!fixed_)
            return {distance, 0};
        const Real units = r.monotone(r.floor(distance * 65536.0F + 0.5F), [](float f) {
            return f > 0.0F ? (f < 2147483648.0F ? f : 2147483648.0F) : 0.0F;
        });
        const Real high = r.floor(units * 0x1p-16F);
        const auto whole = [&](const Real& x) {
            return static_cast<std::uint32_t>(static_cast<int>(r.to_int(site::units, x)));
        };
        const std::uint32_t upper = whole(high);
        return {{}, (upper << 16U) + whole(units - high * 65536.0F)};
    }
    [[nodiscard]] Real distance(const Length<R>& sum) const {
        return fixed_ ? R::real(sum.units >> 16U) + R::real(sum.units & 0xffffU) * 0x1p-16F : sum.real;
    }
    /// As a word of the state has it.
    [[nodiscard]] Length<R> read(const SystemView& state, FieldId field, std::size_t item) const {
        const Value value = state.value(field, item);
        return fixed_ ? Length<R>{{}, value.bits} : Length<R>{r.read(site::length_sum, value.real()), 0};
    }
    [[nodiscard]] ItemWords<R> record(const Length<R>& sum) const {
        ItemWords<R> words;
        if (fixed_)
            words.add(noted(r, site::length_sum, sum.units));
        else
            words.add(r.note(site::length_sum, sum.real));
        return words;
    }
    [[nodiscard]] ItemWords<R> kept(const SystemView& state, FieldId field, std::size_t item) const {
        const Value value = state.value(field, item);
        ItemWords<R> words;
        if (fixed_)
            words.add(value.bits);
        else
            words.add(Real(std::bit_cast<float>(value.bits)));
        return words;
    }

    /// Hillis and Steele's inclusive scan, at one place of a group: `at(k)` is what place k holds at first.
    template <class At_> [[nodiscard]] Length<R> scan(std::uint32_t place, const At_& at) const {
        if (!fixed_)
            return scanned(place, 128, at);
        Length<R> sum;
        for (std::uint32_t k = 0; k <= place; ++k)
            sum = plus(sum, at(k));
        return sum;
    }

  private:
    /// After the step of `d`.
    template <class At_> [[nodiscard]] Length<R> scanned(std::uint32_t place, std::uint32_t d, const At_& at) const {
        if (d == 0)
            return at(place);
        const Length<R> own = scanned(place, d / 2, at);
        return place >= d ? plus(scanned(place - d, d / 2, at), own) : own;
    }

    R& r;
    bool fixed_;
};

} // namespace lockstep::lifecycle
