#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "reference/readings/recording.hpp"
#include "reference/readings/worlds.hpp"

namespace lockstep {

/// Runs along what a GPU told (worlds.hpp): where a value was told, it is written down beside what would be legal, and
/// the run goes on with it, be it legal or not; a decision or a choice that was told is made as it was told. With
/// nothing told these are the worlds.
///
/// What was told in a turn of a loop is known by the texel that the turn fetches, not by how often the loop came round:
/// a GPU may leave turns out.
template <class A> class Following : public Worlds<A> {
    using Base = Worlds<A>;
    using Kind = RecordedRow::Kind;

  public:
    using Base::Base;
    using typename Base::IVec2;
    using typename Base::Real;
    using typename Base::Vec3;

    /// `values`: what the site's output was, the `occurrence`-th time that it was come by.
    void tell_in_order(std::uint32_t output, int occurrence, std::span<const float> values) {
        told_[{output, occurrence}] = values;
    }
    /// The same of a turn of a loop, numbered as the GPU made it.
    void tell_in_turn(std::uint32_t output, int turn, std::span<const float> values) {
        in_turns_[{output, turn}] = values;
        told_in_turns_.insert(output);
    }
    void start_run() {
        rows_.clear();
        seen_.clear();
        turn_.reset();
    }
    [[nodiscard]] const std::vector<ReadingRow>& rows() const { return rows_; }

    template <class T> T note(At place, const T& value) {
        const auto told = told_of(place);
        ReadingRow row = row_at(place, Kind::value);
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
        const auto told = told_of(place);
        if (told.empty()) {
            const bool answer = Base::decide(place, condition);
            add(place, Kind::decision, Interval(answer ? 1.0F : 0.0F));
            return answer;
        }
        add(place, Kind::decision, answers(this->ways(condition)), told);
        return told[0] != 0.0F;
    }

    template <class Texel> const Texel* fetch(At place, const Image<Texel>& image, const IVec2& size, const IVec2& at) {
        const Texel* texel = Base::fetch(place, image, size, at);
        if (told_in_turns_.contains(place.site.output_id))
            turn_ = turn_told_of(place.site.output_id, at);
        ReadingRow row = row_at(place, Kind::fetch);
        row.size = 3;
        row.legal = {set(at.x), set(at.y), set(texel != nullptr ? 1 : 0)};
        row.is_told = turn_.value_or(untold) != untold;
        row.told = {static_cast<float>(at.x), static_cast<float>(at.y), texel != nullptr ? 1.0F : 0.0F};
        rows_.push_back(row);
        if constexpr (std::is_same_v<Texel, glm::vec4>)
            if (texel != nullptr) {
                row.kind = Kind::texel;
                row.size = 4;
                row.is_told = false;
                row.legal = {Interval(texel->x), Interval(texel->y), Interval(texel->z), Interval(texel->w)};
                rows_.push_back(row);
            }
        return texel;
    }

    /// Where the loop's turns were told of, the GPU's choice.
    template <class Payload> class Least {
      public:
        Least(Following& run, At place, float first)
            : run_(run), place_(place), worlds_(run, place, first), best_(first) {}

        template <class Condition> void offer(At place, const Condition& condition, Real key, const Payload& payload) {
            is_told_ = is_told_ || run_.turn_;
            if (!is_told_) {
                run_.add(place_, Kind::offer, Interval(0.0, 1.0));
                return worlds_.offer(place, condition, key, payload);
            }
            const auto told = run_.told_of(place_);
            const auto [fits, misfits] = run_.ways(condition);
            const auto [less, not_less] = run_.ways(key < best_);
            run_.add(place_, Kind::offer, answers({fits && less, misfits || not_less}), told);
            if (told.empty() || told[0] == 0.0F)
                return;
            best_ = key;
            found_ = payload;
        }

        [[nodiscard]] std::optional<Payload> take() {
            is_told_ = is_told_ || run_.turn_;
            run_.turn_.reset();
            const std::optional<Payload> found = is_told_ ? found_ : worlds_.take();
            run_.add(place_, Kind::choice, Interval(found ? 1.0F : 0.0F), run_.told_of(place_));
            return found;
        }

      private:
        Following& run_;
        At place_;
        typename Base::template Least<Payload> worlds_;
        bool is_told_ = false; ///< of its turns
        Real best_;
        std::optional<Payload> found_;
    };

  private:
    static constexpr int untold = -1;

    static ReadingRow row_at(At place, Kind kind) { return {.site = &place.site, .kind = kind, .where = place.where}; }
    void add(At place, Kind kind, Interval legal, std::span<const float> told = {}) {
        ReadingRow row = row_at(place, kind);
        row.size = 1;
        row.legal[0] = legal;
        row.is_integer = true;
        row.is_told = !told.empty();
        if (row.is_told)
            row.told[0] = told[0];
        rows_.push_back(row);
    }
    static Interval answers(std::pair<bool, bool> yes_and_no) {
        return {yes_and_no.second ? 0.0 : 1.0, yes_and_no.first ? 1.0 : 0.0};
    }
    [[nodiscard]] std::span<const float> told_of(At place) {
        const auto find = [&](const auto& told, int number) {
            const auto found = told.find({place.site.output_id, number});
            return found == told.end() ? std::span<const float>() : found->second;
        };
        if (place.site.output_id == 0)
            return {};
        return turn_ ? find(in_turns_, *turn_) : find(told_, seen_[place.site.id]++);
    }
    [[nodiscard]] int turn_told_of(std::uint32_t output, const IVec2& at) const {
        for (const auto& [key, told] : in_turns_)
            if (key.first == output && told.size() >= 2 && told[0] == static_cast<float>(at.x) &&
                told[1] == static_cast<float>(at.y))
                return key.second;
        return untold;
    }
    static Interval set(const Real& x) { return x.set(); }
    static Interval set(int i) { return {static_cast<double>(i), static_cast<double>(i)}; }
    void take(At place, float told, Real& x) { x = this->read(place, told); }
    static void take(At, float told, int& i) { i = static_cast<int>(told); }

    using Told = std::map<std::pair<std::uint32_t, int>, std::span<const float>>;
    Told told_, in_turns_; ///< by output, and by how often it came before or the turn
    std::set<std::uint32_t> told_in_turns_;
    std::map<std::uint32_t, int> seen_;
    std::optional<int> turn_; ///< in a loop of whose turns something was told: which of these this is
    std::vector<ReadingRow> rows_;
};

} // namespace lockstep
