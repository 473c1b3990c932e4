#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "reference/readings/recording.hpp"
#include "reference/readings/worlds.hpp"

namespace lockstep {

/// Runs along what a GPU told (worlds.hpp): where a value was told, it is written down beside what would be legal, and
/// the run goes on with it, be it legal or not; a decision that was told is taken as it was told. With nothing told
/// these are the worlds.
template <class A> class Following : public Worlds<A> {
    using Base = Worlds<A>;

  public:
    using Base::Base;
    using typename Base::IVec2;
    using typename Base::Real;
    using typename Base::Vec3;

    /// `values`: what the site's output was, the `occurrence`-th time that it was come by.
    void tell_in_order(std::uint32_t output, int occurrence, std::span<const float> values) {
        told_[{output, occurrence}] = values;
    }
    void start_run() {
        rows_.clear();
        seen_.clear();
    }
    [[nodiscard]] const std::vector<ReadingRow>& rows() const { return rows_; }

    template <class T> T note(At place, const T& value) {
        ReadingRow row = row_at(place);
        const auto told = told_of(place, row.occurrence);
        if constexpr (requires { value.fields(); })
            std::apply(
                [&](const auto&... part) { ((row.legal[static_cast<std::size_t>(row.size++)] = set(part)), ...); },
                value.fields());
        else
            row.legal[static_cast<std::size_t>(row.size++)] = set(value);
        row.is_integer = std::is_same_v<T, int> || std::is_same_v<T, IVec2>;
        T result = value;
        if (told.size() >= static_cast<std::size_t>(row.size)) {
            row.is_told = true;
            std::copy_n(told.begin(), row.size, row.told.begin());
            std::size_t c = 0;
            if constexpr (requires { result.fields(); })
                std::apply([&](auto&... part) { ((take(place, told[c++], part)), ...); }, result.fields());
            else
                take(place, told[0], result);
        }
        rows_.push_back(row);
        return result;
    }

    template <class Condition> bool decide(At place, const Condition& condition) {
        ReadingRow row = row_at(place);
        row.size = 1;
        row.is_integer = true;
        const auto told = told_of(place, row.occurrence);
        row.is_told = !told.empty();
        bool answer = false;
        if (row.is_told) {
            const auto [yes, no] = this->ways(condition);
            row.legal[0] = Interval(no ? 0.0 : 1.0, yes ? 1.0 : 0.0);
            row.told[0] = told[0];
            answer = told[0] != 0.0F;
        } else {
            answer = Base::decide(place, condition);
            row.legal[0] = Interval(answer ? 1.0F : 0.0F);
        }
        rows_.push_back(row);
        return answer;
    }

  private:
    ReadingRow row_at(At place) {
        return {.site = &place.site, .occurrence = seen_[place.site.id]++, .where = place.where};
    }
    [[nodiscard]] std::span<const float> told_of(At place, int occurrence) const {
        const auto found = place.site.output_id == 0 ? told_.end() : told_.find({place.site.output_id, occurrence});
        return found == told_.end() ? std::span<const float>() : found->second;
    }
    static Interval set(const Real& x) { return x.set(); }
    static Interval set(int i) { return {static_cast<double>(i), static_cast<double>(i)}; }
    void take(At place, float told, Real& x) { x = this->read(place, told); }
    static void take(At, float told, int& i) { i = static_cast<int>(told); }

    std::map<std::pair<std::uint32_t, int>, std::span<const float>> told_;
    std::map<std::uint32_t, int> seen_;
    std::vector<ReadingRow> rows_;
};

} // namespace lockstep
