#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <source_location>
#include <tuple>
#include <vector>

#include "reference/interval.hpp"
#include "reference/readings/values.hpp"

namespace lockstep {

/// What a twin came by, in order.
struct RecordedRow {
    enum class Kind {
        value,    ///< a named value: its components
        decision, ///< 1 or 0
        fetch,    ///< texel x and y, and whether it lies inside
        texel,    ///< what was fetched
        offer,    ///< to a choice: its key, and whether it was the best so far
        choice,   ///< made: whether of anything
    };
    const Site* site = nullptr;
    Kind kind = Kind::value;
    std::array<float, 4> values{};
    int size = 0;
    std::source_location where = {};
};

/// What a run came by, and what the GPU told of it. An offer has but one value, whether it is the best so far.
struct ReadingRow {
    const Site* site = nullptr;
    RecordedRow::Kind kind = RecordedRow::Kind::value;
    int size = 0;
    std::array<Interval, 4> legal{}; ///< by what was told before
    std::array<float, 4> told{};
    bool is_told = false;
    bool is_integer = false;
    std::source_location where = {};

    /// Whether what was told, if anything, is one of the legal values.
    [[nodiscard]] bool is_legal() const {
        for (std::size_t c = 0; is_told && c < static_cast<std::size_t>(size); ++c)
            if (!legal[c].contains(told[c]))
                return false;
        return true;
    }
};

/// Computes as Values does, and writes down what it comes by.
template <class A> class Recording : public Values<A> {
    using Base = Values<A>;
    using Kind = RecordedRow::Kind;

  public:
    using Base::Base;
    using typename Base::IVec2;
    using typename Base::Real;

    [[nodiscard]] const std::vector<RecordedRow>& rows() const { return rows_; }

    template <class T> T note(At place, T value) {
        if constexpr (requires { value.fields(); })
            std::apply([&](const auto&... field) { add(place, Kind::value, {static_cast<float>(field)...}); },
                       value.fields());
        else
            add(place, Kind::value, {static_cast<float>(value)});
        return value;
    }
    bool decide(At place, bool condition) {
        add(place, Kind::decision, {condition ? 1.0F : 0.0F});
        return condition;
    }
    template <class Texel> const Texel* fetch(At place, const Image<Texel>& image, const IVec2& size, const IVec2& at) {
        const Texel* texel = Base::fetch(place, image, size, at);
        add(place, Kind::fetch, {static_cast<float>(at.x), static_cast<float>(at.y), texel != nullptr ? 1.0F : 0.0F});
        if constexpr (std::is_same_v<Texel, glm::vec4>)
            if (texel != nullptr)
                add(place, Kind::texel, {texel->x, texel->y, texel->z, texel->w});
        return texel;
    }

    template <class Payload> class Least : public Base::template Least<Payload> {
      public:
        Least(Recording& reading, At place, float first)
            : Base::template Least<Payload>(reading, place, first), reading_(reading), place_(place) {}
        void offer(At place, bool condition, Real key, const Payload& payload) {
            const bool best = this->offered(condition, key, payload);
            reading_.decide(place, condition);
            reading_.add(place_, Kind::offer, {static_cast<float>(key), best ? 1.0F : 0.0F});
        }
        [[nodiscard]] const std::optional<Payload>& take() const {
            const std::optional<Payload>& found = Base::template Least<Payload>::take();
            reading_.add(place_, Kind::choice, {found ? 1.0F : 0.0F});
            return found;
        }

      private:
        Recording& reading_;
        At place_;
    };

  private:
    void add(At place, Kind kind, std::initializer_list<float> values) {
        RecordedRow row{
            .site = &place.site, .kind = kind, .size = static_cast<int>(values.size()), .where = place.where};
        std::copy(values.begin(), values.end(), row.values.begin());
        rows_.push_back(row);
    }

    std::vector<RecordedRow> rows_;
};

} // namespace lockstep
